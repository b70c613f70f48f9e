// Mass properties as a file states them, against textbook moments of inertia and the parallel-axis
// theorem.
#include <gtest/gtest.h>

#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

using namespace simulation;

/// The mass of a free base whose block is `body`.
MassSpec base_mass(const std::string& body) {
  const Loaded loaded = load_text("World w { Robot bot { Base.mobile { " + body + " } } }");
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return loaded.experiment ? loaded.experiment->robots.at(0).base.mass : MassSpec{};
}

void expect_inertia(const Symmetric3d& actual, const Symmetric3d& expected) {
  for (double Symmetric3d::*element : {&Symmetric3d::xx, &Symmetric3d::yy, &Symmetric3d::zz,
                                       &Symmetric3d::xy, &Symmetric3d::xz, &Symmetric3d::yz}) {
    EXPECT_NEAR(actual.*element, expected.*element, 1e-15);
  }
}

TEST(LoadMass, ABoxHasTheTextbookInertia) {
  for (const char* type : {"Shape.Box", "Shape.Cube"}) {
    const MassSpec mass =
        base_mass("mass = 2; " + std::string(type) + " dimensions = 0.3,0.2,0.06;");
    EXPECT_EQ(mass.mass, 2.);
    EXPECT_EQ(mass.center_of_mass, Vector3d{});
    expect_inertia(mass.inertia,
                   {2. / 12 * (0.04 + 0.0036), 2. / 12 * (0.09 + 0.0036), 2. / 12 * (0.09 + 0.04)});
  }
}

TEST(LoadMass, AShapeMayHaveTheMass) {
  const MassSpec mass = base_mass("Shape.Sphere { radius = 10 cm; mass = 500 g; }");
  EXPECT_EQ(mass.mass, 0.5);
  expect_inertia(mass.inertia, {0.002, 0.002, 0.002});  // 2/5 m r^2
}

TEST(LoadMass, ATurnedCylinderTurnsItsInertia) {
  const MassSpec mass = base_mass(
      "mass = 3; Shape.Cylinder { radius = 0.1; length = 0.4; orientation = 0, 90 deg, 0; }");
  const double axial = 0.5 * 3 * 0.01, transverse = 3. / 12 * (3 * 0.01 + 0.16);
  expect_inertia(mass.inertia, {axial, transverse, transverse});
}

TEST(LoadMass, ADiscAndAHull) {
  const MassSpec disc = base_mass("mass = 4; Shape.Disc { radius = 0.1; }");
  EXPECT_EQ(disc.mass, 4.);
  expect_inertia(disc.inertia, {0.01, 0.01, 0.02});  // m r^2/4 and m r^2/2
  const MassSpec hull =
      base_mass("mass = 4; Shape.Hull { points = 0,0,0, 1,0,0, 0,1,0, 0,0,1, 0.1,0.1,0.1; }");
  EXPECT_NEAR(norm(hull.center_of_mass - Vector3d{0.25, 0.25, 0.25}), 0., 1e-15);
  EXPECT_NEAR(hull.inertia.xx, 0.3, 1e-14);  // 3/40 m
}

TEST(LoadMass, TheBodysMassIsSharedByVolume) {
  // Cubes of edge 0.1 and 0.2: volumes 1 : 8.
  const MassSpec mass = base_mass(
      "mass = 9; Shape.Box { dimensions = .1,.1,.1; location = .9,0,0; } Shape.Box { dimensions = "
      ".2,.2,.2; }");
  EXPECT_EQ(mass.mass, 9.);
  EXPECT_NEAR(mass.center_of_mass.x, 0.1, 1e-16);
  const double own = 1. / 6 * 0.01 + 8. / 6 * 0.04;
  const double steiner = 1 * 0.8 * 0.8 + 8 * 0.1 * 0.1;
  expect_inertia(mass.inertia, {own, own + steiner, own + steiner});
}

TEST(LoadMass, WhatShapesHaveOfTheirOwnIsTakenFirst) {
  const MassSpec mass = base_mass(
      "mass = 5; Shape.Box { dimensions = .1,.1,.1; location = 1,0,0; mass = 4; } Shape.Box { "
      "dimensions = .1,.1,.1; }");
  EXPECT_NEAR(mass.mass, 5., 1e-15);
  EXPECT_NEAR(mass.center_of_mass.x, 0.8, 1e-15);
}

TEST(LoadMass, GivenPropertiesCountBeforeShapes) {
  const MassSpec mass = base_mass(
      "mass = 2; center_of_mass = 0,0,1 cm; inertia = 3,4,5,.1,.2,.3; Shape.Sphere radius = 1;");
  EXPECT_EQ(mass.mass, 2.);
  EXPECT_EQ(mass.center_of_mass, (Vector3d{0., 0., 0.01}));
  EXPECT_EQ(mass.inertia, (Symmetric3d{3., 4., 5., .1, .2, .3}));
}

TEST(LoadMass, AThinPlateMeetsTheTriangleInequalityWithEquality) {
  EXPECT_EQ(base_mass("mass = 1; inertia = 0.1, 0.2, 0.3, 0,0,0;").inertia.zz, 0.3);
}

TEST(LoadMass, BoundaryPointsAreThoseOfShapesAndContactPoints) {
  const Loaded loaded = load_text(
      "World w { Robot bot { Base.mobile { mass = 1; inertia = 1,1,1,0,0,0; ContactPoint p { "
      "location = 1,2,3; } } }"
      " Robot box { Base.mobile { Shape.Box { dimensions = 2,4,6; mass = 1; location = 1,2,3; } "
      "ContactPoint p { location = 9,9,9; } } } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.experiment->robots[0].base.boundary_points,
            (std::vector<Vector3d>{{1., 2., 3.}}));
  const std::vector<Vector3d>& points = loaded.experiment->robots[1].base.boundary_points;
  ASSERT_EQ(points.size(), 9U);
  for (const Vector3d corner :
       {Vector3d{0., 0., 0.}, Vector3d{2., 4., 6.}, Vector3d{2., 0., 6.}, Vector3d{9., 9., 9.}}) {
    EXPECT_NE(std::find(points.begin(), points.end(), corner), points.end())
        << corner.x << corner.y << corner.z;
  }
}

}  // namespace
}  // namespace hookpoint
