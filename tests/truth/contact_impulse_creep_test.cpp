// Microcollisions on a slope: the creep of the law `impulse` is u0 tan(theta), whatever the
// friction above tan(theta); the law `impulse_reversal` does not creep; below tan(theta) both slide
// as Coulomb says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "contact/impulse/impulse_advance.h"

namespace hookpoint::contact {
namespace {

constexpr double kGravity = 9.81;
constexpr double kDegree = std::numbers::pi / 180.;

struct Slope {
  Slope(double theta, double azimuth, double mu, double u0)
      : normal{std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
               std::cos(theta)},
        downhill{std::cos(theta) * std::cos(azimuth), std::cos(theta) * std::sin(azimuth),
                 -std::sin(theta)} {
    material.kinetic_friction = mu;
    material.rebound_speed = u0;
  }
  GroundPoint operator()(const Vector3d& point) const {
    return {dot(point, normal), normal, &material};
  }
  Vector3d normal, downhill;
  MaterialConstants<double> material;
};

ImpulseBody point_mass() {
  ImpulseBody body;
  body.mass = 1.3;
  body.inertia = {1., 1., 1., 0., 0., 0.};
  body.boundary_points = {{}};
  return body;
}

/// The block of issue 2, 0.2 x 0.2 m, or a taller one.
ImpulseBody block(double height) {
  ImpulseBody body;
  body.mass = 1.;
  const double I = (0.04 + height * height) / 12.;
  body.inertia = {I, I, 0.08 / 12., 0., 0., 0.};
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double z : {-0.5, 0.5}) body.boundary_points.push_back({x, y, z * height});
    }
  }
  return body;
}

struct Outcome {
  double displacement = 0.;  ///< downhill [m]
  double aside = 0.;         ///< across the slope [m]
  double speed = 0.;         ///< downhill, at the end [m/s]
  double impacts = 0.;       ///< a second
  double deepest = 0.;       ///< [m]
};

/// `duration` [s] in steps of 1 ms from rest, `height` [m] of the origin above the slope.
Outcome run(const ImpulseBody& body, ImpulseLaw law, const Slope& slope, double duration,
            double height, double theta, double azimuth) {
  ImpulseAdvance engine(body, law);
  ImpulseState s;
  s.orientation = exponential(Vector3d{0., 0., azimuth}) * exponential(Vector3d{0., theta, 0.});
  s.position = height * slope.normal;
  Outcome result;
  const int steps = static_cast<int>(std::lround(duration / 1e-3));
  for (int step = 0; step < steps; ++step) {
    const AdvanceResult advanced = engine.advance(s, 1e-3, {{0., 0., -kGravity}, {}, {}}, slope);
    EXPECT_EQ(advanced.status, AdvanceStatus::ok);
    result.impacts += static_cast<double>(advanced.impacts) / duration;
    result.deepest = std::max(result.deepest, advanced.deepest);
  }
  result.displacement = dot(slope.downhill, s.position);
  result.aside = dot(cross(slope.normal, slope.downhill), s.position);
  result.speed = dot(slope.downhill, s.velocity);
  return result;
}

TEST(ImpulseCreep, OfAPointIsReboundSpeedTimesTheSlopeWhateverTheFriction) {
  for (const double degrees : {5., 10., 15., 20., 25., 30.}) {
    const double theta = degrees * kDegree;
    for (const double mu : {1.05 * std::tan(theta), 2. * std::tan(theta), 1.5}) {
      for (const double azimuth : {0., 45. * kDegree, 2.}) {
        for (const double u0 : {1e-2, 1e-3}) {
          const Slope slope(theta, azimuth, mu, u0);
          const double duration = 400. * u0;
          const Outcome r =
              run(point_mass(), ImpulseLaw::impulse, slope, duration, 0., theta, azimuth);
          const double flight = 2. * u0 / (kGravity * std::cos(theta));
          // To within the one flight under way.
          EXPECT_NEAR(r.displacement / duration, u0 * std::tan(theta),
                      u0 * std::tan(theta) * flight / duration);
          EXPECT_NEAR(r.impacts, 1. / flight, 1.5 / duration);
          EXPECT_LT(std::abs(r.aside), 1e-12);
          EXPECT_LE(r.deepest, 1e-12);
        }
      }
    }
  }
}

// It comes and goes by what it gains in half a flight, u0^2 tan/(2 g cos) at the most, and never
// adds up.
TEST(ImpulseReversal, APointDoesNotCreep) {
  const double u0 = 1e-3;
  for (const double degrees : {5., 15., 30.}) {
    const double theta = degrees * kDegree;
    const double stroke = u0 * u0 * std::tan(theta) / (2. * kGravity * std::cos(theta));
    for (const double mu : {1.05 * std::tan(theta), 2. * std::tan(theta), 1.5}) {
      for (const double azimuth : {0., 45. * kDegree}) {
        const Slope slope(theta, azimuth, mu, u0);
        const Outcome r =
            run(point_mass(), ImpulseLaw::impulse_reversal, slope, 2., 0., theta, azimuth);
        EXPECT_LT(std::abs(r.displacement), 1.001 * stroke) << degrees << " " << mu;
      }
    }
  }
}

TEST(ImpulseReversal, APointThatLandsSettlesAndDoesNotCreep) {
  const double u0 = 1e-3, theta = 15. * kDegree;
  const double stroke = u0 * u0 * std::tan(theta) / (2. * kGravity * std::cos(theta));
  const Slope slope(theta, 0., 1.05 * std::tan(theta), u0);
  const Outcome early = run(point_mass(), ImpulseLaw::impulse_reversal, slope, 1., 1e-2, theta, 0.);
  const Outcome late = run(point_mass(), ImpulseLaw::impulse_reversal, slope, 3., 1e-2, theta, 0.);
  EXPECT_LT(std::abs(late.displacement - early.displacement), 2.002 * stroke);
}

TEST(ImpulseReversal, ABlockDoesNotCreepWhereImpulseDoes) {
  const double theta = 15. * kDegree, u0 = 1e-2;
  for (const double azimuth : {0., 45. * kDegree}) {
    const Slope slope(theta, azimuth, 0.5, u0);
    const double stroke = u0 * u0 * std::tan(theta) / (2. * kGravity * std::cos(theta));
    const Outcome still =
        run(block(0.1), ImpulseLaw::impulse_reversal, slope, 0.5, 0.05, theta, azimuth);
    EXPECT_LT(std::abs(still.displacement), 1.01 * stroke);
    const Outcome creeping = run(block(0.1), ImpulseLaw::impulse, slope, 0.5, 0.05, theta, azimuth);
    EXPECT_GT(creeping.displacement / 0.5, 0.5 * u0 * std::tan(theta));
  }
}

TEST(ImpulseReversal, ABlockThatLandsSettlesAndDoesNotCreep) {
  const double theta = 15. * kDegree, u0 = 1e-2;
  const Slope slope(theta, 0., 0.5, u0);
  const double stroke = u0 * u0 * std::tan(theta) / (2. * kGravity * std::cos(theta));
  const auto at = [&](double time) {
    return run(block(0.1), ImpulseLaw::impulse_reversal, slope, time, 0.06, theta, 0.).displacement;
  };
  EXPECT_LT(std::abs(at(0.8) - at(0.5)), 2.02 * stroke);
}

TEST(ImpulseSliding, BelowTheThresholdAPointSlidesAsCoulombSays) {
  for (const double degrees : {10., 30.}) {
    const double theta = degrees * kDegree, azimuth = 1.5 * theta;
    for (const double share : {0.5, 0.9}) {
      const double mu = share * std::tan(theta);
      const double expected = kGravity * (std::sin(theta) - mu * std::cos(theta));
      const Slope slope(theta, azimuth, mu, 1e-4);
      for (const ImpulseLaw law : {ImpulseLaw::impulse, ImpulseLaw::impulse_reversal}) {
        // From 0.05 s on: the first microcollisions still stick.
        const double v1 = run(point_mass(), law, slope, 0.05, 0., theta, azimuth).speed;
        const double v2 = run(point_mass(), law, slope, 0.45, 0., theta, azimuth).speed;
        EXPECT_NEAR((v2 - v1) / 0.4, expected, 2e-3 * expected) << degrees << " " << share;
      }
    }
  }
}

TEST(ImpulseSliding, BelowTheThresholdABlockSlidesAsCoulombSays) {
  const double theta = 20. * kDegree, mu = 0.2;
  const double expected = kGravity * (std::sin(theta) - mu * std::cos(theta));
  const Slope slope(theta, 0., mu, 1e-2);
  const Outcome r = run(block(0.1), ImpulseLaw::impulse, slope, 1., 0.05, theta, 0.);
  EXPECT_NEAR(r.displacement, 0.5 * expected, 0.01 * expected);
}

}  // namespace
}  // namespace hookpoint::contact
