// Cases of a study, as a user runs them: tables that are computed from closed forms, a known
// distance beside them. What the study measures is that distance.
#include <gtest/gtest.h>
#include <math.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "output/files/csv.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/page_blocks.h"
#include "text/number.h"

namespace hookpoint {
namespace {

using testing::Workplace;

// A ball is thrown up and turns about z; a rotor about z is driven by a torque. Without contact rk4
// has parabolas to rounding.
constexpr const char* scene = R"(
Param height = 1 m;
Param speed = 0 m/s;
Param spin = 0 rad/s;
Param drive = 0 N.m;
Param seed = 1;
World world {
  gravity = 9.81; deltat = 1 ms; duration = 1 s; integrator = rk4;
  Robot ball {
    Base.mobile {
      location = 0, 0, height; velocity = 0.2, 0, speed; angular_velocity = 0, 0, spin; mass = 2 kg; inertia = 1, 1, 1, 0, 0, 0;
    }
  }
  Robot arm {
    Base.fixed { location = 0, 3, 0; }
    Chain c { Link rotor { angle = 17 deg; torque = drive; mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0; } }
  }
}
)";
constexpr double gravity = 9.81, first_angle = 17. * M_PI / 180.;

struct Throw {
  const char* name;
  double height, speed, spin, drive;
  int samples;  // every 10 ms
};
constexpr std::array<Throw, 3> throws{{{"low", 1., 0., 0.5, 2., 21},
                                       {"high", 1.5, 2., -3., -1., 41},
                                       {"hurled", 2.5, -1., 8., 0.5, 11}}};

// What is measured beside the truth: a vector of 13 mm, 0.05 rad, 0.02 rad in turns, and 0.25 N m
// that grow from 0 by time.
constexpr double tilt = 0.05, off_angle = 0.02, off_torque = 0.25;

constexpr const char* study = R"(
Study thrown {
  scene = "scene.hook";
  Cases throw {
    file = "throws.csv"; case = throw;
    Trace position { file = "curves.csv"; column = x, y, z; time = "t"; of = world.ball.position; }
    Trace attitude { file = "curves.csv"; column = qw, qx, qy, qz; time = "t"; of = ball.orientation; }
    Trace angle { file = "curves.csv"; column = "angle [deg]"; time = "t"; of = arm.c.rotor.angle; }
    Trace torque { file = "curves.csv"; column = torque; time = "t"; of = arm.c.rotor.total_torque; weight = 1 / (1 N.m); }
  }
  Subject ours { }
  Subject again { integrator = rk4; Only throw { values = low, hurled; } }
  Measure off { trace = position; take = mean; unit = mm; }
  Measure turned { trace = attitude; take = maximum; }
  Measure swung { trace = angle; take = rms; unit = deg; }
  Measure torque_mean { trace = torque; take = mean; }
  Measure torque_last { trace = torque; }
  Measure torque_rms { trace = torque; take = rms; from = 50 ms; to = 100 ms; }
  Measure fallen { of = ball.position.z; take = change; predicted = speed * 0.1 s; }
  Truth off { equals = value; value = 13 mm; within = 1e-9 m; }
  Truth same { metric = off; same_over = throw; within = 1e-9 m; }
  Table by_throw { rows = throw; columns = subject; value = off; }
  Plot offs { x = throw; y = off; }
  Claim answer { text = "{off} beside, {largest turned of ours at throw = high} turned."; }
}
)";

std::string fields(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += "," + text::shortest(number);
  return text + "\n";
}

std::string throw_table() {
  std::string text = "throw,height [cm],speed [m/s],spin [rad/s],weather,drive [N.m],seed\n";
  for (const Throw& one : throws)
    text +=
        std::string(one.name) + fields({100. * one.height, one.speed, one.spin, 3., one.drive, 1.});
  return text;
}

std::string curve_table(double off = 1.) {
  std::string text = "throw,t [ms],x [mm],y [mm],z [mm],qw,qx,qy,qz,angle [deg],torque [N.m]\n";
  for (const Throw& one : throws) {
    for (int i = 1; i < one.samples; ++i) {
      const double t = 0.01 * i;
      const double z = one.height + one.speed * t - 0.5 * gravity * t * t;
      // exp(tilt n) exp(spin t z), n = (1, 2, 2)/3
      const double c = cos(0.5 * tilt), s = sin(0.5 * tilt) / 3.;
      const double cz = cos(0.5 * one.spin * t), sz = sin(0.5 * one.spin * t);
      const double angle = first_angle + 0.5 * one.drive * t * t + (i % 2 ? 1 : -1) * off_angle;
      text += std::string(one.name) +
              fields({10. * i, 200. * t + 3. * off, 4. * off, 1000. * z + 12. * off,
                      c * cz - 2. * s * sz, s * cz + 2. * s * sz, 2. * s * cz - s * sz,
                      c * sz + 2. * s * cz, angle * 180. / M_PI,
                      one.drive + off_torque * i / (one.samples - 1)});
    }
  }
  return text;
}

/// A study's results: fields by the title of their column.
class Results {
 public:
  Results(const Workplace& work, const std::string& folder)
      : table_(*output::parse_csv(work.read(folder + "/results.csv"))) {}
  std::size_t rows() const { return table_.rows.size(); }
  std::string text(std::size_t row, const std::string& title) const {
    const auto found = std::ranges::find(table_.header, title);
    if (found == table_.header.end()) return "no column " + title;
    return table_.rows[row][static_cast<std::size_t>(found - table_.header.begin())];
  }
  double number(std::size_t row, const std::string& title) const {
    const std::string field = text(row, title);
    return field.empty() ? std::numeric_limits<double>::quiet_NaN() : std::atof(field.c_str());
  }

 private:
  output::CsvTable table_;
};

class StudyCases : public ::testing::Test {
 protected:
  StudyCases() {
    work_.file("scene.hook", scene);
    work_.file("throws.csv", throw_table());
    work_.file("curves.csv", curve_table());
    work_.file("study.hook", study);
  }
  /// Of the study in which `from` stands as `to`: what is said of it.
  std::string error_with(const std::string& from, const std::string& to,
                         const std::string& options = "") const {
    std::string text = study;
    EXPECT_NE(text.find(from), std::string::npos) << from;
    work_.file("wrong.hook", text.replace(text.find(from), from.size(), to));
    const auto said = work_.hookpoint("study wrong.hook --out wrong" + options);
    EXPECT_NE(said.status, 0) << to;
    return said.err;
  }
  Workplace work_;
};

TEST_F(StudyCases, MeasureHowFarARunIsFromWhatWasMeasured) {
  const auto run = work_.hookpoint("study study.hook --out here");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  const Results results(work_, "here");
  ASSERT_EQ(results.rows(), 5U);
  const std::array<std::size_t, 5> of_row{0, 0, 1, 2, 2};
  for (std::size_t row = 0; row < results.rows(); ++row) {
    const Throw& one = throws[of_row[row]];
    EXPECT_EQ(results.text(row, "throw"), one.name);
    EXPECT_EQ(results.text(row, "status"), "ok");
    EXPECT_NEAR(results.number(row, "off [mm]"), 13., 1e-9);
    EXPECT_NEAR(results.number(row, "turned [rad]"), tilt, 1e-11);
    EXPECT_NEAR(results.number(row, "swung [deg]"), off_angle * 180. / M_PI, 1e-9);
    // The distances are i/n of the last one, i from 1 to n.
    const double n = one.samples - 1;
    EXPECT_NEAR(results.number(row, "torque_last [N.m]"), off_torque, 1e-12);
    EXPECT_NEAR(results.number(row, "torque_mean [N.m]"), off_torque * (n + 1.) / (2. * n), 1e-12);
    // Of the samples 5 to 10: (25 + 36 + 49 + 64 + 81 + 100)/6.
    EXPECT_NEAR(results.number(row, "torque_rms [N.m]"), off_torque * sqrt(355. / 6.) / n, 1e-12);
    // Each row runs up to its own last sample.
    const double t = 0.01 * n;
    EXPECT_NEAR(results.number(row, "fallen [m]"), one.speed * t - 0.5 * gravity * t * t, 1e-12);
    EXPECT_NEAR(results.number(row, "fallen_predicted [m]"), one.speed * 0.1, 1e-15);
  }
  EXPECT_NE(run.out.find("13 mm beside, 0.05 rad turned."), std::string::npos) << run.out;
  EXPECT_NE(work_.read("here/by_throw.csv").find("hurled"), std::string::npos);
  EXPECT_FALSE(work_.read("here/offs.svg").empty());
}

TEST_F(StudyCases, AStepThatMissesASampleIsJoinedToTheNextByALine) {
  // Steps of 4 ms: a sample at 10 ms lies half way from 8 to 12, where the chord is g h^2/8 low.
  const auto run =
      work_.hookpoint("study study.hook --out here --only ours --set world.deltat='4 ms'");
  const Results results(work_, "here");
  ASSERT_EQ(results.rows(), 3U) << run.out << run.err;
  const double low = 1000. * gravity * 0.004 * 0.004 / 8.;
  const double odd = sqrt(9. + 16. + pow(12. + low, 2));
  for (std::size_t row = 0; row < 3; ++row)
    EXPECT_NEAR(results.number(row, "off [mm]"), 0.5 * (13. + odd), 1e-9);
}

TEST_F(StudyCases, AreTheSameBytesHoweverTheyAreRun) {
  EXPECT_EQ(work_.hookpoint("study study.hook --out one --jobs 1").status, 0);
  EXPECT_EQ(work_.hookpoint("study study.hook --out two --jobs 2").status, 0);
  EXPECT_EQ(work_.hookpoint("study study.hook --out two --jobs 2 --resume").status, 0);
  EXPECT_EQ(work_.read("one/results.csv"), work_.read("two/results.csv"));
  EXPECT_EQ(work_.read("one/by_throw.csv"), work_.read("two/by_throw.csv"));
}

TEST_F(StudyCases, RunAnewWhatWasMeasuredAnew) {
  EXPECT_EQ(work_.hookpoint("study study.hook --out here").status, 0);
  const std::string again = work_.hookpoint("study study.hook --out here --resume").err;
  EXPECT_EQ(again.find("run again"), std::string::npos) << again;
  // Another measurement of one case alone.
  const std::string curves = work_.read("curves.csv");
  std::string changed = curves;
  const std::size_t last = changed.rfind("hurled");
  const std::string other = curve_table(2.);
  changed = changed.substr(0, last) + other.substr(other.rfind("hurled"));
  work_.file("curves.csv", changed);
  const auto one = work_.hookpoint("study study.hook --out here --resume");
  EXPECT_NE(one.err.find("2 of the finished rows are"), std::string::npos) << one.err;
  EXPECT_NE(one.status, 0) << "a Truth holds no more";
  EXPECT_NEAR(Results(work_, "here").number(0, "off [mm]"), 13., 1e-9);
  EXPECT_NEAR(Results(work_, "here").number(3, "off [mm]"), 13. * 1.1, 1e-9);
  // Another state at which a case begins.
  work_.file("curves.csv", curves);
  std::string states = throw_table();
  work_.file("throws.csv", states.replace(states.find("low,100"), 7, "low,101"));
  const auto two = work_.hookpoint("study study.hook --out here --resume");
  EXPECT_NE(two.err.find("run again"), std::string::npos) << two.err;
  EXPECT_NEAR(Results(work_, "here").number(0, "off [mm]"), sqrt(9. + 16. + 4.), 1e-9);
  EXPECT_NEAR(Results(work_, "here").number(2, "off [mm]"), 13., 1e-9);
}

TEST_F(StudyCases, CalledByNumbersAreRestrictedByThem) {
  std::string states = throw_table(), curves = curve_table(), text = study;
  for (std::string* table : {&states, &curves})
    for (std::size_t i = 0; i < throws.size(); ++i) {
      const std::string name = std::string("\n") + throws[i].name + ",";
      for (std::size_t at; (at = table->find(name)) != std::string::npos;)
        table->replace(at, name.size(), "\n" + std::to_string(10 * i) + ",");
    }
  work_.file("throws.csv", states);
  work_.file("curves.csv", curves);
  text.replace(text.find("values = low, hurled;"), 21, "from = 10;");
  text.replace(text.find("at throw = high"), 15, "at throw = 10");
  work_.file("study.hook", text);
  EXPECT_EQ(work_.hookpoint("study study.hook --out here").status, 0) << work_.read(".err");
  const Results results(work_, "here");
  ASSERT_EQ(results.rows(), 5U);
  EXPECT_EQ(results.text(1, "throw"), "10");
  EXPECT_EQ(results.text(2, "subject"), "again");
  EXPECT_EQ(results.text(4, "throw"), "20");
  // The first and the last alone, or those that are named.
  EXPECT_EQ(work_.hookpoint("study study.hook --out quick --quick").status, 0);
  EXPECT_NE(work_.read(".out").find("--quick leaves out the values of throw that it is about"),
            std::string::npos)
      << work_.read(".out");
  text.insert(text.find("case = throw;"), "quick_values = 10, 20; ");
  work_.file("study.hook", text);
  EXPECT_EQ(work_.hookpoint("study study.hook --out quick --quick --only ours").status, 0)
      << work_.read(".err");
  const Results quick(work_, "quick");
  ASSERT_EQ(quick.rows(), 2U);
  EXPECT_EQ(quick.text(1, "throw"), "20");
  EXPECT_NEAR(quick.number(1, "fallen [m]"), -0.1 - 0.5 * gravity * 0.01, 1e-12);
}

TEST_F(StudyCases, LastAsLongAsTheStudySaysWhereItSays) {
  std::string text = study;
  text.insert(text.find("scene ="), "duration = 100 ms; settle = 20 ms; ");
  work_.file("study.hook", text);
  EXPECT_EQ(work_.hookpoint("study study.hook --out here").status, 0) << work_.read(".err");
  const Results results(work_, "here");
  for (std::size_t row = 0; row < results.rows(); ++row) {
    const Throw& one = throws[std::array{0, 0, 1, 2, 2}[row]];
    // Of the samples from `settle` on, 2 to 10.
    EXPECT_NEAR(results.number(row, "torque_mean [N.m]"), off_torque * 6. / (one.samples - 1),
                1e-12);
  }
}

TEST_F(StudyCases, AnEngineOfOthersIsMeasuredBesideThem) {
  std::string text = study;
  text.replace(text.find("integrator = rk4;"), 17, "engine = ode;     ");
  work_.file("study.hook", text);
  work_.hookpoint("study study.hook --out here");
  const Results results(work_, "here");
  ASSERT_EQ(results.rows(), 5U) << work_.read(".err");
  EXPECT_EQ(results.text(1, "engine"), "ode");
  // Its falls are longer than ours by g t h/2, in the mean over time a quarter of g T h.
  EXPECT_NEAR(results.number(1, "off [mm]"), 13., 1.);
  EXPECT_GT(std::abs(results.number(1, "off [mm]") - 13.), 0.1);
}

TEST_F(StudyCases, WhatIsWrongHasAPlace) {
  struct Wrong {
    const char *from, *to, *said;
  };
  for (const Wrong& wrong : std::initializer_list<Wrong>{
           {"trace = position; take", "trace = postion; take",
            "wrong.hook:13:25: error: no Trace of the study's Cases is called `postion`"
            "; did you mean `position`?"},
           {"trace = position; take", "trace = position; of = ball.position.x; take",
            "error: a metric is `of` ports or of a `trace`, not both"},
           {"unit = mm", "unit = s", "wrong.hook:13:55: error: `mean` of `off` is in m, not in s"},
           {"trace = attitude; take", "trace = attitude; unit = mm; take", "is in rad, not in m"},
           {"case = throw", "case = toss", "throws.csv has no column `toss`"},
           {"\"throws.csv\"", "\"thrown.csv\"", "no file \"thrown.csv\" beside the study"},
           {"column = x, y, z", "column = x, y", "a Trace has one column, the three of a vector"},
           {"column = x, y, z", "column = qx, qy, qz",
            "of curves.csv is in no unit, world.ball.position in m"},
           {"time = \"t\"; of = world", "time = \"x\"; of = world",
            "the column `x [mm]` is no time"},
           {"of = world.ball.position", "of = world.bell.position", "did you mean `ball`"},
           {"Subject ours { }", "Subject ours { Fix speed { value = 1 m/s; } }",
            "`speed` is set by the Cases: it cannot be fixed as well"},
           {"Subject ours { }", "Subject ours { } Sweep spin { values = 1 rad/s; }",
            "`spin` is swept: the column of"},
           {"Subject ours { }", "Subject ours { Only throw { values = lowest; } }",
            "no value of the Sweep throw is called `lowest`"},
           {"Subject ours { }", "Subject ours { } settle = 0.15 s;",
            "throw hurled was measured for 0.1 s, which must be longer than settle"},
           {"case = throw;", "case = throw; Only speed { from = 5 m/s; }", "is a case"},
           {"Subject ours { }", "Subject ours { } seeds = 2;",
            "error: `seeds` varies the Param `seed`, which the Cases set"},
           {"case = throw;", "case = throw; Only weather { values = fair; }", "is a case"},
           {"Cases throw {", "Cases subject {", "Cases cannot be called `subject`"},
           {"Measure fallen", "Cases more { file = \"throws.csv\"; case = throw; } Measure fallen",
            "a Study has one Cases block"}}) {
    const std::string said = error_with(wrong.from, wrong.to);
    EXPECT_NE(said.find(wrong.said), std::string::npos) << wrong.to << "\n" << said;
    EXPECT_NE(said.find("wrong.hook:"), std::string::npos) << said;
  }
  EXPECT_NE(error_with("Measure fallen", "Measure falls", " --set speed='1 m/s'")
                .find("`speed` is set by the cases of throw"),
            std::string::npos);
}

TEST_F(StudyCases, WhatIsWrongWithATableHasItsRow) {
  const auto said = [&](const std::string& from, const std::string& to) {
    std::string states = throw_table();
    work_.file("throws.csv", states.replace(states.find(from), from.size(), to));
    const auto run = work_.hookpoint("study study.hook --out wrong");
    EXPECT_NE(run.status, 0);
    EXPECT_NE(run.err.find("study.hook:5:12: error: "), std::string::npos) << run.err;
    return run.err;
  };
  EXPECT_NE(said("low,100", "low,hundred").find("row 2: `hundred`"), std::string::npos);
  EXPECT_NE(said("high,", "low,").find("row 3: `low` is there already"), std::string::npos);
  EXPECT_NE(said("speed [m/s]", "speed [s]").find("m/s"), std::string::npos);
  work_.file("throws.csv", throw_table());
  std::string curves = curve_table();
  while (curves.find("\nhigh,") != std::string::npos)
    curves.replace(curves.find("\nhigh,"), 6, "\nhugh,");
  work_.file("curves.csv", curves);
  const auto run = work_.hookpoint("study study.hook --out wrong");
  EXPECT_NE(run.err.find("no row is of throw high"), std::string::npos) << run.err;
}

TEST_F(StudyCases, WithoutTracesNeedADuration) {
  std::string text = study;
  const std::size_t begin = text.find("    Trace position"), end = text.find("  }\n  Subject");
  text.erase(begin, end - begin);
  const std::size_t measures = text.find("  Measure off"), fallen = text.find("  Measure fallen");
  text.erase(measures, fallen - measures);
  const std::size_t truths = text.find("  Truth off");
  text = text.substr(0, truths) + "}\n";
  work_.file("study.hook", text);
  const auto run = work_.hookpoint("study study.hook --out here");
  EXPECT_NE(run.err.find("study.hook:2:1: error: this Study needs `duration` [s]"),
            std::string::npos)
      << run.err;
  text.insert(text.find("scene ="), "duration = 100 ms; ");
  work_.file("study.hook", text);
  EXPECT_EQ(work_.hookpoint("study study.hook --out here").status, 0) << work_.read(".err");
  EXPECT_NEAR(Results(work_, "here").number(4, "fallen [m]"), -0.1 - 0.5 * gravity * 0.01, 1e-12);
}

// The page's numbers: 0.2, 1.2 mm; 1.2, 1.2, 1.8 mm; 0.8, 1.8, 1.2 mm beside h + v t - g t^2/2.
TEST(StudyCasesOfThePage, AreMeasuredAsItSays) {
  const Workplace work;
  const std::string page =
      testing::read_file(std::filesystem::path(testing::source_folder()) / "docs/studies.md");
  for (const testing::PageBlock& block : testing::blocks_of(page))
    if (!block.name.empty()) work.file(block.name, block.text);
  const auto run = work.hookpoint("study throws.hook --out here");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  const Results results(work, "here");
  ASSERT_EQ(results.rows(), 5U);
  EXPECT_NEAR(results.number(0, "off [mm]"), sqrt((0.04 + 1.44) / 2.), 1e-9);
  EXPECT_NEAR(results.number(1, "off [mm]"), sqrt((1.44 + 1.44 + 3.24) / 3.), 1e-9);
  EXPECT_NEAR(results.number(3, "off [mm]"), sqrt((0.64 + 3.24 + 1.44) / 3.), 1e-9);
  EXPECT_NEAR(results.number(3, "end [mm]"), 1.2, 1e-9);
  EXPECT_EQ(results.text(4, "engine"), "ode");
  EXPECT_EQ(results.text(4, "throw"), "3");
}

// A Calibrate without a Vary says of the same throws and constants half of the position's error in
// edges and of half of the rotation's in radians.
TEST(TossedCube, IsAsFarFromItsThrowsAsACalibrateSays) {
  const Workplace work;
  const auto run = work.hookpoint("study " + testing::config("studies/tossed_cube.hook") +
                                  " --only hookpoint --only guessed --out here");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  const Results results(work, "here");
  ASSERT_EQ(results.rows(), 40U);
  double error = 0.;
  for (std::size_t row = 0; row < results.rows(); ++row) {
    if (results.text(row, "subject") != "hookpoint") continue;
    error += 0.5 / 20. *
             (results.number(row, "position_error [mm]") / 104.8 +
              0.5 * results.number(row, "rotation_error [deg]") * M_PI / 180.);
  }
  const auto calibrate =
      work.hookpoint("tune " + testing::config("tunings/acrylic_on_wood_given.hook") + " --out c");
  const std::string said = calibrate.out + calibrate.err, title = "hookpoint: error ";
  const auto told = said.find(title);
  ASSERT_NE(told, std::string::npos) << said;
  EXPECT_NEAR(error, std::stod(said.substr(told + title.size())), 1e-4);
  const auto quick =
      work.hookpoint("study " + testing::config("studies/tossed_cube.hook") + " --quick --out q");
  EXPECT_EQ(quick.status, 0) << quick.out << quick.err;
  EXPECT_EQ(Results(work, "q").rows(), 12U);
}

}  // namespace
}  // namespace hookpoint
