// What a whole experiment must not be, each with the diagnostic that says so, at its place.
#include <gtest/gtest.h>

#include "tests/support/load_text.h"
#include "tests/support/message_rules.h"

namespace hookpoint {
namespace {

const std::string block = "Robot block { Base.mobile { mass = 1; Shape.Box dimensions = 1,1,1; } }";

std::string diagnostics_of(const std::string& text) {
  const Loaded loaded = load_text(text);
  EXPECT_FALSE(loaded.experiment);
  return loaded.diagnostics;
}

struct Case {
  const char* name;
  std::string text;
  std::string diagnostics;
};

class WrongExperiment : public ::testing::TestWithParam<Case> {};

TEST_P(WrongExperiment, IsRefusedInTheseWords) {
  EXPECT_EQ(diagnostics_of(GetParam().text), GetParam().diagnostics);
  EXPECT_EQ(testing::broken_rule(GetParam().diagnostics), "");
}

const Case cases[] = {
    {"no_world", "Material m { }",
     "error 1:1 there is no World in this file; a run needs one: World NAME { ... }\n"},
    {"robot_without_world", block,
     "error 1:1 there is no World in this file to run its Robot in: write a file that includes it, "
     "such as World w { Terrain.Flat ground { } Include \"text.hook\"; }\n"},
    {"two_worlds", "World a { }\nWorld b { }",
     "error 2:1 a second World; a file to run holds exactly one\nnote 1:1 the first is here\n"},
    {"stray_robot", "World w { }\n" + block,
     "error 2:1 Robot stands at the top of the file to run; move it into the World\n"},
    {"stray_obstacle", "World w { }\nObstacle.Sphere o { radius = 1; }",
     "error 2:1 Obstacle.Sphere stands at the top of the file to run; move it into the World\n"},
    {"obstacle_without_world", "Obstacle.Sphere o { radius = 1; }",
     "error 1:1 there is no World in this file; a run needs one: World NAME { ... }\n"},
    {"gravity_of_two", "World w {\n  gravity = 0,9.81;\n}",
     "error 2:13 gravity has two components; give one number g for 0,0,-g, or the three of the "
     "vector\n"},
    {"no_base", "World w { Robot r { } }",
     "error 1:11 robot `r` has no base; give it a Base.fixed, Base.mobile or Base.planar\n"},
    {"two_bases", "World w { Robot r { Base.fixed a { }\nBase.fixed b { } } }",
     "error 2:1 a second base; a robot has exactly one\nnote 1:21 the first is here\n"},
    {"empty_chain", "World w { Robot r { Base.fixed { }\nChain leg { } } }",
     "error 2:1 chain `leg` has no links; give it a Link NAME { ... }\n"},
    {"no_mass", "World w { Robot r {\nBase.mobile { Shape.Box dimensions = 1,1,1; } } }",
     "error 2:1 a free body needs a mass above 0; give `mass`, here or in its shapes\n"},
    {"zero_mass",
     "World w { Robot r { Base.mobile {\nmass = 0; Shape.Box dimensions = 1,1,1; } } }",
     "error 2:8 a free body needs a mass above 0; give `mass`, here or in its shapes\n"},
    {"point_mass", "World w { Robot r {\nBase.mobile { mass = 1; } } }",
     "error 2:1 a free body needs an inertia about every axis; give `inertia`, or a shape from "
     "which it follows\n"},
    {"triangle", "World w { Robot r { Base.mobile { mass = 1;\ninertia = 1,1,3,0,0,0; } } }",
     "error 2:11 inertia breaks the triangle inequality: no principal moment may exceed the sum of "
     "the other two; the "
     "order is Ixx,Iyy,Izz,Ixy,Ixz,Iyz about the centre of mass\n"},
    {"triangle_when_turned",
     "World w { Robot r { Base.mobile { mass = 1;\ninertia = 2,2,1,1.5,0,0; } } }",
     "error 2:11 inertia breaks the triangle inequality: no principal moment may exceed the sum of "
     "the other two; the "
     "order is Ixx,Iyy,Izz,Ixy,Ixz,Iyz about the centre of mass\n"},
    {"indefinite", "World w { Robot r { Base.mobile { mass = 1;\ninertia = 1,1,1,2,0,0; } } }",
     "error 2:11 inertia has a negative principal moment; the order is Ixx,Iyy,Izz,Ixy,Ixz,Iyz "
     "about the centre of "
     "mass\n"},
    {"masses_disagree",
     "World w { Robot r { Base.mobile {\nmass = 1; Shape.Box { dimensions = 1,1,1; mass = 2; } } } "
     "}",
     "error 2:8 mass is 1 kg but the shapes' own masses add up to 2 kg; leave one of them out\n"},
    {"inertia_without_mass",
     "World w { Robot r { Base.fixed { } Chain c {\nLink l { inertia = 1,1,1,0,0,0; } } } }",
     "error 2:1 inertia and center_of_mass mean nothing without a mass; give `mass`\n"},
    {"massless_last_link", "World w { Robot r { Base.fixed { } Chain c {\nLink l { } } } }",
     "error 2:1 the joint of `l` moves no inertia about its axis: give the link, or one further "
     "out, a mass and a "
     "shape or an `inertia`\n"},
    {"prismatic_without_mass",
     "World w { Robot r { Base.fixed { } Chain c {\nLink l { joint = prismatic; } } } }",
     "error 2:1 the joint of `l` moves no mass: give the link, or one further out, a mass\n"},
    {"limits_crossed",
     "World w { Robot r { Base.fixed { } Chain c { Link l { mass = 1; Shape.Sphere radius = 1; "
     "upper_limit = -1;\n"
     "lower_limit = 1; } } } }",
     "error 2:15 lower_limit is not below upper_limit; exchange them\n"},
    {"outside_limits",
     "World w { Robot r { Base.fixed { } Chain c { Link l { mass = 1; Shape.Sphere radius = 1; "
     "upper_limit = 1;\n"
     "angle = 2; } } } }",
     "error 2:9 the joint starts at angle 2, above its upper_limit of 1; start it within its "
     "limits\n"},
    {"moving_fixed_base", "World w { Robot r { Base.fixed {\nvelocity = 1,0,0; } } }",
     "error 2:12 a Base.fixed does not move; make it a Base.mobile or leave this out\n"},
    {"placed_twice",
     "World w { Terrain.Flat g { } Robot r { Base.mobile { rest_on = g; mass = 1; Shape.Sphere "
     "radius = 1;\n"
     "location = 0,0,1; } } }",
     "error 2:12 rest_on already places the base; leave out location or rest_on (`at` and `yaw` go "
     "with rest_on)\n"},
    {"at_without_rest_on",
     "World w { Robot r { Base.mobile { mass = 1; Shape.Sphere radius = 1;\nat = 0,0; } } }",
     "error 2:6 at goes with rest_on; add `rest_on = TERRAIN` or use location and orientation\n"},
    {"nothing_to_rest_on",
     "World w { Terrain.Flat g { } Robot r { Base.mobile { mass = 1; inertia = "
     "1,1,1,0,0,0;\nrest_on = g; } } }",
     "error 2:11 `r` has no boundary points to rest on; give it a shape or a ContactPoint\n"},
    {"nothing_of_it_touches",
     "World w { Terrain.Flat g { } Robot r { Base.mobile { mass = 1; inertia = 1,1,1,0,0,0; "
     "Shape.Sphere { radius = 1; contact = false; }\nrest_on = g; } } }",
     "error 2:11 `r` has no boundary points to rest on; none of its shapes touches (`contact = "
     "false`): let one touch, or give it a ContactPoint\n"},
    {"expect_beyond_the_run",
     "World w { duration = 1 s; Robot r { Base.mobile { mass = 1; inertia = 1,1,1,0,0,0; } } }\n"
     "Expect e { of = w.r.position.z; equals = 1 m; within = 1 m;\nfrom = 2 s; }",
     "error 3:8 `from` lies beyond the run, which lasts 1 s: give the World a longer duration\n"},
    {"two_terrains", "World w { Terrain.Flat a { }\nTerrain.Flat b { } }",
     "error 2:1 a second Terrain; a World has at most one ground\nnote 1:11 the first is here\n"},
    {"off_the_terrain",
     "World w { Terrain.Flat g { size = 2; } Robot r { Base.mobile { mass = 1; Shape.Box "
     "dimensions = 1,1,1;\n"
     "location = 0.75,0,1; } } }",
     "error 2:12 `r` starts off the terrain `g`: a boundary point of it is at x,y = 1.25,-0.5; "
     "move the robot or enlarge "
     "the terrain\n"},
    {"no_grid_file", "World w { Terrain.Grid g {\nfile = \"nowhere.txt\"; } }",
     "error 2:8 there is no file \"nowhere.txt\" beside this one, in the configs/ of a folder "
     "above it or along the search path (HOOKPOINT_PATH, the installation's configs/)\n"},
    {"friction_upside_down",
     "World w { Material m { static_friction = 0.3;\nkinetic_friction = 0.5; } }",
     "error 2:20 kinetic_friction 0.5 is above static_friction 0.3: sliding would hold better than "
     "sticking; lower it "
     "or raise static_friction\n"},
    {"impulse_with_rk4", "World w { contact = impulse;\nintegrator = rk4; " + block + " }",
     "error 2:14 contact law impulse advances time from impact to impact and cannot be paired with "
     "rk4; leave the "
     "integrator out or choose a force law\n"},
    {"settings_of_dts", "World w {\nsettings = matched; }",
     "error 2:12 settings = matched is of another engine, and the engine is dts; leave it out or choose "
     "another engine\n"},
    {"hull_in_a_plane",
     "World w { Robot r { Base.mobile { mass = 1; Shape.Hull {\npoints = 0,0,0, 1,0,0, 0,1,0, "
     "1,1,0; } } } }",
     "error 2:10 these points lie in a plane, or nearly: a convex hull needs four that do not\n"},
    {"hull_of_a_number_too_many",
     "World w { Robot r { Base.mobile { mass = 1; Shape.Hull {\npoints = 0,0,0, 1,0,0, 0,1,0, "
     "0,0,1, 5; } } } }",
     "error 2:10 points are three numbers each, and 13 are no multiple of three\n"},
    {"hull_of_nothing",
     "World w { Robot r { Base.mobile { mass = 1;\nShape.Hull { scale = 1,1,1; } } } }",
     "error 2:1 a Shape.Hull has either `points` or a `file`\n"},
    {"hull_of_no_file",
     "World w { Robot r { Base.mobile { mass = 1; Shape.Hull {\nfile = \"nowhere.stl\"; } } } }",
     "error 2:8 there is no file \"nowhere.stl\" beside this one, in the configs/ of a folder "
     "above it or along the search path (HOOKPOINT_PATH, the installation's configs/)\n"},
    {"obstacle_that_points_do_not_touch",
     "World w { touch = points;\nObstacle.Sphere ball { radius = 1; } }",
     "error 2:1 bodies touch obstacles under touch = shapes alone; write it in the World\n"},
    {"obstacle_with_a_mass",
     "World w { touch = shapes;\nObstacle.Sphere ball { radius = 1; mass = 2; } }",
     "error 2:43 mass is that of a free obstacle; add `free = true` or leave it out\n"},
    {"cone_without_faces",
     "World w { Robot r { Base.mobile { mass = 1;\nShape.Legcone { length = 1; proximal_radius = "
     "0; distal_radius = 0; } "
     "} } }",
     "error 2:1 both radii of this Shape.Legcone are 0; one of them must be positive\n"},
    {"too_few_boundary_points",
     "World w { Robot r { Base.mobile { mass = 1; Shape.Cylinder { radius = 1; length = "
     "1;\nboundary_points = 2; } } } }",
     "error 2:19 boundary_points of a Shape.Cylinder is 0 (its default) or at least 3\n"},
};

std::string case_name(const ::testing::TestParamInfo<Case>& tested) { return tested.param.name; }

INSTANTIATE_TEST_SUITE_P(Load, WrongExperiment, ::testing::ValuesIn(cases), case_name);

// All that is wrong is said at once.
TEST(LoadErrors, ComeAllInOneGo) {
  EXPECT_EQ(
      diagnostics_of("World w { settings = matched; Robot r { }\nRobot s { } }"),
      "error 1:31 robot `r` has no base; give it a Base.fixed, Base.mobile or Base.planar\n"
      "error 2:1 robot `s` has no base; give it a Base.fixed, Base.mobile or Base.planar\n"
      "error 1:22 settings = matched is of another engine, and the engine is dts; leave it out or "
      "choose another "
      "engine\n");
}

// A massless link may carry one that has inertia: two joints in one place.
TEST(LoadErrors, AMasslessLinkMayCarryOthers) {
  const Loaded loaded = load_text(
      "World w { Robot r { Base.fixed { } Chain c { Link one { } Link two { dhtwist = 90 deg; mass "
      "= 1; Shape.Sphere radius = 1; } } } }");
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
}

}  // namespace
}  // namespace hookpoint
