// Friction never gives what was not stored: under every law and integrator a point is led along
// random paths whose slip reverses, under loads that vary and vanish, with tangential dampers from
// none up. What friction has done on the body so far, and what the bristle or the stretch holds,
// are together never more than 0.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "integrators/stepper.h"
#include "tests/support/accompanied_robot.h"
#include "tests/support/drawn.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

using integrators::Stage;
using integrators::Status;
using test_support::drawn;

/// A sum of three sines [m/s] and its rate.
struct Wave {
  std::array<double, 3> size{}, rate{}, phase{};
  double at(double t) const {
    double sum = 0.;
    for (std::size_t i = 0; i < 3; ++i) sum += size[i] * std::sin(rate[i] * t + phase[i]);
    return sum;
  }
  double slope(double t) const {
    double sum = 0.;
    for (std::size_t i = 0; i < 3; ++i) sum += size[i] * rate[i] * std::cos(rate[i] * t + phase[i]);
    return sum;
  }
};

/// The velocity of the point, and how it is led.
struct Path {
  Wave x, y, z;
};

Path any_path(std::mt19937_64& random) {
  Path path;
  for (Wave* wave : {&path.x, &path.y, &path.z})
    for (std::size_t i = 0; i < 3; ++i) {
      wave->size[i] = drawn(random, 0.02, 0.2);
      wave->rate[i] = drawn(random, 50., 600.);
      wave->phase[i] = drawn(random, 0., 6.28);
      // To and fro by some 0.4 mm about a depth of 0.5 mm.
      if (wave == &path.z) wave->size[i] = drawn(random, 1e-4, 4e-4) * wave->rate[i];
    }
  return path;
}

/// The engine's robot, a point of 1 kg, that moves as the path says whatever the ground does to it;
/// beside its velocities the work that friction has done on it [J].
class LedPoint final : public test_support::AccompaniedRobot<1> {
 public:
  LedPoint(const simulation::Experiment& experiment, const Path& path)
      : AccompaniedRobot(experiment), path_(path) {
    q.resize(position_size());
    v.resize(velocity_size());
    robot_.robot().write_positions(q);
    v[3] = path_.x.at(0.);
    v[4] = path_.y.at(0.);
    v[5] = path_.z.at(0.);
    robot_.settle_at(q, own(v));
  }

  std::vector<double> q, v;
  double work() const { return v.back(); }
  Vector3d velocity() const { return {v[3], v[4], 0.}; }
  bool has_bristle() const { return v.size() > 9; }
  /// Of the bristle, or of the stretch that was committed last [J].
  double stored() const {
    const double k_t = experiment_.materials[0].constants.tangential_stiffness;
    const Vector3d z = has_bristle() ? Vector3d{v[6], v[7], v[8]}
                                     : robot_.contacts().points()[0].committed.stretch;
    return experiment_.contact == "hunt_crossley" ? 0. : 0.5 * k_t * dot(z, z);
  }
  Vector3d friction() const {
    const Vector3d& force = robot_.contacts().points()[0].force;
    return {force.x, force.y, 0.};
  }
  /// What an accepted state is to the engine: memory is committed, and the bristle let go of what
  /// its load does not hold.
  void accept(double t) {
    robot_.commit(t, q, own(v));
    robot_.reinitialize(own(v));
  }

  Status accelerations(Stage stage, double t, std::span<const double> at, std::span<const double> u,
                       std::span<double> a) override {
    const Status status = robot_.accelerations(stage, t, at, own(u), a.first(a.size() - 1));
    a.back() = a[3] * u[3] + a[4] * u[4];  // 1 kg without weight: the ground's force
    a[3] = path_.x.slope(t);
    a[4] = path_.y.slope(t);
    a[5] = path_.z.slope(t);
    return status;
  }
  Status split_accelerations(double t, std::span<const double> at, std::span<const double> u,
                             std::span<double> a_free, std::span<double> a_contact) override {
    const Status status = accelerations(Stage::trial, t, at, u, a_contact);
    std::ranges::fill(a_free, 0.);
    std::swap_ranges(a_free.begin(), a_free.begin() + 6, a_contact.begin());
    return status;
  }

 private:
  Path path_;
};

simulation::Experiment any_experiment(std::mt19937_64& random, const std::string& law,
                                      const std::string& integrator, double c_t, double dt) {
  static const simulation::Experiment plain = *load_text(R"(
World w {
  gravity = 0;
  Terrain.Flat ground { }
  Robot r { Base.mobile { location = 0, 0, -0.5 mm; mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0;
                          ContactPoint p { location = 0, 0, 0; } } }
}
)")
                                                   .experiment;
  simulation::Experiment experiment = plain;
  experiment.contact = law;
  experiment.integrator = integrator;
  experiment.deltat = dt;
  const double k = std::pow(10., drawn(random, 3., 5.));
  const double k_t = std::pow(10., drawn(random, 3., 5.));
  const double c = drawn(random, 0., 50.);
  const double mu_k = drawn(random, 0.2, 1.);
  const double mu_s = mu_k + std::max(0., drawn(random, -0.3, 0.3));
  for (simulation::MaterialSpec& material : experiment.materials) {
    auto& constants = material.constants;
    constants.normal_stiffness = constants.nominal_stiffness = k;
    constants.normal_damping = c;
    constants.tangential_stiffness = k_t;
    constants.tangential_damping = c_t;
    constants.kinetic_friction = mu_k;
    constants.static_friction = mu_s;
  }
  return experiment;
}

/// The most that friction has given beyond what was stored, along a path [J]; `unresolved`: what a
/// step's work may be off whose force changes by df on the way dx, |df| |dx| [J].
struct Gift {
  double most = 0., unresolved = 0., taken = 0.;
};

Gift friction_along(std::mt19937_64& random, const std::string& law,
                    const integrators::StepperDescription& method, double c_t, double dt,
                    int steps) {
  const auto experiment = any_experiment(random, law, std::string(method.name), c_t, dt);
  LedPoint point(experiment, any_path(random));
  const auto stepper = method.make(point, {});
  Gift gift;
  Vector3d before;
  for (int i = 0; i < steps; ++i) {
    const double t = i * dt;
    point.accept(t);
    const double held = point.stored();
    const Vector3d now = point.friction();
    const Status status = stepper->step(point, t, dt, point.q, point.v);
    EXPECT_EQ(status, Status::ok) << law << " " << method.name << " c_t " << c_t;
    if (status != Status::ok) break;
    gift.unresolved += norm(now - before) * dt * norm(point.velocity());
    before = now;
    // A hook's stretch is that of the step's start, whose force has worked by now.
    gift.most = std::max(gift.most, point.work() + (point.has_bristle() ? point.stored() : held));
    gift.taken = std::max(gift.taken, -point.work());
  }
  return gift;
}

const std::vector<std::string> laws{"hookpoint",         "hookpoint_reset", "nominal",
                                    "hunt_crossley",     "lugre",           "elastoplastic",
                                    "azad_featherstone", "exponential"};

class Friction : public ::testing::TestWithParam<std::string> {};

TEST_P(Friction, NeverGivesWhatWasNotStored) {
  const auto& method = *integrators::find_stepper(GetParam());
  const bool moves_first = method.name == "semi_implicit_euler" || method.implicit_joints;
  const int paths = method.adaptive() ? 2 : 30;
  for (const std::string& law : laws) {
    for (const double c_t : {0., 1e-3, 0.05, 1., 30.}) {
      for (const double dt : {1e-4, 1e-3}) {
        std::mt19937_64 random(7);
        const bool short_way = method.adaptive();
        double taken = 0.;
        for (int i = 0; i < paths; ++i) {
          const Gift gift = friction_along(random, law, method, c_t, dt, short_way ? 30 : 300);
          // The semi-implicit step's inequality is exact, an adaptive one's to its tolerance.
          const double allowed = moves_first ? 1e-12 : method.adaptive() ? 1e-6 : gift.unresolved;
          EXPECT_LE(gift.most, allowed) << law << " c_t " << c_t << " dt " << dt << " path " << i;
          // Whatever its own forces say: where a step resolves the path, whose fastest turn takes
          // 10 ms, in a hundred parts, it gives a small part of what it took.
          if (dt == 1e-4) {
            EXPECT_LE(gift.most, 0.2 * gift.taken + 1e-9) << law << " c_t " << c_t << " path " << i;
          }
          taken = std::max(taken, gift.taken);
        }
        EXPECT_GT(taken, 1e-4) << law;  // else nothing has been tried
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, Friction,
                         ::testing::Values("explicit_euler", "semi_implicit_euler",
                                           "implicit_joints", "rk4", "cvode_bdf", "cvode_adams",
                                           "arkode", "arkode_imex"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace hookpoint
