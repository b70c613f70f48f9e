// Shapes against surfaces, by hand: what part of the way out each of several faces gives, where balls,
// points, rims and edges touch.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/geometry/ball_on_surface.h"
#include "contact/geometry/border.h"
#include "contact/geometry/cell_number.h"
#include "contact/geometry/edge_on_ridge.h"
#include "contact/geometry/folds.h"
#include "contact/geometry/height_field.h"
#include "contact/geometry/plane_surface.h"
#include "contact/geometry/polyhedron.h"
#include "contact/geometry/rim.h"
#include "contact/geometry/rim_on_ridge.h"
#include "contact/geometry/stairs_surface.h"

namespace hookpoint::contact {
namespace {

constexpr double tight = 1e-12;
const double deg = std::numbers::pi / 180.;

TEST(ShareOut, OnePlaneGivesAll) {
  std::array one{Obstruction{{0., 0., 1.}, 2e-3}};
  share_out(one);
  EXPECT_EQ(one[0].part, 1.);
}

TEST(ShareOut, PlanesAtRightAnglesGiveAllEach) {
  std::array corner{Obstruction{{0., 0., 1.}, 2e-3}, Obstruction{{1., 0., 0.}, 1e-3},
                    Obstruction{{0., 1., 0.}, 3e-3}};
  share_out(corner);
  for (const Obstruction& face : corner) EXPECT_NEAR(face.part, 1., tight);
}

// u is vertical, n . u = d, so that |u| = d / cos a = 2 lambda cos a.
TEST(ShareOut, TheSidesOfAGrooveShareTheWayOut) {
  for (const double angle : {1e-4, 0.1, 30. * deg, 60. * deg}) {
    const double d = 1e-3;
    std::array groove{Obstruction{{std::sin(angle), 0., std::cos(angle)}, d},
                      Obstruction{{-std::sin(angle), 0., std::cos(angle)}, d}};
    share_out(groove);
    for (const Obstruction& face : groove)
      EXPECT_NEAR(face.part, 0.5 / (std::cos(angle) * std::cos(angle)), 1e-6) << angle;
  }
}

TEST(ShareOut, EqualPlanesDoNotCountTwice) {
  std::array twice{Obstruction{{0., 0., 1.}, 2e-3}, Obstruction{{0., 0., 1.}, 2e-3}};
  share_out(twice);
  EXPECT_NEAR(twice[0].part + twice[1].part, 1., tight);
}

StairsProfile stairs_up() { return {{1., 0., 0.}, 0.5, 0.3, 0.1, 3.}; }

TEST(BallOnStairs, TouchesTreadAndRiserAtItsRadius) {
  const StairsSurface stairs(stairs_up(), 7);
  const double r = 0.02, d = 1e-3;
  const BallContacts found =
      ball_on_surface(stairs, {0.5 - r + d, 0., r - 2. * d}, r, {0.4, 0., 0.1}, {}, 0.);
  ASSERT_EQ(found.count, 2u);
  double up = 0., back = 0.;
  for (const SurfaceContact& contact : found.all()) {
    EXPECT_EQ(contact.material, 7);
    EXPECT_NEAR(contact.part, 1., tight);
    (contact.normal.z == 1. ? up : back) = contact.depth;
  }
  EXPECT_NEAR(up, 2. * d, tight);
  EXPECT_NEAR(back, d, tight);
}

TEST(BallOnStairs, HasTheRoundedNormalAtTheNosing) {
  const StairsSurface stairs(stairs_up(), 0);
  const double r = 0.02, away = 0.7 * r;
  for (const double angle : {10. * deg, 45. * deg, 80. * deg}) {
    const Vector3d out{-std::sin(angle), 0., std::cos(angle)};
    const Vector3d center = Vector3d{0.5, 0.3, 0.1} + away * out;
    const BallContacts found = ball_on_surface(stairs, center, r, center, {}, 0.);
    ASSERT_EQ(found.count, 1u) << angle;
    EXPECT_NEAR(found.contacts[0].depth, r - away, tight);
    EXPECT_NEAR(norm(found.contacts[0].normal - out), 0., tight);
  }
}

// A point that came in through the riser is pushed back out of it, however near the tread above is.
TEST(PointOnStairs, StaysWithTheFaceThroughWhichItCame) {
  const StairsSurface stairs(stairs_up(), 0);
  const BallContacts through_riser =
      ball_on_surface(stairs, {0.51, 0., 0.099}, 0., {0.49, 0., 0.099}, {}, 0.);
  ASSERT_EQ(through_riser.count, 1u);
  EXPECT_NEAR(through_riser.contacts[0].depth, 0.01, tight);
  EXPECT_EQ(through_riser.contacts[0].normal.x, -1.);
  const BallContacts later =
      ball_on_surface(stairs, {0.52, 0., 0.0995}, 0., {0.51, 0., 0.099}, through_riser.holding, 0.);
  ASSERT_EQ(later.count, 1u);
  EXPECT_NEAR(later.contacts[0].depth, 0.02, tight);
  const BallContacts through_tread =
      ball_on_surface(stairs, {0.501, 0., 0.09}, 0., {0.501, 0., 0.11}, {}, 0.);
  ASSERT_EQ(through_tread.count, 1u);
  EXPECT_EQ(through_tread.contacts[0].normal.z, 1.);
  EXPECT_NEAR(through_tread.contacts[0].depth, 0.01, tight);
}

/// A V along y with its bottom at x = 0.
Terrain groove(double angle) {
  GridSurface grid;
  grid.columns = 3;
  grid.rows = 3;
  for (int row = 0; row < 3; ++row)
    for (const double x : {-1., 0., 1.}) grid.heights.push_back(std::abs(x) * std::tan(angle));
  grid.origin_x = grid.origin_y = -1.;
  TerrainDescription description;
  description.surface = grid;
  return Terrain(description);
}

TEST(BallInAGroove, TouchesBothSides) {
  const double angle = 30. * deg, r = 0.04, d = 1e-4;
  const Terrain terrain = groove(angle);
  const HeightField field(terrain);
  const Vector3d center{0., 0.1, (r - d) / std::cos(angle)};
  const BallContacts found = ball_on_surface(field, center, r, center, {}, 0.);
  ASSERT_EQ(found.count, 2u);
  for (const SurfaceContact& contact : found.all()) EXPECT_NEAR(contact.depth, d, tight);
}

// As the crease becomes shallow the way out becomes that of the plane.
TEST(PointUnderACrease, IsHeldAsByThePlane) {
  const double d = 1e-3;
  for (const double angle : {1e-2, 1e-4, 1e-6}) {
    const Terrain terrain = groove(angle);
    const HeightField field(terrain);
    const BallContacts found =
        ball_on_surface(field, {1e-6, 0.1, -d}, 0., {1e-6, 0.1, 1e-3}, {}, 0.);
    Vector3d out;
    for (const SurfaceContact& contact : found.all())
      out += contact.part * contact.depth * contact.normal;
    EXPECT_NEAR(norm(out), d, 2. * angle * angle * d + 1.1e-6 * angle + tight) << angle;
  }
}

// Across the ridge of a roof the depth of a point is continuous.
TEST(PointUnderARidge, GoesOverWithoutAJump) {
  const Terrain terrain = groove(-10. * deg);
  const HeightField field(terrain);
  const double d = 2e-3;
  Holding held;
  Vector3d before{-0.02, 0.1, 0.};
  double last = -1.;
  for (double x = -0.02; x < 0.02; x += 1e-5) {
    const Vector3d center{x, 0.1, -std::abs(x) * std::tan(10. * deg) - d};
    const BallContacts found = ball_on_surface(field, center, 0., before, held, 0.);
    ASSERT_EQ(found.count, 1u) << x;
    if (last > 0.) {
      EXPECT_NEAR(found.contacts[0].depth, last, 1e-5) << x;
    }
    last = found.contacts[0].depth;
    held = found.holding;
    before = center;
  }
}

TEST(FlatTiles, AreOnePlane) {
  const Terrain terrain = groove(0.);
  const HeightField field(terrain);
  for (const double x : {-0.3, 0., 0.3}) {
    const Vector3d center{x, x, 0.019};
    const BallContacts found = ball_on_surface(field, center, 0.02, center, {}, 0.);
    ASSERT_EQ(found.count, 1u);
    EXPECT_EQ(found.contacts[0].depth, 0.02 - 0.019);
    EXPECT_EQ(found.contacts[0].part, 1.);
  }
}

TEST(CellNumber, EveryPlaceHasOne) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(cell_number(2.5, 4), 2);
  EXPECT_EQ(cell_number(-0.5, 4), 0);
  EXPECT_EQ(cell_number(4., 4), 3);
  EXPECT_EQ(cell_number(infinite, 4), 3);
  EXPECT_EQ(cell_number(-infinite, 4), 0);
  EXPECT_EQ(cell_number(std::nan(""), 4), 0);
}

// A pose that diverges: the step is refused, and until then every part of a surface answers.
TEST(Surfaces, AnswerWhereThereIsNoNumber) {
  const Terrain terrain = groove(30. * deg);
  const HeightField field(terrain);
  const StairsSurface stairs(stairs_up(), 0);
  const double none = std::nan("");
  const Region nowhere{{none, none, none}, {none, none, none}};
  for (const Surface* surface :
       {static_cast<const Surface*>(&field), static_cast<const Surface*>(&stairs)}) {
    EXPECT_EQ(surface->nearest_face({none, none, none}).id, 0);
    surface->faces(nowhere, [&](const Face& face) { EXPECT_GE(face.id, 0); });
    surface->ridges(nowhere, [&](const Ridge& ridge) { EXPECT_GE(ridge.id, 0); });
  }
}

TEST(Box, HasTwelveRidgesAndEightCorners) {
  const Polyhedron box = Polyhedron::box({0.2, 0.4, 0.6});
  EXPECT_EQ(box.all_ridges().size(), 12u);
  int corners = 0;
  box.corners({}, [&](const Corner& corner) {
    ++corners;
    EXPECT_TRUE(is_peak(corner));
    EXPECT_EQ(corner.edge_count, 3u);
  });
  EXPECT_EQ(corners, 8);
  EXPECT_TRUE(box.contains({0.099, 0., 0.299}));
  EXPECT_FALSE(box.contains({0.101, 0., 0.}));
  EXPECT_EQ(box.nearest_face({0., 0.19, 0.}).normal.y, 1.);
}

TEST(BallOnABox, TouchesFaceEdgeAndCorner) {
  const Polyhedron box = Polyhedron::box({0.2, 0.2, 0.2});
  const double r = 0.05, away = 0.04;
  const Vector3d corner{0.1, 0.1, 0.1};
  for (const Vector3d& out : {Vector3d{0., 0., 1.}, Vector3d{0., 1., 1.}, Vector3d{1., 1., 1.}}) {
    const Vector3d n = unit(out);
    const Vector3d foot{out.x * corner.x, out.y * corner.y, out.z * corner.z};
    const Vector3d center = foot + away * n;
    const BallContacts found = ball_on_surface(box, center, r, center, {}, 0.);
    ASSERT_EQ(found.count, 1u);
    EXPECT_NEAR(found.contacts[0].depth, r - away, tight);
    EXPECT_NEAR(norm(found.contacts[0].normal - n), 0., tight);
  }
}

// Flush with a corner of the box, below a shape that lies over the box: whichever way it moves it comes in
// through the top, and touches nothing while it does not sink.
TEST(FlushCorner, ComesInThroughTheFaceThatItsShapeLiesBeyond) {
  const Polyhedron box = Polyhedron::box({0.2, 0.2, 0.2});
  const Vector3d at{-0.1, -0.1, 0.1}, outward = unit({-1., -1., -1.}), up{0., 0., 1.};
  const double sink = 1e-7;
  for (const Vector3d& way : {Vector3d{1e-4, 0., 0.}, Vector3d{0., 1e-4, 0.},
                              Vector3d{1e-4, 1e-5, 0.}, Vector3d{1.5e-9, 0., 0.}}) {
    const BallContacts level = ball_on_surface(box, at + way, 0., at, {}, 0., outward);
    for (const SurfaceContact& contact : level.all()) EXPECT_LE(contact.depth, 0.);
    const BallContacts sunk = ball_on_surface(box, at + way - sink * up, 0., at, {}, 0., outward);
    ASSERT_EQ(sunk.count, 1u);
    EXPECT_EQ(norm(sunk.contacts[0].normal - up), 0.);
    EXPECT_NEAR(sunk.contacts[0].depth, sink, tight);
  }
  // One whose shape lies beside the box comes in through its side.
  const BallContacts beside =
      ball_on_surface(box, at + Vector3d{1e-4, 0., -1e-7}, 0., at, {}, 0., unit({1., -1., 1.}));
  ASSERT_EQ(beside.count, 1u);
  EXPECT_EQ(beside.contacts[0].normal.x, -1.);
}

TEST(FlushCorner, SharesWithTheCornerThatItMeets) {
  const Polyhedron box = Polyhedron::box({0.2, 0.2, 0.2});
  const Vector3d up{0., 0., 1.};
  EXPECT_EQ(share_with_corner(box, {0.1, 0.1, 0.0999}, up, 1e-4), 0.5);
  EXPECT_EQ(share_with_corner(box, {0.1, 0.1 - 1e-8, 0.0999}, up, 1e-4), 1.);
  EXPECT_EQ(share_with_corner(box, {0.1, 0., 0.0999}, up, 1e-4), 1.);
}

// The energy of a rim's three springs is 3/2 k d0^2 + 3/4 k a^2, whichever way it leans.
TEST(Rim, ResistsTiltingAlikeAboutAllAxes) {
  const double r = 0.05, d0 = 1e-3;
  for (const double tilt : {1e-7, 1e-4, 5e-3}) {
    for (const double turn : {0., 1., 2.5}) {
      const Vector3d axis{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                          std::cos(tilt)};
      const Rim rim{{0., 0., -d0}, axis, r, unit(cross(axis, {0., 1., 0.}))};
      double energy = 0.;
      for (const Vector3d& point : deepest_points(rim, {0., 0., 1.}, d0))
        energy += 0.5 * point.z * point.z;
      const double a = r * std::sin(tilt);
      EXPECT_NEAR(energy, 1.5 * d0 * d0 + 0.75 * a * a, 1e-9 * energy) << tilt << ' ' << turn;
    }
  }
}

TEST(Rim, ThatRollsTouchesInItsLowestPoint) {
  const Rim rim{{0., 0., 0.049}, {0., 1., 0.}, 0.05, {1., 0., 0.}};
  const auto points = deepest_points(rim, {0., 0., 1.}, -0.049);
  EXPECT_NEAR(norm(points[0] - Vector3d{0., 0., -1e-3}), 0., tight);
  EXPECT_GT(points[1].z, 0.);
  EXPECT_GT(points[2].z, 0.);
}

Ridge nosing() {
  Ridge ridge;
  ridge.point = {0.5, 0., 0.1};
  ridge.along = {0., 1., 0.};
  ridge.normals = {Vector3d{0., 0., 1.}, Vector3d{-1., 0., 0.}};
  ridge.outwards = {Vector3d{-1., 0., 0.}, Vector3d{0., 0., 1.}};
  return ridge;
}

// The axis is off the normal by nothing but rounding, or by little more: the points lie on the rim all the
// same, in its plane.
TEST(Rim, ThatIsAllButLevelHasItsPointsInItsPlane) {
  for (const double tilt : {0., 1e-17, 1e-16, 1e-15, 1e-13, 1e-11, 1e-9, 1e-6, 1e-3}) {
    const Vector3d normal = (1. / std::sqrt(14.)) * Vector3d{1., 2., 3.};
    Vector3d axis = normal + Vector3d{0., tilt, 0.};
    axis = (1. / norm(axis)) * axis;
    const Vector3d across = (1. / std::sqrt(5.)) * Vector3d{2., -1., 0.};
    const Vector3d reference = across - dot(across, axis) * axis;
    const Rim rim{{}, axis, 0.05, (1. / norm(reference)) * reference};
    for (const double depth : {-1e-3, 0., 1e-3})
      for (const Vector3d& point : deepest_points(rim, normal, depth)) {
        EXPECT_NEAR(dot(point, axis), 0., 1e-16) << tilt;
        EXPECT_NEAR(norm(point), 0.05, 1e-16) << tilt;
      }
  }
}

TEST(RimOnRidge, IsPushedAlongItsRadius) {
  const Vector3d out = unit({-1., 0., 1.});
  const Rim rim{nosing().point + 0.045 * out, {0., 1., 0.}, 0.05, {1., 0., 0.}};
  const RimCrossings found = rim_on_ridge(nosing(), rim, 0.);
  ASSERT_GE(found.count, 1u);
  EXPECT_NEAR(found.crossings[0].depth, 0.005, tight);
  EXPECT_NEAR(norm(found.crossings[0].normal - out), 0., 1e-9);
}

// Through the rim's centre but for rounding: no direction from there is that of the ridge.
TEST(RimOnRidge, ThatPiercesTheCentreHasItsCrossingsOnTheRim) {
  const Vector3d axis = unit({0.2, 1., 0.3});
  for (const double beside : {0., 1e-18, 1e-17, 1e-16, 1e-13, 1e-9}) {
    const Rim rim{nosing().point + Vector3d{1e-17, 0.01, beside}, axis, 0.05,
                  unit(tangential({1., 0., 0.}, axis))};
    const RimCrossings found = rim_on_ridge(nosing(), rim, 1.);
    for (const RimCrossing& at : found.all()) {
      EXPECT_NEAR(dot(at.radial, axis), 0., 1e-12) << beside;
      EXPECT_NEAR(norm(at.place - rim.center), 0.05, 1e-15) << beside;
    }
  }
}

// Standing over the edge with its end, a cylinder is held in the two places where its rim crosses it.
TEST(RimOnRidge, CrossesTwiceWhereItStandsOverTheEdge) {
  const double d = 1e-4, r = 0.05, over = 0.02;
  const Rim rim{{0.5 + over, 0.3, 0.1 - d}, {0., 0., 1.}, r, {1., 0., 0.}};
  const RimCrossings found = rim_on_ridge(nosing(), rim, 0.);
  ASSERT_EQ(found.count, 2u);
  for (const RimCrossing& crossing : found.all()) {
    EXPECT_NEAR(crossing.depth, d, tight);
    EXPECT_NEAR(norm(crossing.normal - Vector3d{0., 0., 1.}), 0., 1e-9);
    EXPECT_NEAR(std::abs(crossing.place.y - 0.3), std::sqrt(r * r - over * over), 1e-9);
  }
}

// The edge of a level sole that overhangs the nosing: from - to runs from the tread into the air.
BodyEdge sole_edge(double from_x, double to_x, double y, double depth) {
  return {{from_x, y, 0.1 - depth},
          {to_x, y, 0.1 - depth},
          0.,
          {Vector3d{0., 0., -1.}, Vector3d{0., 1., 0.}},
          {Vector3d{0., 1., 0.}, Vector3d{0., 0., -1.}}};
}

TEST(EdgeOnRidge, CarriesASoleAtItsDepth) {
  const auto at = edge_on_ridge(nosing(), sole_edge(0.6, 0.4, 0.2, 1e-4), 0., 0.01);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->depth, 1e-4, tight);
  EXPECT_NEAR(norm(at->normal - Vector3d{0., 0., 1.}), 0., tight);
  EXPECT_NEAR(norm(at->place - Vector3d{0.5, 0.2, 0.1 - 1e-4}), 0., tight);
  EXPECT_NEAR(end_weighted(*at, {1., 1.}), 1., tight);
}

// Where the overhanging end comes over the nosing its corner takes over with weight 1; where the other
// end leaves the tread nothing is left.
TEST(EdgeOnRidge, HandsOverAtItsEnds) {
  const auto begins = edge_on_ridge(nosing(), sole_edge(0.6, 0.5 - 1e-6, 0.2, 1e-4), 0., 0.01);
  ASSERT_TRUE(begins);
  EXPECT_NEAR(end_weighted(*begins, {1., 1.}), 1., 1e-3);
  const auto leaves = edge_on_ridge(nosing(), sole_edge(0.5 + 1e-6, 0.4, 0.2, 1e-4), 0., 0.01);
  ASSERT_TRUE(leaves);
  EXPECT_NEAR(end_weighted(*leaves, {1., 1.}), 0., 1e-3);
}

}  // namespace
}  // namespace hookpoint::contact
