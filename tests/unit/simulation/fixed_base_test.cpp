// A robot that is a fixed base and no more: nothing moves, and nothing breaks.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "simulation/analysis/dynamics_report.h"
#include "simulation/analysis/stability.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

const std::vector<std::string> scenes{
    "Robot r { Base.fixed { location = 0.1, 0.2, 0.3; } }",
    "Robot r { Base.fixed { location = 0.1, 0.2, 0.3; Shape.Box { dimensions = 1, 1, 1; } } }",
    "Robot r { Base.fixed { location = 0.1, 0.2, 0.3; Shape.Box { dimensions = 1, 1, 1; } } } "
    "Material m {} Terrain.Flat ground { material = m; }",
    "Robot r { Base.fixed { location = 0.1, 0.2, 0.3; } } "
    "Force f { body = r.base; force = 1, 2, 3; torque = 4, 5, 6; }",
    "Robot r { Base.fixed { location = 0.1, 0.2, 0.3; } } Robot ball { Base.mobile { location = "
    "0, 0, 1; Shape.Sphere { radius = 0.1; mass = 1; } } } Material m {} Terrain.Flat ground { "
    "material = m; }",
};

void expect_still(const std::string& settings, const std::string& scene) {
  SCOPED_TRACE(settings + scene);
  Running run("World w { deltat = 1 ms; " + settings + scene + " }");
  run.step(100);
  EXPECT_EQ(run["r.base.location.x"], 0.1);
  EXPECT_EQ(run["r.base.location.z"], 0.3);
  EXPECT_EQ(run["r.base.velocity.z"], 0.);
  EXPECT_EQ(run["r.base.contact.force.z"], 0.);
  EXPECT_EQ(run["r.kinetic_energy"], 0.);
}

TEST(FixedBaseAlone, StaysUnderEveryIntegratorAndLaw) {
  for (const std::string& scene : scenes) {
    for (const integrators::StepperDescription& stepper : integrators::stepper_table())
      expect_still("integrator = " + std::string(stepper.name) + "; ", scene);
    for (const contact::LawDescription& law : contact::law_table())
      expect_still("contact = " + std::string(law.name) + "; ", scene);
  }
}

TEST(FixedBaseAlone, HasNoLargestStepAndNoAccelerations) {
  for (const std::string& scene : scenes) {
    const Loaded loaded = load_text("World w { " + scene + " }");
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    const simulation::DynamicsReport report = simulation::evaluate_dynamics(*loaded.experiment);
    EXPECT_EQ(norm(report.robots[0].base_acceleration), 0.);
    if (loaded.experiment->robots.size() > 1) continue;
    EXPECT_TRUE(std::isinf(simulation::stability_bound(*loaded.experiment).step));
  }
}

}  // namespace
}  // namespace hookpoint
