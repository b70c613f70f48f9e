// Meshes of robots: a cube and a ball in every format, against their own dimensions; where their
// files are looked up; files that are broken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <random>
#include <sstream>
#include <tuple>

#include "simulation/dts_engine/dts_engine.h"
#include "simulation/scene/urdf/hull.h"
#include "simulation/scene/urdf/mesh.h"
#include "simulation/scene/urdf/mesh_path.h"
#include "simulation/scene/urdf/urdf.h"
#include "tests/support/folders.h"
#include "tests/support/urdf_text.h"

namespace hookpoint::tests {
namespace {

using simulation::MeshPoints;

struct Triangles {
  std::vector<Vector3d> corners;  // three a triangle
};

/// A brick from (0, -0.1, 0) to (0.3, 0.1, 0.1), two triangles a side.
Triangles brick() {
  constexpr int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Triangles mesh;
  for (const auto& side : sides) {
    for (const int k : {0, 1, 2, 0, 2, 3}) {
      const int corner = side[k];
      mesh.corners.push_back(
          {0.3 * (corner & 1), 0.2 * (corner >> 1 & 1) - 0.1, 0.1 * (corner >> 2 & 1)});
    }
  }
  return mesh;
}

/// A ball of radius 0.05 about the origin in 24 x 48 quadrangles.
Triangles ball() {
  constexpr int rows = 24, columns = 48;
  const auto at = [](int i, int j) {
    const double polar = std::numbers::pi * i / rows, turn = 2. * std::numbers::pi * j / columns;
    return Vector3d{0.05 * std::sin(polar) * std::cos(turn),
                    0.05 * std::sin(polar) * std::sin(turn), 0.05 * std::cos(polar)};
  };
  Triangles mesh;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
        mesh.corners.push_back(at(i + di, j + dj));
    }
  }
  return mesh;
}

std::string binary_stl(const Triangles& mesh, const char* header = "made here") {
  std::string bytes(80, ' ');
  std::memcpy(bytes.data(), header, std::strlen(header));
  const auto add = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(static_cast<std::uint32_t>(mesh.corners.size() / 3));
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    for (int k = 0; k < 3; ++k) add(0.f);
    for (std::size_t k = i; k < i + 3; ++k) {
      for (const double x : {mesh.corners[k].x, mesh.corners[k].y, mesh.corners[k].z})
        add(static_cast<float>(x));
    }
    add(std::uint16_t{0});
  }
  return bytes;
}

std::string ascii_stl(const Triangles& mesh) {
  std::ostringstream text;
  text << "solid brick\r\n";
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const Vector3d& p = mesh.corners[i];
    if (i % 3 == 0) text << " facet normal 0 0 0\r\n  outer loop\r\n";
    text << "   vertex " << p.x << ' ' << std::scientific << p.y << ' ' << p.z << "\r\n";
    if (i % 3 == 2) text << "  endloop\r\n endfacet\r\n";
  }
  text << "endsolid brick\r\n";
  return text.str();
}

std::string obj(const Triangles& mesh) {
  std::ostringstream text;
  text << "# made here\nmtllib none.mtl\no brick\nvn 0 0 1\n";
  for (const Vector3d& p : mesh.corners) text << "v " << p.x << ' ' << p.y << ' ' << p.z << "\n";
  for (std::size_t i = 1; i < mesh.corners.size(); i += 3)
    text << "f " << i << "//1 " << i + 1 << "//1 " << i + 2 << "//1\n";
  return text.str();
}

/// In mm, upside down and shifted, which the scene's nodes undo.
std::string collada(const Triangles& mesh) {
  std::ostringstream text;
  text
      << "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
         "version=\"1.4.1\"><asset><unit name=\"mm\" meter=\"0.001\"/><up_axis>Z_UP</up_axis>"
         "</asset><library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array "
         "id=\"a\" count=\""
      << 3 * mesh.corners.size() << "\">";
  for (const Vector3d& p : mesh.corners)
    text << 500. * p.x - 10. << ' ' << -500. * p.y << ' ' << -500. * p.z << '\n';
  text << "</float_array><technique_common><accessor source=\"#a\" stride=\"3\" count=\""
       << mesh.corners.size()
       << "\"/></technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
          "source=\"#p\"/></vertices></mesh></geometry></library_geometries>"
          "<library_nodes><node id=\"n\"><matrix>2 0 0 0  0 2 0 0  0 0 2 0  0 0 0 1</matrix>"
          "<instance_geometry url=\"#g\"/></node></library_nodes>"
          "<library_visual_scenes><visual_scene id=\"s\"><node><rotate>1 0 0 180</rotate><node>"
          "<translate>20 0 0</translate><instance_node url=\"#n\"/></node></node></visual_scene>"
          "</library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
  return text.str();
}

struct Format {
  const char* name;
  std::string (*write)(const Triangles&);
};
std::string misleading_stl(const Triangles& mesh) { return binary_stl(mesh, "solid by Works"); }
const Format formats[] = {{"a.stl", [](const Triangles& mesh) { return binary_stl(mesh); }},
                          {"b.STL", misleading_stl},
                          {"c.stl", ascii_stl},
                          {"d.obj", obj},
                          {"e.dae", collada}};

/// A robot of one body, whose collision is the mesh.
std::string robot_of(const std::string& mesh, const std::string& origin = "") {
  return "<robot name=\"r\"><link name=\"b\">" + urdf_text::inertial + "<collision>" + origin +
         "<geometry>\n" + mesh + "</geometry></collision></link></robot>";
}

struct Robot : testing::Workplace {
  Loaded load(const std::string& urdf, const std::string& arguments) const {
    file("robot.urdf", urdf);
    return load_file(file("scene.hook", "World w { Include \"robot.urdf\" (" + arguments + "); }"));
  }
};

void expect_near(const Vector3d& a, const Vector3d& b, double within) {
  EXPECT_LT(norm(a - b), within) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(UrdfMesh, BoxIsTheMeshsOwnWhereItStands) {
  for (const Format& format : formats) {
    const Robot robot;
    robot.file(format.name, format.write(brick()));
    const Loaded loaded = robot.load(
        robot_of("<mesh filename=\"" + std::string(format.name) + "\" scale=\"2 -1 1\"/>",
                 "<origin xyz=\"1 2 3\" rpy=\"0 0 1.5707963267948966\"/>"),
        "meshes = box");
    ASSERT_TRUE(loaded.experiment) << format.name << loaded.diagnostics;
    const auto& shapes = loaded.experiment->robots.at(0).base.shapes;
    ASSERT_EQ(shapes.size(), 1u);
    expect_near(std::get<simulation::Box>(shapes[0].geometry).dimensions, {0.6, 0.2, 0.1}, 1e-7);
    expect_near(shapes[0].location, {1., 2.3, 3.05}, 1e-7);
    EXPECT_NEAR(shapes[0].orientation.z, std::sqrt(0.5), 1e-15);
    EXPECT_EQ(loaded.diagnostics, "");
  }
}

TEST(UrdfMesh, HullOfABrickIsItsEightCorners) {
  for (const Format& format : formats) {
    const Robot robot;
    robot.file(format.name, format.write(brick()));
    const Loaded loaded = robot.load(
        robot_of("<mesh filename=\"file://" + (robot.folder() / format.name).string() + "\"/>",
                 "<origin xyz=\"0 0 1\"/>"),
        "meshes = hull");
    ASSERT_TRUE(loaded.experiment) << format.name << loaded.diagnostics;
    const simulation::BodySpec& body = loaded.experiment->robots.at(0).base;
    EXPECT_TRUE(body.shapes.empty());
    ASSERT_EQ(body.boundary_points.size(), 8u) << format.name;
    std::vector<Vector3d> points = body.boundary_points;
    std::ranges::sort(
        points, {}, [](const Vector3d& p) { return std::tuple(p.x > 0.15, p.y > 0., p.z > 1.05); });
    for (int i = 0; i < 8; ++i)
      expect_near(points[std::size_t(i)],
                  {0.3 * (i >> 2), 0.2 * (i >> 1 & 1) - 0.1, 1. + 0.1 * (i & 1)}, 1e-7);
  }
}

/// Of 24 x 48 quadrangles 23 x 48 + 2 vertices, all on the hull.
TEST(UrdfMesh, AHullOfManyVerticesIsThinnedAndKeepsTheOutermost) {
  const Robot robot;
  robot.file("ball.stl", binary_stl(ball()));
  const Loaded loaded = robot.load(robot_of("<mesh filename=\"ball.stl\"/>"), "meshes = hull");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.diagnostics, "note 1:2 left out: vertex of a hull, beyond 64 of it (" +
                                    std::to_string(23 * 48 + 2 - 64) + ")\n");
  const auto& points = loaded.experiment->robots.at(0).base.boundary_points;
  ASSERT_EQ(points.size(), simulation::most_hull_points);
  for (const Vector3d& p : points) EXPECT_NEAR(norm(p), 0.05, 1e-8);
  for (const Vector3d& axis : {Vector3d{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}}) {
    for (const double side : {0.05, -0.05}) {
      EXPECT_EQ(std::ranges::count_if(
                    points, [&](const Vector3d& p) { return norm(p - side * axis) < 1e-6; }),
                1);
    }
  }
  // No gap of the ball is wider than 64 caps of the same area would leave.
  for (const Vector3d& corner : ball().corners) {
    double nearest = 1.;
    for (const Vector3d& p : points) nearest = std::min(nearest, norm(corner - p));
    EXPECT_LT(nearest, 2. * 0.05 * std::sqrt(4. / 64.));
  }
}

TEST(UrdfMesh, ABrickThatTouchesByItsHullRestsOnASlopeAsABoxDoes) {
  const Robot robot;
  robot.file("brick.stl", binary_stl(brick()));
  const std::string world =
      "World w { deltat = 1 ms; Material floor { static_friction = 0.8; kinetic_friction = 0.7; } "
      "Terrain.Slope ground { angle = 15 deg; material = floor; } Include \"robot.urdf\" (rest_on "
      "= ground, settled = false, meshes = hull); }";
  const auto end_of = [&](const std::string& geometry, const std::string& origin) {
    robot.file("robot.urdf", robot_of(geometry, origin));
    const Loaded loaded = load_file(robot.file("scene.hook", world));
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    const auto engine = simulation::make_dts(loaded.experiment.value());
    const Vector3d start = engine->state().bodies[0].position;
    for (int i = 0; i < 2000; ++i) EXPECT_TRUE(engine->step().ok());
    const Vector3d at = engine->state().bodies[0].position;
    for (int i = 0; i < 2000; ++i) EXPECT_TRUE(engine->step().ok());
    EXPECT_LT(norm(engine->state().bodies[0].position - at), 1e-8);
    return at - start;
  };
  const Vector3d by_hull = end_of("<mesh filename=\"brick.stl\"/>", "");
  const Vector3d by_box = end_of("<box size=\"0.3 0.2 0.1\"/>", "<origin xyz=\"0.15 0 0.05\"/>");
  expect_near(by_hull, by_box, 1e-6);
  EXPECT_LT(norm(by_hull), 1e-2);
}

TEST(UrdfMesh, IsLookedUpInItsPackageAndAlongTheSearchPath) {
  const testing::Workplace place;
  const std::filesystem::path folder = place.folder();
  const auto make = [&](const char* path) {
    std::filesystem::create_directories((folder / path).parent_path());
    return place.file(path, binary_stl(brick()));
  };
  make("dog_description/meshes/leg.stl");
  make("named/meshes/paw.stl");
  place.file("named/package.xml", "<package/>");
  make("cat_description/meshes/ear.stl");
  make("elsewhere/cow/horn.stl");
  make("elsewhere/tail.stl");
  std::filesystem::create_directories(folder / "dog_description/urdf");
  std::filesystem::create_directories(folder / "named/urdf");
  const auto found = [&](const std::string& filename, const char* robot) {
    for (const std::filesystem::path& path :
         simulation::mesh_places(filename, folder / robot, {folder / "elsewhere"})) {
      if (std::filesystem::exists(path)) return std::filesystem::relative(path, folder).string();
    }
    return std::string();
  };
  const char* dog = "dog_description/urdf/dog.urdf";
  EXPECT_EQ(found("package://dog_description/meshes/leg.stl", dog),
            "dog_description/meshes/leg.stl");
  EXPECT_EQ(found("../meshes/leg.stl", dog), "dog_description/meshes/leg.stl");
  EXPECT_EQ(found("package:///dog_description/meshes/leg.stl", dog),
            found("package://dog_description/meshes/leg.stl", dog));
  EXPECT_EQ(found("package://cat_description/meshes/ear.stl", dog),
            "cat_description/meshes/ear.stl");
  EXPECT_EQ(found("model://cow/horn.stl", dog), "elsewhere/cow/horn.stl");
  EXPECT_EQ(found("tail.stl", dog), "elsewhere/tail.stl");
  EXPECT_EQ(found("package://robot/meshes/paw.stl", "named/urdf/r.urdf"), "named/meshes/paw.stl");
  EXPECT_EQ(found("file://" + (folder / "elsewhere/tail.stl").string(), dog), "elsewhere/tail.stl");
  for (const char* none :
       {"http://host/leg.stl", "package://dog_description", "package:///leg.stl", "leg\n.stl", ""})
    EXPECT_TRUE(simulation::mesh_places(none, folder / dog, {}).empty()) << none;
}

TEST(UrdfMesh, WhatCannotBeReadIsRefusedAtItsName) {
  const Robot robot;
  const std::string folder = robot.folder().string();
  robot.file("short.stl", binary_stl(brick()).substr(0, 300));
  robot.file("empty.obj", "");
  robot.file("word.obj", "v 0 0 0\nv 1 2\n");
  robot.file("nan.stl", "solid\nvertex 0 0 nan\n");
  robot.file("far.obj", "v 0 0 1e7\n");
  robot.file("mesh.ply", "ply\n");
  robot.file("wrong.dae", "<COLLADA><library_geometries>");
  const auto error = [&](const std::string& mesh, const std::string& meshes = "hull") {
    const Loaded loaded = robot.load(robot_of(mesh), "meshes = " + meshes);
    EXPECT_FALSE(loaded.experiment) << mesh;
    return loaded.diagnostics.substr(0, loaded.diagnostics.find("\nnote"));
  };
  const auto broken = [&](const std::string& name, const std::string& why) {
    EXPECT_EQ(error("<mesh filename=\"" + name + "\"/>").substr(0, 400),
              "error 2:7 the mesh " + folder + "/" + name + " cannot be read: " + why);
  };
  broken("short.stl", "it says 12 triangles and ends after 4");
  broken("empty.obj", "it has no vertices");
  broken("word.obj", "line 2: a vertex has three numbers");
  broken("nan.stl", "line 2: a vertex has three numbers");
  broken("far.obj", "it has a coordinate that is no number up to 1e+06");
  broken(
      "mesh.ply",
      "this is PLY, which is not read here: meshes are read from STL, OBJ and DAE (Collada) files; "
      "convert it to one of them");
  broken("wrong.dae", "it is no XML: Start-end tags mismatch");
  for (const char* meshes : {"box", "hull"}) {
    EXPECT_EQ(error("<mesh filename=\"leg.stl\"/>", meshes),
              "error 2:7 there is no mesh `leg.stl`: looked for " + folder + "/leg.stl, " +
                  testing::source_folder() +
                  "/configs/leg.stl (HOOKPOINT_PATH names further folders; "
                  "meshes = skip does without)");
  }
  EXPECT_EQ(error("<mesh filename=\"https://host/leg.stl\"/>"),
            "error 2:7 a mesh is named by a path, or by package://NAME/PATH or file://PATH");
  EXPECT_EQ(error("<mesh/>"), "error 2:2 this <mesh> has no filename");
  robot.file("brick.stl", binary_stl(brick()));
  EXPECT_EQ(error("<mesh filename=\"brick.stl\" scale=\"1 0 1\"/>"),
            "error 2:28 a scale of 0 leaves nothing of a mesh");
  EXPECT_TRUE(robot.load(robot_of("<mesh filename=\"leg.stl\"/>"), "meshes = skip").experiment);
  EXPECT_NE(error("<mesh filename=\"leg.stl\"/>", "all")
                .find("the argument `meshes` is skip, box or hull"),
            std::string::npos);
}

/// The text of `whole` with `now` in the place of `was`.
std::string changed(std::string whole, const std::string& was, const std::string& now) {
  const std::size_t at = whole.find(was);
  EXPECT_NE(at, std::string::npos) << was;
  return whole.replace(at, was.size(), now);
}

TEST(UrdfMesh, ColladaThatContradictsItselfIsRefused) {
  const std::string whole = collada(brick());  // 36 vertices, 108 numbers
  const auto problem = [&](const std::string& was, const std::string& now) {
    return simulation::read_collada(changed(whole, was, now)).problem;
  };
  for (const char* meter :
       {"0", "-1", "x", "", "nan", "inf", "1e400", "1e-300", "1e-10", "1e10", "1 2", "0x1"})
    EXPECT_EQ(problem("meter=\"0.001\"", "meter=\"" + std::string(meter) + "\""),
              "<unit meter=\"" + std::string(meter) +
                  "\">: a length in metres from 1e-09 to 1e+09 is expected");
  for (const char* stride : {"4294967296", "4294967299", "-3", "3.5", "x", "", "1e30"})
    EXPECT_EQ(problem("stride=\"3\"", "stride=\"" + std::string(stride) + "\""),
              "<accessor stride=\"" + std::string(stride) +
                  "\">: a whole number from 0 to 30000000 is expected");
  EXPECT_EQ(problem("stride=\"3\"", "stride=\"2\""), "its positions have fewer than three numbers");
  EXPECT_EQ(problem("stride=\"3\"", "stride=\"1000\""),
            "an <accessor> takes 36 vertices of 1000 numbers each, and there are 108 numbers from "
            "its offset 0 on");
  EXPECT_EQ(problem("stride=\"3\" count=\"36\"", "stride=\"1000\""),
            "an <accessor> takes 0 vertices of 1000 numbers each, and there are 108 numbers from "
            "its offset 0 on");
  EXPECT_EQ(problem("stride=\"3\"", "offset=\"9\" stride=\"3\""),
            "an <accessor> takes 36 vertices of 3 numbers each, and there are 99 numbers from its "
            "offset 9 on");
  EXPECT_EQ(problem("count=\"36\"", "count=\"35\""),
            "an <accessor> takes 35 vertices of 3 numbers each, and there are 108 numbers from its "
            "offset 0 on");
  EXPECT_EQ(problem("count=\"108\"", "count=\"105\""),
            "<float_array count=\"105\"> has 108 numbers");
  for (const char* reference : {"url=\"#g\"", "url=\"#n\"", "url=\"#s\"", "source=\"#p\""})
    EXPECT_TRUE(problem(reference, changed(reference, "#", "#no"))
                    .ends_with(": the file has no such element"))
        << reference;
  EXPECT_EQ(problem("POSITION", "NORMAL"), "its <vertices> have no input of semantic POSITION");
  EXPECT_EQ(problem("2 0 0 0  0 2 0 0", "2 0 0 0  0 0 0 0"),
            "a <matrix> of its scene leaves nothing of a volume");
  EXPECT_EQ(problem("0 0 0 1</matrix>", "0 0 0 2</matrix>"),
            "the last row of a <matrix> of its scene is not 0 0 0 1");
  EXPECT_EQ(problem("<rotate>1 0 0 180", "<rotate>0 0 0 180"),
            "a <rotate> of its scene has an axis of length 0");
  EXPECT_EQ(problem("<translate>20 0 0</translate>", "<scale>1 0 1</scale>"),
            "a <scale> of its scene leaves nothing of a volume");
  // Both defaults and what a file may leave out.
  EXPECT_EQ(problem("stride=\"3\" count=\"36\"", ""), "");
  EXPECT_EQ(problem("<unit name=\"mm\" meter=\"0.001\"/>", ""), "");
  EXPECT_EQ(problem("<rotate>1 0 0 180", "<rotate>0 0 0 0"), "");
}

TEST(UrdfMesh, StlThatSaysFewerOrMoreTrianglesIsRefused) {
  const auto said = [](std::uint32_t triangles) {
    std::string bytes = binary_stl(brick());
    std::memcpy(bytes.data() + 80, &triangles, sizeof triangles);
    return simulation::read_stl(bytes).problem;
  };
  EXPECT_EQ(said(12), "");
  EXPECT_EQ(said(11), "it says 11 triangles and has 12");
  EXPECT_EQ(said(0), "it says 0 triangles and has 12");
  EXPECT_EQ(said(13), "it says 13 triangles and ends after 12");
  EXPECT_EQ(said(4'294'967'295U), "it says 4294967295 triangles and ends after 12");
  EXPECT_EQ(simulation::read_stl("solid\nvertex 0 0 0\nvertex 0 0 1\n").problem,
            "it ends within a triangle");
}

TEST(UrdfMesh, ObjWhoseFacesNameNoVertexIsRefused) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto problem = [&](const std::string& more) {
    return simulation::read_obj(triangle + more).problem;
  };
  for (const char* good :
       {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1\n", "f -1 -2 -3\r\n", "f 1 2 4\nv 0 0 1",
        "v 0 0 1 1", "v 0 0 1 0.5 0.5 0.5\n", "l 1 2", "p 3"})
    EXPECT_EQ(problem(good), "") << good;
  EXPECT_EQ(problem("f 1 2 4"), "a face names vertex 4 of 3");
  EXPECT_EQ(problem("f 1 2 1e300"), "a face names vertex 1e+300 of 3");
  EXPECT_EQ(problem("vt 0 0\nf 1/9 2/1 3/1"), "a face names place in the texture 9 of 1");
  EXPECT_EQ(problem("vn 0 0 1\nf 1//1 2//1 3//2"), "a face names normal 2 of 1");
  EXPECT_EQ(problem("vt 0 0\nf 1/x 2/1 3/1"), "line 5: `1/x` names no place in the texture");
  for (const char* index : {"0", "-4", "x", "1.5", "/1", "nan"})
    EXPECT_EQ(problem("f 1 2 " + std::string(index)),
              "line 4: `" + std::string(index) + "` names no vertex");
  EXPECT_EQ(problem("v 0 0 1 red"), "line 4: a vertex has three numbers");
}

TEST(UrdfMesh, ColladaWhoseFacesContradictItIsRefused) {
  const std::string whole = collada(brick());  // 36 vertices
  const auto problem = [&](const std::string& faces) {
    return simulation::read_collada(changed(whole, "</mesh>", faces + "</mesh>")).problem;
  };
  const std::string vertex = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";
  const std::string normal = "<input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/>";
  const auto triangles = [&](int count, const std::string& inputs, const std::string& p) {
    return problem("<triangles count=\"" + std::to_string(count) + "\">" + inputs + "<p>" + p +
                   "</p></triangles>");
  };
  EXPECT_EQ(triangles(2, vertex, "0 1 2 0 1 35"), "");
  EXPECT_EQ(triangles(1, vertex + normal, "0 7 1 7 2 7"), "");
  EXPECT_EQ(triangles(2, vertex, "0 1 2 0 1 36"),
            "its <triangles> name vertex 36 of 36, counted "
            "from 0");
  EXPECT_EQ(triangles(1, vertex, "0 1 -1"), "its <triangles> name vertex -1 of 36, counted from 0");
  EXPECT_EQ(triangles(9, vertex, "0 1 2"),
            "<triangles count=\"9\"> has 3 indices in its <p>, and 27 belong to it");
  EXPECT_EQ(triangles(1, vertex, ""),
            "<triangles count=\"1\"> has 0 indices in its <p>, and 3 belong to it");
  EXPECT_EQ(problem("<polylist count=\"2\">" + vertex +
                    "<vcount>4 3</vcount><p>0 1 2 3 4 5 6</p></polylist>"),
            "");
  EXPECT_EQ(
      problem("<polylist count=\"2\">" + vertex + "<vcount>4</vcount><p>0 1 2 3</p></polylist>"),
      "<polylist count=\"2\"> has 1 numbers in its <vcount>");
}

TEST(UrdfMesh, BrokenFilesGiveVerticesOrAProblem) {
  std::mt19937 random(5);
  using Reader = MeshPoints (*)(std::string_view);
  const std::pair<std::string, Reader> files[] = {{binary_stl(brick()), simulation::read_stl},
                                                  {ascii_stl(brick()), simulation::read_stl},
                                                  {obj(brick()), simulation::read_obj},
                                                  {collada(brick()), simulation::read_collada}};
  for (const auto& [whole, read] : files) {
    EXPECT_EQ(read(whole).problem, "");
    for (int i = 0; i < 2000; ++i) {
      std::string bytes = whole.substr(0, i % 2 == 0 ? whole.size() : random() % whole.size());
      for (int k = 0; k < 3 && !bytes.empty(); ++k) bytes[random() % bytes.size()] = char(random());
      const MeshPoints mesh = read(bytes);
      EXPECT_LE(mesh.vertices.size(), bytes.size());
    }
  }
  // A node that stands in itself, and one that stands a thousand times in each of a hundred.
  std::string nodes;
  for (int i = 0; i < 100; ++i) {
    nodes += "<node id=\"n" + std::to_string(i) + "\">";
    for (int k = 0; k < 10; ++k)
      nodes += "<instance_node url=\"#n" + std::to_string((i + 1) % 100) + "\"/>";
    nodes += "</node>";
  }
  EXPECT_EQ(simulation::read_collada("<COLLADA><library_visual_scenes><visual_scene>" + nodes +
                                     "</visual_scene></library_visual_scenes></COLLADA>")
                .problem,
            "its nodes stand in one another too often");
}

TEST(Hull, IsOfWhatStandsOut) {
  using simulation::hull_vertices;
  // As a file of single precision has it: points of a side stand out by its rounding.
  const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  std::vector<Vector3d> grid, plane, line;
  for (int i = 0; i < 11; ++i) {
    line.push_back({0.1 * i, 0.2 * i, 0.3 * i});
    for (int j = 0; j < 11; ++j) {
      plane.push_back({0.1 * i, 0.1 * j, 0.});
      for (int k = 0; k < 11; ++k)
        grid.push_back({single(0.1 * i), single(0.07 * j), single(0.1 * k)});
    }
  }
  EXPECT_EQ(hull_vertices(grid).size(), 8u);
  EXPECT_EQ(hull_vertices(plane).size(), plane.size());
  EXPECT_EQ(hull_vertices(line).size(), line.size());
  EXPECT_EQ(hull_vertices(std::vector<Vector3d>{{1., 2., 3.}}).size(), 1u);
  const auto few = simulation::spread_points(plane, 4);
  ASSERT_EQ(few.size(), 4u);
  for (const Vector3d& p : few)
    EXPECT_TRUE((p.x == 0. || p.x == 1.) && (p.y == 0. || p.y == 1.)) << p.x << ' ' << p.y;
}

// Every point is on the inner side of every face, and the faces of a cube's grid are its six.
TEST(Meshes, ConvexHullHasFacesThatLookOutwards) {
  std::vector<Vector3d> grid;
  for (int x = 0; x <= 2; ++x)
    for (int y = 0; y <= 2; ++y)
      for (int z = 0; z <= 2; ++z) grid.push_back({0.1 * x, 0.2 * y, 0.3 * z});
  const simulation::Hull hull = simulation::convex_hull(grid);
  EXPECT_EQ(hull.vertices.size(), 8u);
  EXPECT_EQ(hull.faces.size(), 6u);
  for (const auto& face : hull.faces) {
    const Vector3d normal = simulation::face_normal(hull, face);
    for (const Vector3d& p : grid) EXPECT_LE(dot(normal, p - hull.vertices[face[0]]), 1e-12);
  }
  grid.resize(9);  // x = 0
  EXPECT_TRUE(simulation::convex_hull(grid).faces.empty());
}

}  // namespace
}  // namespace hookpoint::tests
