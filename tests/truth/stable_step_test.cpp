// The largest stable step of linear dynamics with several modes: what an integrator says of its
// stability in closed form against what is found from its steps, and that against a run.
// ctest: alone
#include "simulation/analysis/stable_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <eigen3/Eigen/LU>
#include <vector>

#include "integrators/cvode.h"
#include "integrators/explicit_euler.h"
#include "integrators/implicit_joints.h"
#include "integrators/rk4.h"
#include "integrators/semi_implicit_euler.h"
#include "integrators/vector_space_system.h"

namespace hookpoint::simulation {
namespace {

using integrators::StepperDescription;

/// Three coordinates, K and C of no common modes.
LinearDynamics coupled(double damping) {
  LinearDynamics dynamics;
  dynamics.stiffness = Eigen::Matrix3d{{900., -300., 0.}, {-300., 500., -100.}, {0., -100., 200.}};
  dynamics.damping = damping * Eigen::Matrix3d{{2., 0., -1.}, {0., 4., 0.}, {-1., 0., 6.}};
  dynamics.joints = Eigen::MatrixXd::Zero(0, 3);
  // Springs and dampers of the first and the last coordinate alone; the rest resists too.
  dynamics.of_joints.stiffness = Eigen::Vector3d(400., 0., 50.).asDiagonal();
  dynamics.of_joints.damping = damping * Eigen::Vector3d(1., 0., 2.).asDiagonal().toDenseMatrix();
  return dynamics;
}

StepperDescription silent(StepperDescription stepper) {
  stepper.stability = integrators::BoundFromSteps{};
  return stepper;
}

const StepperDescription methods[] = {integrators::explicit_euler, integrators::semi_implicit_euler,
                                      integrators::implicit_joints, integrators::rk4};

TEST(StableStep, InClosedFormIsThatOfTheStepsThemselves) {
  for (const StepperDescription& method : methods) {
    for (const double damping : {1., 3., 10.}) {
      const LinearDynamics dynamics = coupled(damping);
      const double bound = largest_stable_step(method, dynamics);
      EXPECT_GT(bound, 1e-4) << method.name;
      EXPECT_NEAR(largest_stable_step(silent(method), dynamics) / bound, 1., 1e-6)
          << method.name << " " << damping;
    }
  }
}

TEST(StableStep, OfABoundThatIsNotBelowSaysOnlyThat) {
  const StepperDescription method = silent(integrators::rk4);
  const LinearDynamics dynamics = coupled(1.);
  const double bound = largest_stable_step(method, dynamics);
  EXPECT_EQ(largest_stable_step(method, dynamics, {}, 0.9 * bound), 0.9 * bound);
  EXPECT_EQ(largest_stable_step(method, dynamics, {}, 1.1 * bound), bound);
}

// A search for such a step would never end.
TEST(StableStep, OfARateBeyondTheRangeOfNumbersIsNone) {
  for (const StepperDescription& method : methods) {
    LinearDynamics dynamics = coupled(1.);
    dynamics.damping.setConstant(1.7e308);
    dynamics.of_joints.damping.setZero();
    EXPECT_EQ(largest_stable_step(method, dynamics), 0.) << method.name;
  }
}

TEST(StableStep, OfWhatFeelsNoForceAndOfAnAdaptiveIntegratorIsAny) {
  LinearDynamics free = coupled(1.);
  EXPECT_TRUE(std::isinf(largest_stable_step(integrators::cvode_bdf, free)));
  free.stiffness.setZero();
  free.damping.setZero();
  free.of_joints = {free.stiffness, free.damping};
  for (const StepperDescription& method : methods) {
    EXPECT_TRUE(std::isinf(largest_stable_step(method, free)));
    EXPECT_TRUE(std::isinf(largest_stable_step(silent(method), free)));
  }
}

class Mechanism final : public integrators::VectorSpaceSystem {
 public:
  explicit Mechanism(const LinearDynamics& dynamics)
      : VectorSpaceSystem(static_cast<std::size_t>(dynamics.stiffness.rows())),
        dynamics_(dynamics) {}
  integrators::Status accelerations(integrators::Stage, double, std::span<const double> q,
                                    std::span<const double> v, std::span<double> a) override {
    const Eigen::Index n = dynamics_.stiffness.rows();
    const Eigen::Map<const Eigen::VectorXd> z(q.data(), n), rate(v.data(), n);
    Eigen::Map<Eigen::VectorXd> acceleration(a.data(), n);
    acceleration = -dynamics_.stiffness * z - dynamics_.damping * rate;
    if (h_ == 0.) return integrators::Status::ok;
    const auto& [K, C] = dynamics_.of_joints;
    acceleration = (Eigen::MatrixXd::Identity(n, n) + h_ * C + h_ * h_ * K)
                       .lu()
                       .solve(acceleration - h_ * K * rate)
                       .eval();
    return integrators::Status::ok;
  }
  void take_joints_at_end_of(double h) override { h_ = h; }

 private:
  const LinearDynamics& dynamics_;
  double h_ = 0.;
};

/// How much more it moves in the last quarter of 4000 steps than in the first.
double growth(const StepperDescription& method, const LinearDynamics& dynamics, double dt) {
  Mechanism system(dynamics);
  const auto stepper = method.make(system, {});
  std::vector<double> q(system.position_size(), 1.), v(system.velocity_size(), 0.);
  double first = 0., last = 0.;
  for (int i = 0; i < 4000; ++i) {
    if (stepper->step(system, i * dt, dt, q, v) != integrators::Status::ok) return INFINITY;
    double& most = i < 1000 ? first : last;
    for (const double x : q)
      if (i < 1000 || i >= 3000) most = std::max(most, std::abs(x));
  }
  return last / first;
}

TEST(StableStep, IsWhereAMotionBeginsToGrow) {
  for (const StepperDescription& method : methods) {
    const LinearDynamics dynamics = coupled(10.);
    const double bound = largest_stable_step(silent(method), dynamics);
    EXPECT_LE(growth(method, dynamics, 0.99 * bound), 1.001) << method.name;
    EXPECT_GE(growth(method, dynamics, 1.01 * bound), 1.1) << method.name;
  }
}

}  // namespace
}  // namespace hookpoint::simulation
