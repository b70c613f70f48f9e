// The body that a study measures: a link of a robot with a fixed base, one of several robots, and
// what is wrong with one that is asked for.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/command.h"

namespace hookpoint {
namespace {

using testing::Workplace;

// A cart goes along a rail at 3 mm/s, on it a box the other way at 1 mm/s; a ball flies at 2 m/s.
constexpr const char* scene = R"(
World world {
  gravity = 0; deltat = 1 ms; duration = 1 s;
  Robot rig {
    Base.fixed { location = 0, 0, 1; }
    Chain rail {
      hip_orientation = 0, 90 deg, 0;
      Link cart { joint = prismatic; rate = 3 mm/s; mass = 2 kg; inertia = 0.01, 0.01, 0.01, 0, 0, 0; }
    }
    Chain turn {
      Link arm { rate = 2; mass = 1 kg; inertia = 0.01, 0.01, 0.01, 0, 0, 0; }
      Link tip { dhlength = 0.5; mass = 1e-6 kg; inertia = 1e-9, 1e-9, 1e-9, 0, 0, 0; }
    }
  }
  Robot ball { Base.mobile { velocity = 0, 2 m/s, 0; Shape.Sphere { radius = 0.1; mass = 1 kg; } } }
}
)";

std::string study(const std::string& body, const std::string& truths) {
  return "Study moved { scene = \"scene.hook\"; duration = 1 s; " + body +
         " Subject ours { } Subject ode { engine = ode; } " + truths + " }";
}

TEST(StudyBody, IsTheOneThatIsAskedFor) {
  const Workplace work;
  work.file("scene.hook", scene);
  const auto holds = [&](const std::string& body, const std::string& truths) {
    work.file("study.hook", study(body, truths));
    const auto result = work.hookpoint("study study.hook --out out");
    EXPECT_EQ(result.status, 0) << body << "\n" << result.out << result.err;
  };
  holds("body = rig.rail.cart;",
        "Measure creep_speed; Truth creep_speed { equals = value; value = 3 mm/s; tolerance = "
        "1e-9; }");
  holds("body = world.rig.rail.cart;",
        "Measure settle_shift; Truth settle_shift { equals = value; value = 0 m; within = 1e-12 m; "
        "}");
  holds("body = ball;",
        "Measure creep_speed; Truth creep_speed { equals = value; value = 2 m/s; tolerance = 1e-9; "
        "}");
  holds("",
        "Measure creep_speed; Truth creep_speed { equals = value; value = 2 m/s; tolerance = 1e-9; "
        "}");
  holds("body = rig.turn.arm;",
        "Measure spin_max; Truth spin_max { equals = value; value = 2 rad/s; tolerance = 1e-6; }");
}

TEST(StudyBody, OfAnotherIsAnotherRun) {
  const Workplace work;
  work.file("scene.hook", scene);
  const std::string truth =
      "Measure creep_speed; Truth creep_speed { equals = value; value = 2 m/s; tolerance = 1e-9; }";
  work.file("study.hook", study("body = rig.rail.cart;", truth));
  EXPECT_NE(work.hookpoint("study study.hook --out out").status, 0);
  work.file("study.hook", study("body = ball;", truth));
  const auto resumed = work.hookpoint("study study.hook --out out --resume");
  EXPECT_EQ(resumed.status, 0) << resumed.out << resumed.err;
}

TEST(StudyBody, WithoutAMobileRobotItIsTheEndOfTheFirstChain) {
  const Workplace work;
  std::string alone = scene;
  alone.erase(alone.find("  Robot ball"),
              alone.find("mass = 1 kg; } } }\n") + 19 - alone.find("  Robot ball"));
  work.file("scene.hook", alone);
  work.file("study.hook", study("",
                                "Measure creep_speed; Truth creep_speed { equals = value; value "
                                "= 3 mm/s; tolerance = 1e-9; }"));
  const auto result = work.hookpoint("study study.hook --out out");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
}

TEST(StudyBody, SaysWhatIsWrongWithOne) {
  const Workplace work;
  work.file("scene.hook", scene);
  const auto said = [&](const std::string& body) {
    work.file("study.hook", study("body = " + body + ";", "Measure creep_speed;"));
    const auto result = work.hookpoint("study study.hook --out out");
    EXPECT_EQ(result.status, 2) << body;
    return result.err;
  };
  EXPECT_NE(said("rig").find("held in the world; name a link, such as `body = rig.turn.tip;`"),
            std::string::npos);
  EXPECT_NE(said("rig.rail.card").find("did you mean `rig.rail.cart`"), std::string::npos);
  EXPECT_NE(said("ball.position.x + 1").find("the trail of a robot or of a body"),
            std::string::npos);
}

}  // namespace
}  // namespace hookpoint
