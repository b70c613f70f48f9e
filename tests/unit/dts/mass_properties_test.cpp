// Uniform solids against textbook values and against their own sum of small cells.
#include "dts/mass_properties.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace hookpoint::dts {
namespace {

void expect_near(const MassProperties<double>& a, const MassProperties<double>& b,
                 double tolerance) {
  EXPECT_NEAR(a.mass, b.mass, tolerance);
  EXPECT_NEAR(norm(a.center_of_mass - b.center_of_mass), 0., tolerance);
  for (const auto member : {&Symmetric3d::xx, &Symmetric3d::yy, &Symmetric3d::zz, &Symmetric3d::xy,
                            &Symmetric3d::xz, &Symmetric3d::yz}) {
    EXPECT_NEAR(a.inertia.*member, b.inertia.*member, tolerance);
  }
}

TEST(MassProperties, BoxSphereCylinder) {
  expect_near(box_mass(12., {1., 2., 3.}), {12., {}, {13., 10., 5., 0., 0., 0.}}, 1e-14);
  expect_near(sphere_mass(5., 2.), {5., {}, {8., 8., 8., 0., 0., 0.}}, 1e-14);
  expect_near(cylinder_mass(12., 1., 2.), {12., {}, {7., 7., 6., 0., 0., 0.}}, 1e-14);
}

TEST(MassProperties, Volumes) {
  EXPECT_DOUBLE_EQ(box_volume({1., 2., 3.}), 6.);
  EXPECT_DOUBLE_EQ(sphere_volume(3.), 36. * std::numbers::pi);
  EXPECT_DOUBLE_EQ(cylinder_volume(2., 5.), 20. * std::numbers::pi);
  EXPECT_DOUBLE_EQ(legcone_volume(3., 2., 1.), 7. * std::numbers::pi);
}

// Length 2, radius 1: of 10 kg the balls have 4, the cylinder 6. About z 6/2 + (2/5) 4; across
// 6 (1/4 + 4/12) + 4 (2/5 + 4/4 + (3/8) 2).
TEST(MassProperties, Capsule) {
  expect_near(capsule_mass(10., 1., 2.), {10., {}, {12.1, 12.1, 4.6, 0., 0., 0.}}, 1e-13);
  EXPECT_NEAR(capsule_volume(1., 2.), 10. / 3. * std::numbers::pi, 1e-14);
}

TEST(MassProperties, PolyhedronOfABoxOffItsOriginIsTheBox) {
  std::vector<Vector3d> vertices;
  for (const double z : {0., 3.})
    for (const double y : {0., 2.})
      for (const double x : {0., 1.}) vertices.push_back({x + 5., y - 4., z});
  const std::vector<std::vector<std::size_t>> faces{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  EXPECT_NEAR(polyhedron_volume(vertices, faces), 6., 1e-13);
  expect_near(polyhedron_mass(12., vertices, faces),
              {12., {5.5, -3., 1.5}, {13., 10., 5., 0., 0., 0.}}, 1e-12);
}

// Corner tetrahedron with legs 1: its centroid is 1/4 along each. The integral of x^2 is m/10, that
// of x y m/20, so that the elements about the centroid are 3/40 m and m/80.
TEST(MassProperties, PolyhedronOfACornerTetrahedron) {
  const std::vector<Vector3d> vertices{{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
  const std::vector<std::vector<std::size_t>> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  expect_near(polyhedron_mass(4., vertices, faces),
              {4., {0.25, 0.25, 0.25}, {0.3, 0.3, 0.3, 0.05, 0.05, 0.05}}, 1e-13);
}

TEST(MassProperties, LegconeThatDoesNotTaperIsACylinderAlongX) {
  expect_near(legcone_mass(12., 2., 1., 1.), {12., {1., 0., 0.}, {6., 7., 7., 0., 0., 0.}}, 1e-13);
}

TEST(MassProperties, LegconeThatEndsInAPointIsACone) {
  // Textbook cone of height h, base radius r: centroid h/4 from the base, 3/10 m r^2 along, 3/20 m
  // r^2 + 3/80 m h^2 across.
  const double m = 2., h = 1.5, r = 0.4;
  const double across = 3. / 20. * m * r * r + 3. / 80. * m * h * h;
  expect_near(legcone_mass(m, h, r, 0.),
              {m, {h / 4., 0., 0.}, {0.3 * m * r * r, across, across, 0., 0., 0.}}, 1e-14);
}

TEST(MassProperties, LegconeAgainstDiscsSummed) {
  const double m = 1.3, length = 0.65, proximal = 0.1, distal = 0.05;
  const int count = 20000;
  double volume = 0., moment = 0., along = 0., across = 0.;
  for (int i = 0; i < count; ++i) {
    const double x = (i + 0.5) * length / count;
    const double r = proximal + (distal - proximal) * x / length;
    const double disc = r * r;
    volume += disc;
    moment += disc * x;
    along += disc * r * r / 2.;
    across += disc * (r * r / 4. + x * x);
  }
  const double c = moment / volume;
  const double across_center = m * (across / volume - c * c);
  expect_near(legcone_mass(m, length, proximal, distal),
              {m, {c, 0., 0.}, {m * along / volume, across_center, across_center, 0., 0., 0.}},
              1e-9);
}

TEST(MassProperties, TwoHalvesOfABoxMakeTheBox) {
  const MassProperties<double> half = box_mass(1., {1., 2., 3.});
  const std::array parts{placed(half, {0.5, 0., 0.}, {}), placed(half, {-0.5, 0., 0.}, {})};
  expect_near(combined(parts), box_mass(2., {2., 2., 3.}), 1e-14);
}

TEST(MassProperties, QuarterTurnSwapsTheEdgesAndPlacesTheCentre) {
  const double angle = std::numbers::pi / 2.;
  const MassProperties<double> turned =
      placed(legcone_mass(2., 1., 0.2, 0.1), {1., 2., 3.}, exponential(Vector3d{0., 0., angle}));
  const MassProperties<double> cone = legcone_mass(2., 1., 0.2, 0.1);
  expect_near(turned,
              {2.,
               {1., 2. + cone.center_of_mass.x, 3.},
               {cone.inertia.yy, cone.inertia.xx, cone.inertia.zz, 0., 0., 0.}},
              1e-14);
}

TEST(MassProperties, NothingCombinesToNothing) {
  const std::array parts{MassProperties<double>{}, MassProperties<double>{}};
  expect_near(combined(parts), {}, 0.);
}

}  // namespace
}  // namespace hookpoint::dts
