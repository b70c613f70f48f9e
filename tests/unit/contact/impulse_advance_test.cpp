// The event-driven time advance: flight, impact times, what it refuses, and what it keeps.
#include "contact/impulse/impulse_advance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/allocation_counter.h"

namespace hookpoint::contact {
namespace {

const ImpulseLoad kGravity{{0., 0., -9.81}, {}, {}};
const ImpulseLoad kWeightless{};

/// A plane through the origin.
struct Plane {
  Vector3d normal{0., 0., 1.};
  MaterialConstants<double> material{};
  GroundPoint operator()(const Vector3d& point) const {
    return {dot(point, normal), normal, &material};
  }
};

ImpulseBody block() {
  ImpulseBody body;
  body.mass = 1.;
  body.inertia = {0.05 / 12., 0.05 / 12., 0.08 / 12., 0., 0., 0.};
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double z : {-0.05, 0.05}) body.boundary_points.push_back({x, y, z});
    }
  }
  return body;
}

double energy(const ImpulseBody& body, const ImpulseState& s, const Vector3d& gravity) {
  const Vector3d c = rotate(s.orientation, body.center_of_mass);
  const Vector3d v = s.velocity + cross(s.angular_velocity, c);
  const Vector3d w = rotate(conjugate(s.orientation), s.angular_velocity);
  return 0.5 * body.mass * dot(v, v) + 0.5 * dot(w, body.inertia * w) -
         body.mass * dot(gravity, s.position + c);
}

Vector3d angular_momentum(const ImpulseBody& body, const ImpulseState& s) {
  const Vector3d w = rotate(conjugate(s.orientation), s.angular_velocity);
  return rotate(s.orientation, body.inertia * w);
}

TEST(ImpulseAdvance, FlightKeepsMomentumAndEnergyAndFollowsTheParabola) {
  ImpulseBody body = block();
  body.center_of_mass = {0.03, -0.02, 0.01};
  body.inertia = {0.004, 0.007, 0.009, 0.0005, -0.0003, 0.0002};
  const Plane ground;
  ImpulseAdvance engine(body, ImpulseLaw::impulse);
  ImpulseState s{{0., 0., 6.}, exponential(Vector3d{0.3, 0.2, -0.5}), {3., -2., 4.}, {5., -8., 6.}};
  const auto mass_center = [&] { return s.position + rotate(s.orientation, body.center_of_mass); };
  const Vector3d c0 = mass_center();
  const Vector3d v0 = s.velocity + cross(s.angular_velocity, c0 - s.position);
  const Vector3d L0 = angular_momentum(body, s);
  const double E0 = energy(body, s, kGravity.gravity);
  for (int step = 0; step < 200; ++step) {
    ASSERT_EQ(engine.advance(s, 5e-3, kGravity, ground).status, AdvanceStatus::ok);
  }
  EXPECT_LT(norm(mass_center() - (c0 + v0 + 0.5 * kGravity.gravity)), 1e-12);
  EXPECT_LT(norm(angular_momentum(body, s) - L0), 1e-13);
  EXPECT_NEAR(energy(body, s, kGravity.gravity), E0, 1e-7 * 0.5);
}

// Torque-free symmetric top: R(t) = exp(t L/A) R0 exp(t w3 (1 - C/A) e3).
TEST(ImpulseAdvance, SymmetricTopPrecessesAsEulerSays) {
  ImpulseBody body;
  body.mass = 1.;
  const double A = 0.02, C = 0.05;
  body.inertia = {A, A, C, 0., 0., 0.};
  const Plane ground;
  const Quaterniond R0 = exponential(Vector3d{0.4, -0.7, 0.2});
  ImpulseState s{{}, R0, {}, rotate(R0, Vector3d{1., 0.5, 3.})};
  const Vector3d L = angular_momentum(body, s);
  ImpulseAdvance engine(body, ImpulseLaw::impulse);
  for (int step = 0; step < 100; ++step) engine.advance(s, 1e-2, kWeightless, ground);
  const Quaterniond exact =
      exponential((1. / A) * L) * R0 * exponential(Vector3d{0., 0., 3. * (1. - C / A)});
  const Quaterniond error = conjugate(exact) * s.orientation;
  EXPECT_LT(norm(Vector3d{error.x, error.y, error.z}), 1e-7);
}

TEST(ImpulseAdvance, ConstantForceAndTorqueActThroughTheCentreOfMass) {
  const ImpulseBody body = block();
  const Plane ground;
  ImpulseState s{{0., 0., 5.}, {}, {}, {}};
  ImpulseAdvance engine(body, ImpulseLaw::impulse);
  const ImpulseLoad load{{}, {2., 0., 0.}, {0., 0., 1e-3}};
  for (int step = 0; step < 100; ++step) engine.advance(s, 1e-2, load, ground);
  EXPECT_NEAR(s.position.x, 1., 1e-12);
  EXPECT_NEAR(s.angular_velocity.z, 1e-3 / (0.08 / 12.), 1e-12);
}

TEST(ImpulseAdvance, BouncesReachHeightsOfRestitutionSquared) {
  ImpulseBody body;
  body.mass = 0.3;
  body.inertia = {1., 1., 1., 0., 0., 0.};
  body.boundary_points = {{}};
  const double e = 0.8, h0 = 1.5, g = 9.81;
  Plane ground;
  ground.material.restitution = e;
  ImpulseAdvance engine(body, ImpulseLaw::impulse);
  ImpulseState s{{0., 0., h0}, {}, {}, {}};
  const double fall = std::sqrt(2. * h0 / g);
  // Bounce n lasts 2 e^n fall; its top comes in the middle.
  double time = fall, now = 0.;
  for (int n = 1; n <= 10; ++n) {
    time += std::pow(e, n) * fall;
    const AdvanceResult result = engine.advance(s, time - now, kGravity, ground);
    EXPECT_EQ(result.impacts, 1);
    EXPECT_EQ(result.lift_offs, 1);
    EXPECT_EQ(result.contacts, 1);
    const double landing = std::sqrt(2. * g * h0) * std::pow(e, n - 1);
    EXPECT_NEAR(result.impulse.z, body.mass * (1. + e) * landing, 1e-11);
    EXPECT_NEAR(s.position.z, h0 * std::pow(e, 2 * n), 1e-11);
    EXPECT_NEAR(s.velocity.z, 0., 1e-10);
    now = time;
    time += std::pow(e, n) * fall;
  }
}

TEST(ImpulseAdvance, SpinningBlockIsNeverInsideTheGround) {
  const ImpulseBody body = block();
  Plane ground;
  ground.material.restitution = 0.5;
  ImpulseAdvance engine(body, ImpulseLaw::impulse);
  ImpulseState s{{0., 0., 0.4}, exponential(Vector3d{0.3, 0.2, 0.}), {1., 0., -1.}, {9., 14., -5.}};
  double E = energy(body, s, kGravity.gravity);
  std::int64_t impacts = 0;
  for (int step = 0; step < 200; ++step) {
    const AdvanceResult result = engine.advance(s, 7e-3, kGravity, ground);
    ASSERT_EQ(result.status, AdvanceStatus::ok);
    EXPECT_LE(result.deepest, 1e-12);
    for (const Vector3d& point : body.boundary_points) {
      EXPECT_GE((s.position + rotate(s.orientation, point)).z, -1e-12);
    }
    const double after = energy(body, s, kGravity.gravity);
    // A microcollision may add what lifts one corner at u0.
    const double u0 = ground.material.rebound_speed;
    EXPECT_LE(after, E + 1e-9 + 0.5 * u0 * u0 * static_cast<double>(result.impacts));
    E = after;
    impacts += result.impacts;
  }
  EXPECT_GT(impacts, 5);
}

TEST(ImpulseAdvance, MomentumChangesByWhatIsReported) {
  const ImpulseBody body = block();
  const Plane ground;
  ImpulseAdvance engine(body, ImpulseLaw::impulse);
  ImpulseState s{{0., 0., 0.2}, exponential(Vector3d{0.3, 0.2, 0.}), {1., 0., -1.}, {9., 14., -5.}};
  const Vector3d v0 = s.velocity, L0 = angular_momentum(body, s);
  const double dt = 0.1;
  const AdvanceResult result = engine.advance(s, dt, kGravity, ground);
  ASSERT_GT(result.impacts, 0);
  EXPECT_LT(norm(s.velocity - v0 - dt * kGravity.gravity - result.impulse), 1e-12);
  EXPECT_LT(norm(angular_momentum(body, s) - L0 - result.angular_impulse), 1e-13);
}

TEST(ImpulseAdvance, StepsOfAnyLengthGiveTheSameFlight) {
  ImpulseBody body;
  body.mass = 1.;
  body.inertia = {1., 1., 1., 0., 0., 0.};
  body.boundary_points = {{}};
  Plane ground;
  ground.material.restitution = 0.9;
  ImpulseState fine{{0., 0., 1.}, {}, {0.3, 0., 0.}, {}}, coarse = fine;
  ImpulseAdvance engine(body, ImpulseLaw::impulse);
  for (int step = 0; step < 1000; ++step) engine.advance(fine, 1e-3, kGravity, ground);
  engine.advance(coarse, 1., kGravity, ground);
  EXPECT_LT(norm(fine.position - coarse.position), 1e-11);
  EXPECT_LT(norm(fine.velocity - coarse.velocity), 1e-10);
}

/// Level ground that turns at x = 0 into a face of slope 4, met in flight at x = 0.025: nearer than
/// one flight step reaches.
TEST(ImpulseAdvance, NextTileIsHitWhereItIs) {
  const MaterialConstants<double> bouncy{.restitution = 1.};
  const Vector3d face = (1. / std::sqrt(17.)) * Vector3d{-4., 0., 1.};
  const auto ground = [&](const Vector3d& p) {
    if (p.x < 0.) return GroundPoint{p.z, {0., 0., 1.}, &bouncy};
    return GroundPoint{dot(p, face), face, &bouncy};
  };
  ImpulseBody body;
  body.mass = 1.;
  body.inertia = {1., 1., 1., 0., 0., 0.};
  body.boundary_points = {{}};
  ImpulseAdvance engine(body, ImpulseLaw::impulse);
  ImpulseState s{{-0.96, 0., 0.1}, {}, {2., 0., 0.}, {}};
  const AdvanceResult result = engine.advance(s, 0.6, kWeightless, ground);
  ASSERT_EQ(result.status, AdvanceStatus::ok);
  EXPECT_EQ(result.impacts, 1);
  EXPECT_LE(result.deepest, 1e-12);
  // u_n = -8/sqrt(17) is reversed; u_t = 2/sqrt(17) is less than friction can take, so it sticks.
  const Vector3d v = (8. / 17.) * Vector3d{-4., 0., 1.};
  EXPECT_LT(norm(s.velocity - v), 1e-12);
  const Vector3d hit{0.025, 0., 0.1};
  EXPECT_LT(norm(s.position - (hit + (0.6 - 0.4925) * v)), 1e-11);
}

TEST(ImpulseAdvance, TroubleIsAStatusAndTheStateIsThatBefore) {
  Plane ground;
  const ImpulseState start{{0., 0., 0.05}, {}, {}, {}};
  const auto status = [&](ImpulseState s, const ImpulseLoad& load, const ImpulseBody& body) {
    const ImpulseState before = s;
    ImpulseAdvance engine(body, ImpulseLaw::impulse, {.most_impacts = 1000});
    const AdvanceResult result = engine.advance(s, 1e-2, load, ground);
    if (result.status != AdvanceStatus::ok) {
      EXPECT_EQ(s.position.z, before.position.z);
      EXPECT_STRNE(advice(result.status), "");
    }
    return result.status;
  };
  EXPECT_EQ(status(start, kGravity, block()), AdvanceStatus::ok);
  ImpulseState wrong = start;
  wrong.velocity.x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(status(wrong, kGravity, block()), AdvanceStatus::not_finite);
  ImpulseLoad load = kGravity;
  load.force.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(status(start, load, block()), AdvanceStatus::not_finite);
  wrong = start;
  wrong.position.z = 0.049;
  EXPECT_EQ(status(wrong, kGravity, block()), AdvanceStatus::inside_ground);
  ground.material.rebound_speed = 0.;  // without it a resting point is hit without end
  EXPECT_EQ(status(start, kGravity, block()), AdvanceStatus::too_many_impacts);
}

// The same resting block with more points that could be hit: each impact costs them all.
TEST(ImpulseAdvance, EndsAtItsWorkHoweverManyPointsItHas) {
  Plane ground;
  ground.material.rebound_speed = 0.;
  std::int64_t impacts_before = std::numeric_limits<std::int64_t>::max();
  for (const int copies : {1, 4, 16}) {
    ImpulseBody body = block();
    const std::vector<Vector3d> corners = body.boundary_points;
    for (int i = 1; i < copies; ++i)
      for (const Vector3d& corner : corners) body.boundary_points.push_back(0.5 * corner);
    ImpulseAdvance engine(body, ImpulseLaw::impulse, {.most_work = 1e5});
    ImpulseState s{{0., 0., 0.05}, {}, {}, {}};
    const AdvanceResult result = engine.advance(s, 1e-2, kGravity, ground);
    EXPECT_EQ(result.status, AdvanceStatus::too_many_impacts);
    EXPECT_LT(result.work, 1.01e5);
    EXPECT_LT(result.impacts, impacts_before / 2);
    impacts_before = result.impacts;
  }
}

TEST(ImpulseAdvance, AStepAllocatesNothing) {
  const Plane ground;
  for (const ImpulseLaw law : {ImpulseLaw::impulse, ImpulseLaw::impulse_reversal}) {
    ImpulseAdvance engine(block(), law);
    ImpulseState s{{0., 0., 0.0501}, exponential(Vector3d{1e-3, 0., 0.}), {0.1, 0., 0.}, {}};
    const long before = testing::allocation_count();
    const AdvanceResult result = engine.advance(s, 0.02, kGravity, ground);
    EXPECT_EQ(testing::allocation_count(), before);
    EXPECT_GT(result.impacts, 10);
  }
}

}  // namespace
}  // namespace hookpoint::contact
