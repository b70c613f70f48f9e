// Closed forms of steady motion, and a start with slack springs: what is judged agrees, and where the
// start still counts nothing is judged. Boxes and tables on slopes that friction does not hold and
// slopes that it does, under every law that slides or creeps, short and long.
#include <gtest/gtest.h>

#include <string>

#include "output/files/csv.h"
#include "tests/support/command.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::Workplace;

constexpr const char* box = R"(
Param slope = 28 deg;
World w {
  gravity = 9.81; duration = 20 s;
  Material m { static_friction = 0.5; }
  Terrain.Slope hill { angle = slope; material = m; }
  Robot b { Base.mobile { rest_on = hill; settled = false; Shape.Box { dimensions = 0.3, 0.2, 0.1; mass = 2 kg; } } }
}
)";

// On ground so soft that it rocks for seconds.
constexpr const char* table = R"(
Param slope = 30 deg;
World w {
  gravity = 9.81; deltat = 0.02 ms; duration = 20 s; contact = hunt_crossley;
  Material m { normal_stiffness = 40000; exponent = 1.5; hysteresis_damping = 0.5 s/m; regularisation_speed = 1 mm/s; static_friction = 0.5; }
  Terrain.Slope hill { angle = slope; material = m; }
  Robot t {
    Base.mobile {
      rest_on = hill; settled = false;
      Shape.Box top { dimensions = 0.4, 0.3, 0.05; location = 0, 0, 0.25; mass = 2 kg; contact = false; }
      For x in -0.18, 0.18 { For y in -0.13, 0.13 { Shape.Sphere { radius = 0.03; location = x, y, 0.03; mass = 0.05; } } }
    }
  }
}
)";

struct Judged {
  int status = 0;
  std::string said;
  int forms = 0, rows = 0;
};

/// The verdicts of a study of that scene, and how many of its runs have a closed form of `metric`.
Judged judged(const std::string& scene, const std::string& blocks, const std::string& metric) {
  const Workplace work;
  work.file("scene.hook", scene);
  work.file("s.hook", "Study s { scene = \"scene.hook\"; " + blocks + " Measure " + metric +
                          "; Truth " + metric + " { equals = predicted; tolerance = 2 %; } }");
  const CommandResult result = work.hookpoint("study s.hook --out out");
  Judged made{result.status, result.out + result.err + work.read("out/report.html"), 0, 0};
  const auto csv = output::parse_csv(work.read("out/results.csv"));
  if (!csv) return made;
  for (std::size_t column = 0; column < csv->header.size(); ++column) {
    if (csv->header[column].find("_predicted") == std::string::npos) continue;
    for (const auto& row : csv->rows) {
      ++made.rows;
      if (!row[column].empty()) ++made.forms;
    }
  }
  return made;
}

const std::string laws =
    "Subject hookpoint { contact = hookpoint; } Subject reset { contact = hookpoint_reset; } Subject "
    "lugre { contact = lugre; } Subject elastoplastic { contact = elastoplastic; } Subject nominal { "
    "contact = nominal; } Subject azad { contact = azad_featherstone; } Subject exponential { contact "
    "= exponential; } ";

TEST(StartEffects, WhatIsJudgedOfASlideAgrees) {
  const std::string slopes = "Sweep slope { values = 27 deg, 27.5 deg, 28 deg, 30 deg, 35 deg; } ";
  const Judged brief =
      judged(box, laws + slopes + "settle = 0.5 s; duration = 1 s;", "creep_speed");
  EXPECT_NE(brief.said.find("speed that the body gained while its slack springs stretched"),
            std::string::npos)
      << brief.said;
  EXPECT_LT(brief.forms, brief.rows);
  const Judged lasting =
      judged(box, laws + slopes + "settle = 4 s; duration = 12 s;", "creep_speed");
  EXPECT_EQ(lasting.status, 0) << lasting.said;
  EXPECT_GT(lasting.forms, lasting.rows / 2);
  const Judged mixed = judged(box, laws + slopes + "settle = 1 s; duration = 6 s;", "creep_speed");
  EXPECT_EQ(mixed.said.find("FAIL"), std::string::npos) << mixed.said;
}

TEST(StartEffects, ABodyThatStillSwingsIsNotJudged) {
  for (const std::string metric : {"creep_speed", "slip_acceleration"}) {
    const std::string slope = metric == "creep_speed" ? "Sweep slope { values = 8 deg; } "
                                                      : "Sweep slope { values = 30 deg; } ";
    const Judged brief =
        judged(table, "Subject a { } " + slope + "settle = 0.5 s; duration = 1 s;", metric);
    EXPECT_EQ(brief.forms, 0) << brief.said;
    EXPECT_NE(brief.said.find("the body still swings from its start"), std::string::npos)
        << brief.said;
    const Judged lasting =
        judged(table, "Subject a { } " + slope + "settle = 4 s; duration = 8 s;", metric);
    EXPECT_EQ(lasting.forms, 1) << lasting.said;
    EXPECT_EQ(lasting.status, 0) << lasting.said;
  }
}

}  // namespace
}  // namespace hookpoint
