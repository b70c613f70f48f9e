// Impacts of one instant together: flat landings of boxes, against closed forms and conservation laws,
// whatever the order and number of their points; slender bodies.
#include "contact/impulse/simultaneous_collisions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "contact/impulse/collision.h"
#include "contact/impulse/impulse_advance.h"

namespace hookpoint::contact {
namespace {

const ImpulseLoad kWeightless{};

struct Plane {
  MaterialConstants<double> material{};
  Vector3d normal{0., 0., 1.};
  GroundPoint operator()(const Vector3d& point) const {
    return {dot(point, normal), normal, &material};
  }
};

constexpr double kMass = 3., kLength = 0.4, kWidth = 0.3, kHeight = 0.1;

/// A box with `per_side`^2 points on its lower face.
ImpulseBody box(int per_side) {
  ImpulseBody body;
  body.mass = kMass;
  const double x2 = kLength * kLength, y2 = kWidth * kWidth, z2 = kHeight * kHeight;
  body.inertia = {
      kMass * (y2 + z2) / 12., kMass * (x2 + z2) / 12., kMass * (x2 + y2) / 12., 0., 0., 0.};
  for (int i = 0; i < per_side; ++i) {
    for (int j = 0; j < per_side; ++j) {
      body.boundary_points.push_back({kLength * (i / (per_side - 1.) - 0.5),
                                      kWidth * (j / (per_side - 1.) - 0.5), -0.5 * kHeight});
    }
  }
  return body;
}

ImpulseState landed(const ImpulseBody& body, const ImpulseState& before, const Plane& ground,
                    ImpulseLaw law = ImpulseLaw::impulse) {
  ImpulseState state = before;
  ImpulseAdvance engine(body, law);
  const AdvanceResult result = engine.advance(state, 1e-6, kWeightless, ground);
  EXPECT_EQ(result.status, AdvanceStatus::ok);
  EXPECT_EQ(result.order_matters, OrderCause::none);
  return state;
}

const ImpulseState kFalling{{0., 0., 0.5 * kHeight}, {}, {0., 0., -2.}, {}};

// By symmetry: e v, no spin, no drift.
TEST(SimultaneousCollisions, ABoxThatLandsFlatLeavesFlatWhateverItsPointsAndTheirOrder) {
  std::mt19937 random(3);
  for (const ImpulseLaw law : {ImpulseLaw::impulse, ImpulseLaw::impulse_reversal}) {
    for (const double e : {0., 0.6, 1.}) {
      for (const double mu : {0., 0.5}) {
        for (const int per_side : {2, 3, 10}) {
          Plane ground;
          ground.material.restitution = e;
          ground.material.kinetic_friction = mu;
          ground.material.rebound_speed = 1e-3;
          ImpulseBody body = box(per_side);
          for (int order = 0; order < 24; ++order) {
            const ImpulseState s = landed(body, kFalling, ground, law);
            EXPECT_LT(norm(s.velocity - Vector3d{0., 0., std::max(2. * e, 1e-3)}), 1e-10);
            EXPECT_LT(norm(s.angular_velocity), 1e-9);
            std::shuffle(body.boundary_points.begin(), body.boundary_points.end(), random);
          }
        }
      }
    }
  }
}

// The projection of -v on what cannot approach is a translation, wherever the centre of mass is above
// the face: e v again.
TEST(SimultaneousCollisions, ALopsidedBoxLeavesFlatToo) {
  Plane ground;
  ground.material.restitution = 0.7;
  ground.material.kinetic_friction = 0.;
  ImpulseBody body = box(2);
  body.center_of_mass = {0.07, -0.05, 0.02};
  const ImpulseState s = landed(body, kFalling, ground);
  EXPECT_LT(norm(s.velocity - Vector3d{0., 0., 1.4}), 1e-10);
  EXPECT_LT(norm(s.angular_velocity), 1e-9);
}

// Coulomb: a box that slides without tipping (mu height < length) loses mu (1 + e) v_n of its speed at e = 0,
// where friction is all along one direction and the normal impulse is m v_n.
TEST(SimultaneousCollisions, ABoxThatLandsSlidingFeelsTheLimitOfFriction) {
  Plane ground;
  ground.material.kinetic_friction = 0.5;
  ground.material.rebound_speed = 0.;
  ImpulseState before = kFalling;
  before.velocity.x = 3.;
  const ImpulseState s = landed(box(2), before, ground);
  EXPECT_NEAR(s.velocity.x, 3. - 0.5 * 2., 1e-10);
  EXPECT_NEAR(s.velocity.z, 0., 1e-10);
  EXPECT_LT(norm(s.angular_velocity), 1e-9);
}

// Mirrored at the xz plane before or after: the same.
TEST(SimultaneousCollisions, MirrorImagesStayMirrorImages) {
  Plane ground;
  ground.material.kinetic_friction = 0.4;
  ground.material.restitution = 0.5;
  ImpulseState a = kFalling, b = kFalling;
  a.velocity = {1., 2., -2.};
  b.velocity = {1., -2., -2.};
  a.angular_velocity = {0., 0., 3.};
  b.angular_velocity = {0., 0., -3.};
  const ImpulseState p = landed(box(2), a, ground), q = landed(box(2), b, ground);
  EXPECT_NEAR(p.velocity.x, q.velocity.x, 1e-8);
  EXPECT_NEAR(p.velocity.y, -q.velocity.y, 1e-8);
  EXPECT_NEAR(p.angular_velocity.x, -q.angular_velocity.x, 1e-7);
  EXPECT_NEAR(p.angular_velocity.y, q.angular_velocity.y, 1e-7);
  EXPECT_NEAR(p.angular_velocity.z, -q.angular_velocity.z, 1e-7);
}

struct RandomSet {
  std::vector<Matrix3d> K;
  std::vector<CollidingPoint> points;
};

/// Points of a random rigid body above planes of random slope; of slope 0 its lower face lands.
RandomSet random_set(std::mt19937& random, std::size_t count, double slope = 1.) {
  std::uniform_real_distribution<double> unit(-1., 1.);
  const auto vector = [&] { return Vector3d{unit(random), unit(random), unit(random)}; };
  RandomSet set;
  const Vector3d v{unit(random), unit(random), -1.5}, w = vector();
  const Vector3d per_moment{5. + 4. * unit(random), 5. + 4. * unit(random), 5. + 4. * unit(random)};
  std::vector<Vector3d> arms;
  for (std::size_t i = 0; i < count; ++i) {
    arms.push_back({0.5 * unit(random), 0.5 * unit(random), -0.2});
    const Vector3d n = slope * vector() + Vector3d{0., 0., 4.};
    set.points.push_back({v + cross(w, arms[i]),
                          (1. / norm(n)) * n,
                          0.6 + 0.6 * unit(random),
                          0.5 + 0.5 * unit(random),
                          0.,
                          {}});
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const Matrix3d turning =
          cross_matrix(arms[i]) *
          general(Symmetric3d{per_moment.x, per_moment.y, per_moment.z, 0., 0., 0.}) *
          cross_matrix(arms[j]);
      set.K.push_back(Matrix3d::identity() + -1. * turning);
    }
  }
  return set;
}

// Whether normals differ or all are one, so that three points of a face are redundant.
TEST(SimultaneousCollisions, ImpulsesAreInTheConeSeparateAndTakeEnergyInAnyOrder) {
  std::mt19937 random(11);
  SimultaneousCollisions together(8);
  int solved = 0, converged = 0, all = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const std::size_t count = 2 + static_cast<std::size_t>(trial) % 7;
    RandomSet set = random_set(random, count, trial % 4 == 0 ? 0. : 1.);
    const auto K = [&](std::size_t i, std::size_t j) { return set.K[i * count + j]; };
    ++all;
    std::vector<CollidingPoint>& p = set.points;
    if (!together.resolve(p, K)) continue;
    ++solved;
    if (together.converged()) ++converged;
    double energy = 0.;
    for (std::size_t i = 0; i < count; ++i) {
      Vector3d change;
      for (std::size_t j = 0; j < count; ++j) change += K(i, j) * p[j].impulse;
      energy += dot(p[i].impulse, p[i].u + 0.5 * change);
      const double pn = dot(p[i].impulse, p[i].normal);
      EXPECT_LE(norm(tangential(p[i].impulse, p[i].normal)), p[i].mu * pn + 1e-12);
      EXPECT_GE(dot(p[i].normal, p[i].u + change), -1e-9);
    }
    EXPECT_LE(energy, 1e-9);
    // In another order: the same change of every point's velocity.
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = count - 1 - i;
    if (trial % 2 == 0) std::shuffle(order.begin(), order.end(), random);
    std::vector<CollidingPoint> other;
    for (const std::size_t i : order) other.push_back(p[i]);
    ASSERT_TRUE(together.resolve(
        other, [&](std::size_t i, std::size_t j) { return K(order[i], order[j]); }));
    for (std::size_t i = 0; i < count; ++i) {
      Vector3d difference;
      for (std::size_t j = 0; j < count; ++j)
        difference += K(order[i], order[j]) * (p[order[j]].impulse - other[j].impulse);
      EXPECT_LT(norm(difference), 1e-6) << trial;
    }
  }
  EXPECT_EQ(solved, all);
  EXPECT_EQ(converged, all);
}

// Two points on either side of a plane of symmetry, in which the body moves: equal impulses p, so that
// du = (K_11 + K_12) p in the plane. One collision with this K, which may slip, stop, turn back or jam there.
TEST(SimultaneousCollisions, TwoCornersOfAPlaneOfSymmetryAreOneCollision) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0., 1.);
  SimultaneousCollisions together(2);
  const double kInertia = 1. / 3.;
  int turned = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double lean = std::numbers::pi * (0.1 + 0.8 * unit(random)), mu = 2. * unit(random);
    const double e = unit(random), aside = 0.3 * unit(random);
    const Vector3d u{6. * unit(random) - 3., 0., -0.2 - unit(random)};
    const std::array<Vector3d, 2> arms{Vector3d{-std::cos(lean), aside, -std::sin(lean)},
                                       Vector3d{-std::cos(lean), -aside, -std::sin(lean)}};
    const auto K = [&](std::size_t i, std::size_t j) {
      return Matrix3d::identity() +
             (-1. / kInertia) * (cross_matrix(arms[i]) * cross_matrix(arms[j]));
    };
    std::array<CollidingPoint, 2> points;
    for (CollidingPoint& point : points) point = {u, {0., 0., 1.}, mu, e, 0., {}};
    ASSERT_TRUE(together.resolve(points, K));
    // In the plane K_11 + K_12 = 2 (1 + (r^2 1 - r r^T)/I); across it any that does not couple.
    const double x = arms[0].x, z = arms[0].z;
    const Symmetric3d pair{2. * (1. + z * z / kInertia), 2., 2. * (1. + x * x / kInertia), 0.,
                           -2. * x * z / kInertia,       0.};
    const Collision one = resolve_collision({pair, u, {0., 0., 1.}, mu, e, 0.});
    ASSERT_TRUE(one.solved);
    const Vector3d after = u + pair * one.impulse;
    if (after.x * u.x < 0.) ++turned;
    for (const CollidingPoint& point : points) {
      EXPECT_NEAR(point.impulse.x, one.impulse.x, 0.02 * norm(one.impulse)) << trial;
      EXPECT_NEAR(point.impulse.z, one.impulse.z, 0.02 * norm(one.impulse)) << trial;
    }
  }
  EXPECT_GT(turned, 20);  // so that the comparison has slips that turn back
}

// What stays dependent on the order of points is said, and nothing else is.
TEST(SimultaneousCollisions, TheRunKnowsWhereTheOrderOfPointsIsSeen) {
  Plane ground;
  ground.material.rebound_speed = 1e-3;
  const auto cause = [&](const ImpulseBody& body, const ImpulseState& before) {
    ImpulseState state = before;
    ImpulseAdvance engine(body, ImpulseLaw::impulse);
    ImpulseLoad weight;
    weight.gravity = {0., 0., -9.81};
    const AdvanceResult result = engine.advance(state, 1e-4, weight, ground);
    EXPECT_EQ(result.status, AdvanceStatus::ok);
    return result.order_matters;
  };
  ImpulseState resting = kFalling;
  resting.velocity = {};
  EXPECT_EQ(cause(box(2), kFalling), OrderCause::none);
  EXPECT_EQ(cause(box(2), resting), OrderCause::microcollisions);
  ImpulseBody one = box(2);
  one.boundary_points = {{0., 0., -0.5 * kHeight}};
  EXPECT_EQ(cause(one, resting), OrderCause::none);
  ImpulseBody round = box(2);
  round.boundary_points.clear();
  for (int i = 0; i < 100; ++i) {
    const double angle = 2. * std::numbers::pi * i / 100.;
    round.boundary_points.push_back({0.1 * std::cos(angle), 0.1 * std::sin(angle), -0.5 * kHeight});
  }
  EXPECT_EQ(cause(round, kFalling), OrderCause::many_corners);
}

/// Two feet of unit mass that move one another by `shared` of an impulse, on bodies of their own.
class TwoFeet final : public StruckRobot {
 public:
  TwoFeet(double shared, double first, double second) : shared_(shared) {
    material_.rebound_speed = 1e-3;
    ground_ = {0., {0., 0., 1.}, &material_};
    u_ = {Vector3d{0., 0., -first}, Vector3d{0., 0., -second}};
  }
  std::size_t point_count() const override { return 2; }
  const GroundPoint& ground(std::size_t /*point*/) const override { return ground_; }
  Vector3d velocity(std::size_t point) const override { return u_[point]; }
  Symmetric3d collision_matrix(std::size_t point) override {
    return symmetric_part(coupling(point, point));
  }
  Matrix3d coupling(std::size_t i, std::size_t j) override {
    return (i == j ? 1. : shared_) * Matrix3d::identity();
  }
  bool same_bodies(std::size_t i, std::size_t j) const override { return i == j; }
  Vector3d place(std::size_t point) const override { return {static_cast<double>(point), 0., 0.}; }
  void strike(std::size_t point, const Vector3d& impulse) override {
    for (std::size_t i = 0; i < 2; ++i) u_[i] += coupling(i, point) * impulse;
  }
  double begin_reversal(std::size_t /*struck*/) override { return 0.; }
  Vector3d flight_acceleration(std::size_t /*point*/) const override { return {}; }
  bool find_reversal(std::span<ReversalPoint> /*points*/, std::span<const std::size_t> /*index*/,
                     double /*tolerance*/) override {
    return false;
  }

 private:
  double shared_;
  MaterialConstants<double> material_{};
  GroundPoint ground_;
  std::array<Vector3d, 2> u_;
};

TEST(SimultaneousCollisions, FeetThatLandEquallyFastAreNotedIfTheyActOnEachOther) {
  const auto cause = [](double shared, double first, double second) {
    TwoFeet feet(shared, first, second);
    ImpulseResolution resolution(2, ImpulseLaw::impulse, {});
    ImpulseTally tally;
    resolution.begin_step();
    EXPECT_EQ(resolution.resolve(feet, tally), AdvanceStatus::ok);
    return tally.order_matters;
  };
  EXPECT_EQ(cause(0.5, 2., 2.), OrderCause::different_bodies);
  EXPECT_EQ(cause(0.5, 2., 1.9), OrderCause::none);
  EXPECT_EQ(cause(0., 2., 2.), OrderCause::none);
  EXPECT_EQ(cause(0.5, 1e-3, 1e-3), OrderCause::microcollisions);
  EXPECT_EQ(cause(0., 1e-3, 1e-3), OrderCause::none);
}

// Of one point: Routh's path, within what parts of a path leave.
TEST(SimultaneousCollisions, OnePointIsTheSingleCollision) {
  std::mt19937 random(5);
  SimultaneousCollisions together(1);
  for (int trial = 0; trial < 300; ++trial) {
    RandomSet set = random_set(random, 1);
    CollidingPoint& point = set.points[0];
    if (dot(point.u, point.normal) >= 0.) continue;
    const Collision one = resolve_collision({symmetric_part(set.K[0]), point.u, point.normal,
                                             point.mu, point.restitution, point.rebound_speed});
    ASSERT_TRUE(together.resolve(set.points, [&](std::size_t, std::size_t) { return set.K[0]; }));
    EXPECT_LT(norm(one.impulse - point.impulse), 0.02 * norm(one.impulse)) << trial;
  }
}

// A rod of length 2 l that leans strikes with its tip without friction: plane impact, whatever the moment
// about the rod itself. v_n' = -e v_n of the tip; p = (1 + e) v/(1/m + l^2 cos^2/I).
TEST(SlenderBody, TheMomentAboutARodPlaysNoPart) {
  const double lean = std::numbers::pi / 3., v = 0.1, e = 0.6, I = 1. / 3.;
  for (const double spin : {1e-3, 1e-6, 1e-7, 1e-10}) {
    for (const double azimuth : {0., 0.4, 2.}) {
      for (const double mu : {0., 2.}) {
        ImpulseBody rod;
        rod.mass = 1.;
        rod.inertia = {spin, I, I, 0., 0., 0.};
        rod.boundary_points = {{-1., 0., 0.}};
        Plane ground;
        ground.material.kinetic_friction = mu;
        ground.material.restitution = e;
        ImpulseState s{
            {0., 0., std::sin(lean)},
            exponential(Vector3d{0., 0., azimuth}) * exponential(Vector3d{0., -lean, 0.}),
            {0., 0., -v},
            {}};
        ImpulseAdvance engine(rod, ImpulseLaw::impulse);
        ASSERT_EQ(engine.advance(s, 1e-3, kWeightless, ground).status, AdvanceStatus::ok);
        // With friction that holds (tan 30 deg < mu) the tip turns back along the normal: p = K^-1 du
        // in the plane; about the tip the angular momentum stays: I w = -m l cos (v_z + v) + m l sin v_x.
        const double w = mu > 0. ? (1. + e) * v * std::cos(lean) / (1. + I)
                                 : (1. + e) * v * std::cos(lean) /
                                       (I * (1. + std::cos(lean) * std::cos(lean) / I));
        EXPECT_NEAR(norm(s.angular_velocity), w, 1e-8 * w) << spin << ' ' << azimuth << ' ' << mu;
      }
    }
  }
}

}  // namespace
}  // namespace hookpoint::contact
