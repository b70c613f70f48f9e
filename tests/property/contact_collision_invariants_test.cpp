// What every frictional collision keeps, over random rigid bodies: Coulomb's cone, energy,
// isotropy, independence of the axes.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "contact/impulse/collision.h"
#include "math/rotation.h"

namespace hookpoint::contact {
namespace {

double within(double low, double high) {
  return low +
         (high - low) * (*rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 1000001))) / 1e6;
}
Vector3d direction() {
  const double z = within(-1., 1.), angle = within(0., 6.28);
  const double s = std::sqrt(1. - z * z);
  return {s * std::cos(angle), s * std::sin(angle), z};
}

/// A random rigid body hit at a random point, by a random approach.
CollisionProblem random_problem() {
  const double m = within(0.1, 5.);
  // Moments of a solid box obey the triangle inequality, also a flat or a slender one.
  const double a = within(0.02, 1.), b = within(0.02, 1.), c = within(0.02, 1.);
  const Matrix3d R = rotation_matrix(exponential(within(0., 3.) * direction()));
  const Symmetric3d J =
      rotate(R, inverse(Symmetric3d{m / 12. * (b * b + c * c), m / 12. * (a * a + c * c),
                                    m / 12. * (a * a + b * b), 0., 0., 0.}));
  const Vector3d r = R * Vector3d{0.5 * a * within(-1., 1.), 0.5 * b * within(-1., 1.), 0.5 * c};
  const Matrix3d lever = cross_matrix(r);
  CollisionProblem problem;
  problem.K =
      Symmetric3d{1. / m, 1. / m, 1. / m, 0., 0., 0.} - symmetric_part(lever * general(J) * lever);
  problem.n = direction();
  const Vector3d slip = within(0., 3.) * tangential(direction(), problem.n);
  problem.u = slip - within(0.01, 3.) * problem.n;
  problem.mu = within(0., 1.5);
  problem.restitution = within(0., 1.);
  return problem;
}

double energy_change(const CollisionProblem& problem, const Vector3d& p) {
  return dot(p, problem.u + 0.5 * (problem.K * p));
}

TEST(CollisionInvariants, ImpulseIsInTheConeAndTakesEnergy) {
  EXPECT_TRUE(rc::check([] {
    const CollisionProblem problem = random_problem();
    const Collision collision = resolve_collision(problem);
    RC_ASSERT(collision.solved);
    const Vector3d& p = collision.impulse;
    const double pn = dot(p, problem.n);
    RC_ASSERT(pn > 0.);
    RC_ASSERT(norm(tangential(p, problem.n)) <= problem.mu * pn * (1. + 1e-8) + 1e-15);
    const double energy = 0.5 * dot(problem.u, inverse(problem.K) * problem.u);
    RC_ASSERT(energy_change(problem, p) <= 1e-8 * energy);
    RC_ASSERT(dot(problem.u + problem.K * p, problem.n) >= -1e-7 * norm(problem.u));
  }));
}

TEST(CollisionInvariants, MicrocollisionLeavesAtTheReboundSpeed) {
  EXPECT_TRUE(rc::check([] {
    CollisionProblem problem = random_problem();
    problem.restitution = 0.;
    problem.rebound_speed = within(0.001, 1.);
    const Vector3d p = resolve_collision(problem).impulse;
    RC_ASSERT(std::abs(dot(problem.u + problem.K * p, problem.n) - problem.rebound_speed) <=
              1e-7 * (norm(problem.u) + problem.rebound_speed));
  }));
}

TEST(CollisionInvariants, NoAxesArePreferred) {
  EXPECT_TRUE(rc::check([] {
    const CollisionProblem problem = random_problem();
    const Quaterniond turn = exponential(within(0., 3.) * direction());
    CollisionProblem turned = problem;
    turned.K = rotate(rotation_matrix(turn), problem.K);
    turned.u = rotate(turn, problem.u);
    turned.n = rotate(turn, problem.n);
    const Vector3d p = resolve_collision(problem).impulse;
    const Vector3d back = rotate(conjugate(turn), resolve_collision(turned).impulse);
    RC_ASSERT(norm(p - back) <= 1e-7 * norm(p));
  }));
}

TEST(CollisionInvariants, UnitsOfMassAndSpeedOnlyScale) {
  EXPECT_TRUE(rc::check([] {
    const CollisionProblem problem = random_problem();
    const double mass = within(0.01, 100.), speed = within(1e-6, 100.);
    CollisionProblem scaled = problem;
    scaled.K = (1. / mass) * problem.K;
    scaled.u = speed * problem.u;
    const Vector3d p = resolve_collision(problem).impulse;
    RC_ASSERT(norm(resolve_collision(scaled).impulse - mass * speed * p) <=
              1e-7 * mass * speed * norm(p));
  }));
}

/// A corner of a block that all but rests: any shape from flat to tall, often square; speeds over
/// many decades; slip that is nought, along a diagonal or the coupling with a hair aside, or any.
CollisionProblem resting_corner() {
  const auto decades = [](double low, double high) { return std::pow(10., within(low, high)); };
  const double m = decades(-1., 1.);
  const double a = decades(-1.7, 0.), b = within(0., 1.) < 0.5 ? a : decades(-1.7, 0.);
  const double c = decades(-1.7, 0.);
  const Symmetric3d J = inverse(Symmetric3d{m / 12. * (b * b + c * c), m / 12. * (a * a + c * c),
                                            m / 12. * (a * a + b * b), 0., 0., 0.});
  const Matrix3d lever = cross_matrix(Vector3d{0.5 * a, -0.5 * b, -0.5 * c});
  CollisionProblem problem;
  problem.K =
      Symmetric3d{1. / m, 1. / m, 1. / m, 0., 0., 0.} - symmetric_part(lever * general(J) * lever);
  const Vector3d tilted{decades(-9., -2.), decades(-9., -2.), 1.};
  problem.n = (1. / norm(tilted)) * tilted;
  const double approach = decades(-12., 0.5);
  const Vector3d along = within(0., 1.) < 0.5 ? Vector3d{a, -b, 0.} : problem.K * problem.n;
  const double side = within(0., 1.) < 0.5 ? -1. : 1.;
  const double size = within(0., 1.) < 0.1 ? 0. : approach * decades(-3., 1.) * side;
  const Vector3d slip = size * ((1. / norm(along)) * along + decades(-17., 0.) * direction());
  problem.u = tangential(slip, problem.n) - approach * problem.n;
  problem.mu = within(0., 1.5);
  problem.rebound_speed = approach * decades(-2., 2.);
  return problem;
}

TEST(CollisionInvariants, EveryRestingCornerIsAnswered) {
  EXPECT_TRUE(rc::check([] {
    for (int draw = 0; draw < 300; ++draw) {
      const CollisionProblem problem = resting_corner();
      const Collision collision = resolve_collision(problem);
      RC_ASSERT(collision.solved);
      const Vector3d& p = collision.impulse;
      const double pn = dot(p, problem.n);
      RC_ASSERT(norm(tangential(p, problem.n)) <= problem.mu * pn * (1. + 1e-8));
      RC_ASSERT(std::abs(dot(problem.u + problem.K * p, problem.n) - problem.rebound_speed) <=
                1e-7 * (norm(problem.u) + problem.rebound_speed));
    }
  }));
}

}  // namespace
}  // namespace hookpoint::contact
