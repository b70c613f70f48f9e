// A pendulum under a controller with noise, and windows on it, for what is made of movies.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/support/command.h"

namespace hookpoint::testing {

constexpr const char* pendulum_scene = R"(World world {
  gravity = 9.81; deltat = 1 ms; duration = 1 s; seed = 11;
  Robot pendulum {
    Base.fixed { orientation = -90 deg, 0, 0; Shape.Box { dimensions = 0.1, 0.1, 0.1; } }
    Chain arm {
      Link rod {
        angle = 0; mass = 1 kg; center_of_mass = 0.5, 0, 0; inertia = 0.01, 0.1, 0.1, 0, 0, 0;
        Shape.Legcone { length = 1; proximal_radius = 0.08; distal_radius = 0.05; }
      }
    }
  }
}
Controller.PD pd { pconstant = 3; dconstant = 0.4; goal = 0.5; rate = 130 Hz;
  Wire FROM world.pendulum.arm.rod.angle TO current { noise = 1 mrad; }
  Wire FROM output TO world.pendulum.arm.rod.torque; }
Window look {
  Window.grob eye { drawer = world; distance = 5; euler1 = 0.4; }
  Window.grob far { drawer = world; distance = 12; }
  Valuator.Slider goal { range = -1, 1; Wire TO pd.goal; }
  Plot way { show = world.pendulum.arm.rod.angle; }
}
)";

/// 200 ms of it in a folder, as m.h5.
class PendulumMovie : public ::testing::Test {
 protected:
  void SetUp() override {
    place.file("scene.hook", pendulum_scene);
    const CommandResult run = place.hookpoint("run scene.hook --for '200 ms' --movie m.h5");
    ASSERT_EQ(run.status, 0) << run.err;
  }
  void expect_refused(const std::string& arguments, const std::string& said) {
    const CommandResult result = place.hookpoint("replay m.h5 " + arguments);
    EXPECT_EQ(result.status, 2) << arguments << '\n' << result.err;
    EXPECT_NE(result.err.find(said), std::string::npos) << arguments << '\n' << result.err;
  }
  Workplace place;
};

}  // namespace hookpoint::testing
