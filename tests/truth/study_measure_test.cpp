// A study's own metrics against closed forms, as a user runs them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/page_blocks.h"
#include "tests/support/text.h"

namespace hookpoint {
namespace {

using testing::Workplace;

// m z'' = -m g: every reduction of z(t) = h - g t^2/2 over [0, T] in closed form. Engines of one
// step a velocity are off by g T dt/2 at the end.
constexpr const char* falling = R"(
Param height = 2 m;
Param dt = 1 ms;
World world {
  gravity = 9.81; deltat = dt; duration = 0.5 s; integrator = rk4;
  Robot ball { Base.mobile { location = 0, 0, height; Shape.Sphere { radius = 5 cm; mass = 1 kg; } } }
}
Expect fallen { of = world.ball.position.z; take = change; equals = -9.81 m/s^2 * (0.5 s)^2 / 2; tolerance = 1 %; }
)";
constexpr const char* falling_study = R"(
Let g = 9.81 m/s^2;
Let T = 0.5 s;
Study falling {
  scene = "falling.hook";
  duration = T;
  Sweep height { values = 2 m, 3 m; }
  Subject ours { }
  Subject ode { engine = ode; }
  Subject mujoco { engine = mujoco; }
  Measure end { of = ball.position.z; unit = cm; predicted = height - g * T^2 / 2; }
  Measure top { of = ball.position.z; take = maximum; predicted = height; }
  Measure drop { of = ball.position.z; take = range; predicted = g * T^2 / 2; }
  Measure area { of = ball.position.z; take = integral; predicted = height * T - g * T^3 / 6; }
  Measure speed { of = ball.velocity.z; take = slope; predicted = -g; }
  Measure swift { of = ball.kinetic_energy; predicted = 1 kg * (g * T)^2 / 2; }
  Measure passes { of = ball.position.z; take = time_at; level = 1.5 m; from = 0 s; predicted = sqrt(2 * (height - 1.5 m) / g); }
  Measure above { of = -ball.velocity.z; take = time_above; level = 1 m/s; unit = ms; predicted = T - (1 m/s) / g; }
  Truth end { equals = predicted; tolerance = 1 %; }
  Truth top { equals = predicted; tolerance = 1e-9; }
  Truth drop { equals = predicted; tolerance = 1 %; }
  Truth area { equals = predicted; tolerance = 1 %; }
  Truth speed { equals = predicted; tolerance = 1e-4; }
  Truth swift { equals = predicted; tolerance = 1 %; }
  Truth passes { equals = predicted; tolerance = 1 %; Only height { values = 2 m; } }
  Truth above { equals = predicted; tolerance = 1 %; }
}
)";

TEST(StudyMeasure, AFallingBodyKeepsEveryClosedForm) {
  const Workplace work;
  work.file("falling.hook", falling);
  work.file("study.hook", falling_study);
  const auto result = work.hookpoint("study study.hook --out here");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  const std::string rows = work.read("here/results.csv");
  EXPECT_NE(rows.find("end [cm],end_predicted [cm],end_ok"), std::string::npos) << rows;
  EXPECT_NE(rows.find("fallen [m],fallen_predicted [m],fallen_ok"), std::string::npos) << rows;
  // A wrong closed form must be found: a third instead of a half.
  std::string wrong = falling_study;
  wrong.replace(wrong.find("height - g * T^2 / 2"), 20, "height - g * T^2 / 3");
  work.file("wrong.hook", wrong);
  EXPECT_EQ(work.hookpoint("study wrong.hook --out there").status, 1);
}

TEST(StudyMeasure, PredictedFollowsTheLawOfEachSubject) {
  const Workplace work;
  work.file("falling.hook", falling);
  const auto result = work.hookpoint(
      "study " +
      work.file(
          "s.hook",
          "Study s { scene = \"falling.hook\"; duration = 0.5 s; expects = false; Subject a { "
          "contact = lugre; } Subject b { contact = nominal; } Subject c { } Subject d { engine "
          "= ode; } Measure top { of = ball.position.z; take = maximum; predicted = contact == "
          "lugre ? 1 m : engine == ode ? 2 m : contact == nominal ? 3 m : 4 m; } }") +
      " --out out");
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string rows = work.read("out/results.csv");
  for (const char* predicted : {",2,1,", ",2,3,", ",2,4,", ",2,2,"})
    EXPECT_NE(rows.find(predicted), std::string::npos) << predicted << rows;
}

TEST(StudyMeasure, AnExpectThatIsNotJudgedIsWarnedOf) {
  const Workplace work;
  work.file("falling.hook", falling);
  const auto run = [&](const std::string& more) {
    return work
        .hookpoint("study " +
                   work.file("s.hook",
                             "Study s { scene = \"falling.hook\"; duration = 0.1 s; Subject ours "
                             "{ } Measure apex { of = ball.position.z; } " +
                                 more + " }"))
        .err;
  };
  EXPECT_NE(run("").find("the study does not judge this Expect: its runs last 0.1 s, and the "
                         "scene's 0.5 s"),
            std::string::npos);
  EXPECT_EQ(run("expects = false;").find("does not judge"), std::string::npos);
}

TEST(StudyMeasure, AMatrixBeginsWithTheClaimsOfItsStudies) {
  const Workplace work;
  work.file("falling.hook", falling);
  work.file("study.hook", R"(
Study falling {
  scene = "falling.hook"; duration = 0.5 s;
  Subject ours { }
  Measure end { of = ball.position.z; unit = cm; }
  Claim low { text = "It ends at {end of ours}."; }
}
)");
  work.file("matrix.hook", "Matrix all { Part falling { file = \"study.hook\"; } }");
  const auto result = work.hookpoint("study matrix.hook --out here");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  const std::string page = work.read("here/matrix.html");
  EXPECT_LT(page.find("It ends at 77.4 cm."), page.find("Subjects and scenes")) << page;
}

// Let go on undamped springs of the ground it swings: x = (m g/k)(1 - cos(w t)), w = sqrt(k/m),
// over ten periods T.
constexpr const char* swinging = R"(
Param stiffness = 20 kN/m;
Param mass = 2 kg;
World world {
  gravity = 9.81; deltat = 0.05 ms; duration = 1 s; integrator = rk4;
  Include "materials/truth_surface.hook" (stiffness = stiffness, damping = 0 N.s/m);
  Terrain.Flat ground { material = surface; }
  Robot point {
    Base.mobile { mass = mass; inertia = 0.001, 0.001, 0.001, 0, 0, 0; ContactPoint tip { location = 0, 0, 0; } }
  }
}
)";
constexpr const char* swinging_study = R"(
Let sag = 2 kg * 9.81 m/s^2 / 20 kN/m;
Let T = 2 * pi * sqrt(2 kg / 20 kN/m);
Study swinging {
  scene = "swinging.hook";
  duration = 10 * T;
  Sweep mass { values = 2 kg; }
  Subject hookpoint { contact = hookpoint; }
  Subject lugre { contact = lugre; }
  Measure depth { of = -point.position.z; take = maximum; unit = mm; predicted = 2 * mass * 9.81 m/s^2 / stiffness; }
  Measure deepest_at { of = -point.position.z; take = time_of_maximum; to = 0.9 * T; predicted = T / 2; }
  Measure middle { of = -point.position.z; take = mean; predicted = sag; }
  Measure rms { of = -point.position.z; take = rms; predicted = sag * sqrt(1.5); }
  Measure swings { of = -point.position.z; take = count_above; level = sag; predicted = 10; }
  Measure half { of = -point.position.z; take = time_above; level = sag; predicted = 5 * T; }
  Measure rests { of = -point.position.z; take = settle_time; level = sag; band = 1.01 * sag; predicted = 0 s; }
  Truth depth { equals = predicted; tolerance = 0.01 %; }
  Truth deepest_at { equals = predicted; tolerance = 0.2 %; }
  Truth middle { equals = predicted; tolerance = 0.1 %; }
  Truth rms { equals = predicted; tolerance = 0.1 %; }
  Truth swings { equals = predicted; tolerance = 1e-12; }
  Truth half { equals = predicted; tolerance = 0.1 %; }
  Truth rests { equals = predicted; within = 1 us; }
}
)";

TEST(StudyMeasure, ASpringKeepsEveryClosedForm) {
  const Workplace work;
  work.file("swinging.hook", swinging);
  work.file("study.hook", swinging_study);
  const auto result = work.hookpoint("study study.hook --out here");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
}

TEST(StudyMeasure, APortThatAnEngineLacksIsAnEmptyCellWithAReason) {
  const Workplace work;
  // An impulse law has an integration of its own.
  const std::string integrator = " integrator = rk4;";
  std::string scene = swinging;
  ASSERT_NE(scene.find(integrator), std::string::npos);
  work.file("swinging.hook", scene.erase(scene.find(integrator), integrator.size()));
  work.file("study.hook", R"(
Study stretched {
  scene = "swinging.hook"; duration = 10 ms;
  Subject hooks { contact = hookpoint; }
  Subject hops { contact = impulse; }
  Measure stretch { of = point.base.tip.contact.depth; take = maximum; }
  Truth stretch { above = 0 m; }
}
)");
  const auto result = work.hookpoint("study study.hook --out here");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_NE((result.out + result.err).find("stretch: contact law impulse does not publish"),
            std::string::npos)
      << result.out << result.err;
}

// The example of the manual.
TEST(StudyMeasure, ThePageRuns) {
  const Workplace work;
  const std::string page = testing::read_file(testing::source_folder() + "/docs/studies.md");
  const auto blocks = testing::blocks_of(page);
  const auto block = std::ranges::find_if(
      blocks, [](const auto& one) { return one.text.starts_with("Study drop"); });
  ASSERT_NE(block, blocks.end());
  work.file("study.hook", block->text);
  const auto result = work.hookpoint("study study.hook --out here");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("deepest"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace hookpoint
