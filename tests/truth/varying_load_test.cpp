// A mass that is pushed to and fro under a load that varies, so that its slip reverses all the
// time, against the laws' own differential equations, written down here and integrated finely. The
// damper of the bristle goes from none to one that a step resolves.
// ctest: long
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

constexpr double g = 9.81, mass = 1., seconds = 1.5;
constexpr double k = 2e4, c = 150., k_t = 1e4, mu = 0.6;

Vector3d push(double t) {
  constexpr double turn = 2. * std::numbers::pi;
  return {1.5 + 9. * std::sin(turn * 2.3 * t), 5. * std::sin(turn * 3.7 * t + 1.),
          6. * std::sin(turn * 3.1 * t + 0.4)};
}

/// Spring and damper of the normal force [N] at the depth d and its rate.
double normal_force(const std::string& law, double d, double d_rate) {
  if (law == "exponential") return 0.5336 * std::exp(1150. * d) * std::max(0., 1. + 0.5 * d_rate);
  if (d <= 0.) return 0.;
  if (law == "azad_featherstone")
    return std::max(0., k * 100. * std::pow(d, 1.5) + c * 30. * std::sqrt(d) * d_rate);
  if (law == "nominal")
    return std::max(0., 1e4 * d + (k - 1e4) * std::max(0., d - 1e-3) + c * d_rate);
  return std::max(0., k * d + c * d_rate);
}

/// Where the mass is after `seconds`, each push held over `deltat` [m]. Along the tile a massless
/// foot on a spring k_t and a damper c_t, |f| <= mu N, N f/|f| opposed to the foot's slip: backward
/// Euler on u, whose foot either stays or is at the cone.
Vector3d integrated_finely(const std::string& law, double c_t, double deltat) {
  constexpr double h = 1e-6;
  const auto substeps = std::lround(deltat / h);
  Vector3d x{0., 0., -4e-4}, v{}, u{};
  for (long n = 0; n < std::lround(seconds / deltat); ++n) {
    const Vector3d pushed = push(static_cast<double>(n) * deltat);
    for (long i = 0; i < substeps; ++i) {
      const double N = normal_force(law, -x.z, -v.z);
      const Vector3d along{v.x, v.y, 0.};
      Vector3d f = k_t * (u + h * along) + c_t * along;
      if (norm(f) > mu * N) f = (mu * N / norm(f)) * f;
      u = (1. / (k_t + c_t / h)) * (f + (c_t / h) * u);
      v += (h / mass) * (pushed - f + Vector3d{0., 0., N - mass * g});
      x += h * v;
    }
  }
  return x;
}

simulation::Experiment pushed_mass(const std::string& law, double c_t, double deltat,
                                   const std::string& integrator) {
  Loaded loaded = load_text(R"(
World w {
  gravity = 9.81;
  Material m { normal_stiffness = 20 kN/m; normal_damping = 150; tangential_stiffness = 10 kN/m;
               static_friction = 0.6; kinetic_friction = 0.6; }
  Terrain.Flat ground { material = m; }
  Robot r { Base.mobile { location = 0, 0, -0.4 mm; mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0;
                          ContactPoint p { location = 0, 0, 0; } } }
  Force pushed { body = r.base; force = 0, 0, 0; }
}
)");
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  simulation::Experiment experiment = *loaded.experiment;
  experiment.contact = law;
  experiment.integrator = integrator;
  experiment.deltat = deltat;
  experiment.relative_tolerance = 1e-8;
  experiment.absolute_tolerance = 1e-10;
  for (simulation::MaterialSpec& material : experiment.materials) {
    auto& constants = material.constants;
    constants.tangential_damping = c_t;
    if (law == "azad_featherstone") {
      constants.normal_stiffness = k * 100.;
      constants.normal_damping = c * 30.;
    }
  }
  return experiment;
}

Vector3d in_the_engine(const simulation::Experiment& experiment) {
  const auto engine = simulation::make_dts(experiment);
  for (long n = 0; n < std::lround(seconds / experiment.deltat); ++n) {
    engine->inputs().forces.at(0).force = push(static_cast<double>(n) * experiment.deltat);
    const simulation::StepStatus status = engine->step();
    EXPECT_TRUE(status.ok()) << status.time << " " << status.advice;
    if (!status.ok()) break;
  }
  return engine->state().bodies[0].position;
}

const std::vector<std::string> laws{"hookpoint", "nominal", "azad_featherstone", "exponential"};

/// How far the engine is from the truth, along the ground [m].
double error(const std::string& law, const std::string& integrator, double c_t, double deltat) {
  const Vector3d truth = integrated_finely(law, c_t, deltat);
  const Vector3d x = in_the_engine(pushed_mass(law, c_t, deltat, integrator));
  return std::hypot(x.x - truth.x, x.y - truth.y);
}

// It comes 0.25 m far, and a fixed step errs by what it moves in some steps: the error is of first
// order, up to 3.7 m/s times the step, of rk4, which moves its hooks once a step, 0.7 m/s. Under
// the exponential's weak damper explicit Euler's own vertical vibration grows.
TEST(VaryingLoad, FixedStepsFollowTheLaw) {
  for (const std::string& law : laws)
    for (const double c_t : {0., 1e-3, 0.05, 5., 50.})
      for (const double deltat : {1e-4, 1e-3})
        for (const std::string integrator : {"explicit_euler", "semi_implicit_euler", "rk4"})
          if (law != "exponential" || integrator != "explicit_euler") {
            EXPECT_LE(error(law, integrator, c_t, deltat), (integrator == "rk4" ? 1. : 4.) * deltat)
                << law << " " << integrator << " c_t " << c_t << " deltat " << deltat;
          }
}

/// The truth's own steps are of first order too, and of a microsecond.
constexpr double own_error = 4. * 1e-6;

TEST(VaryingLoad, StiffIntegratorsFollowTheLawWithoutADamper) {
  for (const std::string& law : laws)
    for (const double c_t : {0., 1e-3, 5.})
      for (const char* integrator : {"cvode_bdf", "arkode_imex"})
        EXPECT_LE(error(law, integrator, c_t, 1e-3), own_error)
            << law << " " << integrator << " " << c_t;
}

TEST(VaryingLoad, AdaptiveIntegratorsFollowTheLaw) {
  for (const std::string& law : laws)
    for (const double c_t : {5., 50.})
      for (const char* integrator : {"cvode_adams", "arkode"})
        EXPECT_LE(error(law, integrator, c_t, 1e-3), own_error)
            << law << " " << integrator << " " << c_t;
}

}  // namespace
}  // namespace hookpoint
