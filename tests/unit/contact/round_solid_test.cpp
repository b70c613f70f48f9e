// Solids of revolution against balls, rims and each other: by hand, and against a search over dense
// points of their outlines, which knows none of the closed forms.
#include "contact/geometry/round_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "contact/geometry/edge_on_ridge.h"
#include "contact/geometry/folds.h"
#include "contact/geometry/rim_on_round.h"
#include "tests/support/drawn.h"

namespace hookpoint::contact {
namespace {

using test_support::drawn;

constexpr double tight = 1e-12;

RoundSolid tin() { return {{0., 0., -0.1}, {0., 0., 0.1}, 0.05, 0.05, {0., 0., 1.}, true}; }
RoundSolid capsule() { return {{0., 0., -0.1}, {0., 0., 0.1}, 0.05, 0.05, {0., 0., 1.}, false}; }
RoundSolid disc() { return {{}, {}, 0.05, 0.05, {0., 0., 1.}, true}; }
/// From radius 0.08 at its foot to `top` at a height of 0.2.
RoundSolid cone(double top) { return {{}, {0., 0., 0.2}, 0.08, top, {0., 0., 1.}, true}; }

TEST(RoundSolids, GiveTheNearestWayOut) {
  const auto side = ball_on_round(tin(), {0.06, 0., 0.}, 0.02, 0.);
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->depth, 0.01, tight);
  EXPECT_EQ(side->normal.x, 1.);
  const auto end = ball_on_round(tin(), {0.01, 0., 0.11}, 0.02, 0.);
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->depth, 0.01, tight);
  EXPECT_EQ(end->normal.z, 1.);
  const auto rim = ball_on_round(tin(), {0.06, 0., 0.11}, 0.02, 0.);
  ASSERT_TRUE(rim);
  EXPECT_NEAR(rim->depth, 0.02 - std::hypot(0.01, 0.01), tight);
  EXPECT_FALSE(ball_on_round(tin(), {0.08, 0., 0.}, 0.02, 0.));
  const auto tip = ball_on_round(capsule(), {0., 0., 0.16}, 0.02, 0.);
  ASSERT_TRUE(tip);
  EXPECT_NEAR(tip->depth, 0.01, tight);
}

// The outline as a polygon of dense points: its distance, and inside by the three half-planes.
TEST(RoundSolids, OfConesHaveTheDistanceOfTheirOutline) {
  std::mt19937_64 random(1);
  for (const double top : {0., 0.03, 0.08, 0.12}) {
    const RoundSolid solid = cone(top);
    for (int i = 0; i < 300; ++i) {
      const double s = drawn(random, -0.1, 0.3), off = drawn(random, 0., 0.2);
      const double angle = drawn(random, 0., 6.);
      const bool inside = s > 0. && s < 0.2 && off < 0.08 + (top - 0.08) * s / 0.2;
      double nearest = 1.;
      constexpr int count = 20000;
      for (int k = 0; k <= count; ++k) {
        const double part = static_cast<double>(k) / count;
        for (const auto& [z, r] : {std::pair{0., 0.08 * part}, std::pair{0.2, top * part},
                                   std::pair{0.2 * part, 0.08 + (top - 0.08) * part}})
          nearest = std::min(nearest, std::hypot(s - z, off - r));
      }
      const auto at =
          ball_on_round(solid, {off * std::cos(angle), off * std::sin(angle), s}, 0., 1.);
      ASSERT_TRUE(at);
      EXPECT_NEAR(at->depth, inside ? nearest : -nearest, 1e-5) << top << ' ' << s << ' ' << off;
      EXPECT_NEAR(norm(at->normal), 1., tight);
    }
  }
}

TEST(RoundSolids, OfADiscAreLeftByTheEndThroughWhichABallCame) {
  for (const std::size_t end : {0, 1}) {
    const double side = end == 1 ? 1. : -1.;
    for (const double height : {0.015, 0.005, -0.003}) {
      const auto at = ball_on_disc(disc(), {0.01, 0.02, side * height}, 0.02, 0., end);
      ASSERT_TRUE(at);
      EXPECT_NEAR(at->depth, 0.02 - height, tight);
      EXPECT_EQ(at->normal.z, side);
    }
  }
  // Beside it the rim is nearest.
  const auto rim = ball_on_disc(disc(), {0.06, 0., 0.01}, 0.02, 0., 1);
  ASSERT_TRUE(rim);
  EXPECT_NEAR(rim->depth, 0.02 - std::hypot(0.01, 0.01), tight);
}

// Balls about the axis touch the side from within: all of them lie inside, and cover it.
TEST(RoundSides, AreEnvelopesOfBalls) {
  for (const double top : {0., 0.03, 0.12}) {
    const RoundSolid solid = cone(top);
    const RoundSide side = side_of(solid);
    for (double part = 0.; part <= 1.; part += 0.125) {
      const Vector3d center = (1. - part) * side.from + part * side.to;
      const double radius = (1. - part) * side.radius + part * side.far_radius;
      const auto over = over_side(solid, center + Vector3d{1e-9, 0., 0.});
      ASSERT_TRUE(over);
      EXPECT_NEAR(over->height, -radius, 2e-9);
      const double foot = center.z - over->height * over->normal.z;
      EXPECT_NEAR(foot, 0.2 * part, 1e-8);
    }
  }
}

TEST(CrossedSides, MeetBetweenTheirEnds) {
  const RoundSide below{{-1., 0., 0.}, {1., 0., 0.}, 0.05, 0.05};
  const RoundSide above{{0., -1., 0.09}, {0., 1., 0.09}, 0.05, 0.05};
  const auto at = crossed_sides(above, below, 0.);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->contact.depth, 0.01, tight);
  EXPECT_NEAR(at->contact.normal.z, 1., tight);
  EXPECT_NEAR(norm(at->place - Vector3d{0., 0., 0.04}), 0., tight);
}

// The greatest of r_1 + r_2 - distance over both axes, by a grid that closes in on it.
TEST(CrossedSides, OfConesMeetWhereTheyAreDeepest) {
  std::mt19937_64 random(2);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const auto place = [&] {
      return Vector3d{drawn(random, -0.2, 0.2), drawn(random, -0.2, 0.2), drawn(random, -0.2, 0.2)};
    };
    const RoundSide first{place(), place(), drawn(random, 0., 0.05), drawn(random, 0., 0.05)};
    const RoundSide second{place(), place(), drawn(random, 0., 0.05), drawn(random, 0., 0.05)};
    const auto depth_at = [&](double s, double t) {
      const Vector3d p = (1. - s) * first.from + s * first.to,
                     q = (1. - t) * second.from + t * second.to;
      return (1. - s) * first.radius + s * first.far_radius + (1. - t) * second.radius +
             t * second.far_radius - norm(p - q);
    };
    double s = 0.5, t = 0.5, width = 0.5;
    while (width > 1e-10) {
      double best = -1e9, best_s = s, best_t = t;
      for (int k = -8; k <= 8; ++k) {
        for (int l = -8; l <= 8; ++l) {
          const double x = std::clamp(s + width * k / 8., 0., 1.);
          const double y = std::clamp(t + width * l / 8., 0., 1.);
          if (const double depth = depth_at(x, y); depth > best) {
            best = depth;
            best_s = x;
            best_t = y;
          }
        }
      }
      s = best_s;
      t = best_t;
      width *= 0.6;
    }
    const auto at = crossed_sides(first, second, 1.);
    const bool between = s > 1e-6 && s < 1. - 1e-6 && t > 1e-6 && t < 1. - 1e-6;
    EXPECT_EQ(at.has_value(), between) << i;
    if (!at) continue;
    ++met;
    EXPECT_NEAR(at->contact.depth, depth_at(s, t), 1e-9) << i;
  }
  EXPECT_GT(met, 50);
}

// A cone across a straight edge: the deepest ball of its side, by a search along the axis.
TEST(EdgeOnRidge, OfAConeIsItsDeepestBalls) {
  Ridge ridge;
  ridge.along = {0., 1., 0.};
  ridge.normals = {Vector3d{0., 0., 1.}, Vector3d{-1., 0., 0.}};
  ridge.outwards = {Vector3d{-1., 0., 0.}, Vector3d{0., 0., 1.}};
  const double s0 = 0.02, s1 = 0.06;
  const BodyEdge edge{
      {-0.2, -0.05, -0.03}, {0.1, 0.05, 0.06}, s0, {}, {}, (s1 - s0) / std::hypot(0.3, 0.1, 0.09)};
  double deepest = -1.;
  for (int k = 0; k <= 100000; ++k) {
    const double part = k / 100000.;
    const Vector3d p = (1. - part) * edge.from + part * edge.to;
    deepest = std::max(deepest, (1. - part) * s0 + part * s1 - std::hypot(p.x, p.z));
  }
  const auto at = edge_on_ridge(ridge, edge, 1., 1.);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->depth, deepest, 1e-9);
  EXPECT_NEAR(at->normal.y, 0., tight);
  EXPECT_NEAR(std::hypot(at->place.x, at->place.z), std::abs(deepest), 1e-9);
}

/// A rim of a shape that stands `above` the tin's upper end, its centre `beside` the axis.
ShapeRim standing_rim(double beside, double above) {
  return {{{beside, 0., 0.1 + above}, {0., 0., 1.}, 0.05, {1., 0., 0.}}, {beside, 0., 0.2 + above}};
}

TEST(RimOnRound, OfATinOnATinTouchesInThreePlaces) {
  const RimContacts found = rim_on_round(tin(), standing_rim(0., -1e-4), 0., true);
  ASSERT_EQ(found.count, 3u);
  for (const RimContact& at : found.all()) {
    EXPECT_EQ(at.kind, RimContact::Kind::end);
    EXPECT_NEAR(at.depth, 1e-4, tight);
    EXPECT_NEAR(at.normal.z, 1., tight);
  }
}

// Two circles of radius r whose centres are e apart cross e/2 along and sqrt(r^2 - e^2/4) across.
TEST(RimOnRound, OfATinBesideTheMiddleOfAnotherTouchesWhereTheirRimsCross) {
  const double e = 0.04, r = 0.05;
  const RimContacts found = rim_on_round(tin(), standing_rim(e, -1e-4), 0., true);
  int crossings = 0;
  for (const RimContact& at : found.all()) {
    EXPECT_NEAR(at.depth, 1e-4, 1e-9);
    if (at.kind == RimContact::Kind::end) {
      EXPECT_LE(std::hypot(at.place.x, at.place.y), r + 1e-9);
      continue;
    }
    ASSERT_EQ(at.kind, RimContact::Kind::rim);
    ++crossings;
    EXPECT_NEAR(at.place.x, 0.5 * e, 1e-9);
    EXPECT_NEAR(std::abs(at.place.y), std::sqrt(r * r - 0.25 * e * e), 1e-9);
    EXPECT_EQ(at.weight, 1.);
  }
  EXPECT_EQ(crossings, 2);
  EXPECT_EQ(rim_on_round(tin(), standing_rim(e, -1e-4), 0., false).count, found.count - 2);
}

// Tins that stand side by side do not stand on each other.
TEST(RimOnRound, OfATinThatStandsBesideAnotherTouchesNoEnd) {
  const RimContacts found = rim_on_round(tin(), standing_rim(0.0999, -0.1), 0., true);
  for (const RimContact& at : found.all()) EXPECT_EQ(at.kind, RimContact::Kind::side);
}

// A tin on a log: its end's rim touches in the two places over the log's axis.
TEST(RimOnRound, OfATinOnALogTouchesOverTheAxis) {
  const RoundSolid log{{-0.5, 0., 0.}, {0.5, 0., 0.}, 0.1, 0.1, {1., 0., 0.}, true};
  const ShapeRim rim{{{0., 0., 0.0999}, {0., 0., 1.}, 0.05, unit({1., 1., 0.})}, {0., 0., 0.2}};
  const RimContacts found = rim_on_round(log, rim, 0., true);
  ASSERT_EQ(found.count, 2u);
  for (const RimContact& at : found.all()) {
    EXPECT_EQ(at.kind, RimContact::Kind::side);
    EXPECT_NEAR(std::abs(at.place.x), 0.05, 1e-7);
    EXPECT_NEAR(at.place.y, 0., 1e-7);
    EXPECT_NEAR(at.depth, 1e-4, 1e-9);
    EXPECT_NEAR(at.normal.z, 1., 1e-7);
  }
}

// Of two rims in any attitude the way between the places is across both.
TEST(RimOnRound, CrossesAnotherRimAcrossBoth) {
  std::mt19937_64 random(3);
  int crossings = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d axis =
        unit({drawn(random, -1., 1.), drawn(random, -1., 1.), drawn(random, 0.2, 1.)});
    const Vector3d center{drawn(random, -0.1, 0.1), drawn(random, -0.1, 0.1),
                          drawn(random, 0.08, 0.14)};
    const ShapeRim rim{{center, axis, 0.04, unit(cross(axis, {0.3, 1., 0.2}))},
                       center + 0.1 * axis};
    const RimContacts found = rim_on_round(tin(), rim, 0.01, true);
    for (const RimContact& at : found.all()) {
      EXPECT_NEAR(norm(at.place - center), 0.04, tight);
      EXPECT_NEAR(dot(at.place - center, axis), 0., tight);
      if (at.kind != RimContact::Kind::rim) continue;
      ++crossings;
      const Vector3d tangent = cross(axis, unit(at.place - center));
      EXPECT_NEAR(dot(at.normal, tangent), 0., 1e-9);
      const Vector3d other = at.place + at.depth * at.normal;
      EXPECT_NEAR(std::hypot(other.x, other.y), 0.05, 1e-9);
      EXPECT_NEAR(std::abs(other.z), 0.1, 1e-9);
      EXPECT_NEAR(at.normal.x * other.y - at.normal.y * other.x, 0., 1e-9);
    }
  }
  EXPECT_GT(crossings, 20);
}

// What comes round the rim of a disc is not under its face; what came through the face stays so.
TEST(RimOnRound, ComesUnderADiscThroughItsFaceAlone) {
  const double depth = 2e-3, margin = 1e-3;
  const ShapeRim rim{{{0.1 - margin, 0., -depth}, {0., 0., 1.}, 0.05, {-1., 0., 0.}},
                     {0.1 - margin, 0., 0.1}};
  const auto under = [&](const CameOver& came_over) {
    const RimContacts found = rim_on_round(disc(), rim, 0., false, came_over);
    return found.count;
  };
  EXPECT_EQ(under({1, false}), 0u);
  EXPECT_EQ(under({1, true}), 1u);
}

// A disc has two ends, and is pressed on against either.
TEST(RimOnRound, OfADiscLeavesByEitherEnd) {
  const ShapeRim rim{{{0.06, 0., 0.}, {1., 0., 0.}, 0.05, {0., 0., 1.}}, {0.06, 0., 0.}};
  EXPECT_EQ(rim.end_against({1., 0., 0.}).x, -1.);
  EXPECT_EQ(rim.end_against({-1., 0., 0.}).x, 1.);
}

}  // namespace
}  // namespace hookpoint::contact
