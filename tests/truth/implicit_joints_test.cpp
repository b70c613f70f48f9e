// The integrator implicit_joints: implicit Euler's recurrence of one joint, the equation of a step of
// random arms against a dense solution, steps far above what springs of joints bear elsewhere.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <eigen3/Eigen/Dense>
#include <string>

#include "simulation/analysis/stability.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

constexpr double J = 0.02, k = 5e3, c = 0.3, h = 1e-3;

std::string wheel(const std::string& integrator, const std::string& more) {
  return fmt::format(
      "World w {{ gravity = 0; deltat = {} s; integrator = {}; Robot r {{ Base.fixed {{ }} Chain a {{ "
      "Link l {{ mass = 1; inertia = 1, 1, {}, 0, 0, 0; {} }} }} }} }}",
      h, integrator, J, more);
}

std::string spring() { return fmt::format("stiffness = {}; damping = {}; ", k, c); }

// Implicit Euler of J q'' + c q' + k q = 0: (J + h c + h^2 k) v1 = J v0 - h k q0, q1 = q0 + h v1. The step is
// a quarter of what semi-implicit Euler bears.
TEST(ImplicitJoints, AreImplicitEulersRecurrence) {
  Running run(wheel("implicit_joints", spring() + "angle = 0.1; rate = 2;"));
  double q = 0.1, v = 2.;
  for (int i = 0; i < 200; ++i) {
    const double before = v;
    v = (J * v - h * k * q) / (J + h * c + h * h * k);
    q += h * v;
    run.step();
    ASSERT_NEAR(run["w.r.a.l.angle"], q, 1e-13) << i;
    ASSERT_NEAR(run["w.r.a.l.rate"], v, 1e-10) << i;
    // What the joint has exerted.
    ASSERT_NEAR(run["w.r.a.l.total_torque"], J * (v - before) / h, 1e-9) << i;
  }
}

// However stiff: w h = 1000 comes to rest within a few steps, where semi-implicit Euler leaves all
// numbers.
TEST(ImplicitJoints, BearAnyStiffness) {
  const std::string stiff = "stiffness = 2e10; angle = 0.1;";
  Running run(wheel("implicit_joints", stiff));
  run.step(5);
  EXPECT_LT(std::abs(run["w.r.a.l.angle"]), 1e-6);
  const auto bound = [&](const char* integrator) {
    return simulation::stability_bound(*load_text(wheel(integrator, stiff)).experiment).step;
  };
  EXPECT_TRUE(std::isinf(bound("implicit_joints")));
  EXPECT_NEAR(bound("semi_implicit_euler"), 2. / std::sqrt(2e10 / J), 1e-9);
}

// tau_f/(v_f J) h = 100: friction stops the wheel without turning it back, and until then takes
// tau_f/J a second.
TEST(ImplicitJoints, DryFrictionStopsAJointAndDoesNotTurnItBack) {
  const double tau = 0.2, J_over_tau = J / tau;
  Running run(wheel("implicit_joints",
                    fmt::format("friction = {}; friction_speed = 1e-4; friction_deflection = 1e-5; "
                                "rate = 1;",
                                tau)));
  double v = 1., q = 0.;
  for (int i = 0; i < 300; ++i) {
    run.step();
    const double next = run["w.r.a.l.rate"];
    if (v > 0.05) {
      ASSERT_NEAR((v - next) / h * J_over_tau, 1., 0.15) << i;
    }
    ASSERT_GT(next, -1e-4) << i;
    v = next;
    q = run["w.r.a.l.angle"];
  }
  EXPECT_NEAR(v, 0., 1e-4);
  EXPECT_NEAR(q, 0.5 * J_over_tau, 0.02 * J_over_tau);  // v^2 J/(2 tau)
}

// A stop is a spring too: a wheel comes against it at 3 rad/s, and stays within sqrt(J/k_l) v.
TEST(ImplicitJoints, AStopHolds) {
  Running run(wheel("implicit_joints",
                    "upper_limit = 0.1; limit_stiffness = 1e6; limit_damping = 5; rate = 3;"));
  double farthest = 0.;
  for (int i = 0; i < 200; ++i) {
    run.step();
    farthest = std::max(farthest, run["w.r.a.l.angle"]);
  }
  EXPECT_GT(farthest, 0.1);
  EXPECT_LT(farthest, 0.1 + 3. * h + std::sqrt(J / 1e6) * 3.);
  EXPECT_LT(run["w.r.a.l.rate"], 0.);
}

// (M + h C + h^2 K) a = M a_f((v0 + v1)/2) - h K v0 - C v0 with v1 = v0 + h a: a_f(v) are the
// accelerations that springs, torques and bias forces of v give, from a step of explicit Euler
// without dampers; M comes from those that unit torques give, which are the columns of M^-1. The arm
// moves so slowly that the one iteration that is made for (v0 + v1)/2 leaves less than 1e-8 of a.
TEST(ImplicitJoints, OfAnArmSolveTheDenseEquation) {
  constexpr int n = 4;
  const double stiffness[n] = {3e3, 8e2, 5e4, 20.}, damping[n] = {0.5, 3., 0., 40.};
  const double rotor[n] = {0., 0.01, 0., 0.};
  const double step = 2e-3;
  Eigen::VectorXd v0(n);
  for (int i = 0; i < n; ++i) v0[i] = 0.05 - 0.03 * i;
  const auto accelerations = [&](const std::string& integrator, const Eigen::VectorXd& rates,
                                 bool damped, int pushed) {
    std::string links;
    for (int i = 0; i < n; ++i)
      links += fmt::format(
          "Link l{} {{ dhlength = {}; dhtwist = {}; joint = {}; mass = {}; center_of_mass = 0.1, 0.02, "
          "0.03; inertia = 0.01, 0.02, 0.025, 0.001, 0, 0; stiffness = {}; damping = {}; "
          "rotor_inertia = {}; angle = {}; rest_angle = {}; rate = {}; torque = {}; }} ",
          i, i == 0 ? 0. : 0.2, 0.4 * i, i == 2 ? "prismatic" : "revolute", 1. / (1. + i),
          stiffness[i], damped ? damping[i] : 0., rotor[i], 0.1 * (i + 1), 0.0999 * (i + 1),
          rates[i], pushed == i ? 1. : 0.);
    Running run(fmt::format(
        "World w {{ deltat = {} s; integrator = {}; Robot r {{ Base.fixed {{ }} Chain a {{ {} }} }} }}",
        step, integrator, links));
    run.step();
    Eigen::VectorXd a(n);
    for (int i = 0; i < n; ++i) a[i] = (run[fmt::format("w.r.a.l{}.rate", i)] - rates[i]) / step;
    return a;
  };
  const auto free = [&](const Eigen::VectorXd& rates, int pushed) {
    return accelerations("explicit_euler", rates, false, pushed);
  };
  Eigen::MatrixXd inverse(n, n);
  for (int i = 0; i < n; ++i) inverse.col(i) = free(v0, i) - free(v0, -1);
  const Eigen::MatrixXd M = inverse.inverse();
  const Eigen::VectorXd K = Eigen::Map<const Eigen::VectorXd>(stiffness, n),
                        C = Eigen::Map<const Eigen::VectorXd>(damping, n);
  Eigen::MatrixXd A = M;
  A.diagonal() += step * C + step * step * K;
  Eigen::VectorXd truth = Eigen::VectorXd::Zero(n);
  for (int round = 0; round < 20; ++round)
    truth = A.lu().solve(M * free(v0 + 0.5 * step * truth, -1) - step * K.cwiseProduct(v0) -
                         C.cwiseProduct(v0));
  const Eigen::VectorXd a = accelerations("implicit_joints", v0, true, -1);
  EXPECT_LE((a - truth).norm(), 1e-8 * truth.norm());
  EXPECT_GT((a - free(v0, -1)).norm(), 0.1 * a.norm());
}

}  // namespace
}  // namespace hookpoint
