// Robots read from URDF: where their links stand and how they accelerate, against URDF's own
// definitions; what is refused, in which words and at which line; files that are no URDF at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "dts/configuration.h"
#include "dts/energy.h"
#include "dts/forward_dynamics.h"
#include "simulation/dts_engine/robot_description.h"
#include "simulation/experiment/robot_tree.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/printed_run.h"
#include "tests/support/run_text.h"
#include "tests/support/text.h"
#include "tests/support/urdf_robot.h"
#include "tests/support/urdf_text.h"

namespace hookpoint::tests {
namespace {

using urdf_text::base, urdf_text::inertial, urdf_text::joint, urdf_text::link_l,
    urdf_text::load_urdf, urdf_text::robot;

Eigen::Vector3d eigen(const Vector3d& a) { return {a.x, a.y, a.z}; }
Eigen::Matrix3d eigen(const Matrix3d& m) {
  return (Eigen::Matrix3d() << m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz).finished();
}

/// A random robot as the numbers say it, and as it was read, in one random state.
struct Pair {
  UrdfNumbers numbers;
  simulation::RobotSpec spec;
  Eigen::Isometry3d root;
  std::vector<double> q;          // one a moving joint, the file's order
  dts::State<double> state;       // the same in the order of bodies
  std::vector<std::size_t> body;  // of each link: the body that it became or is fixed to
  std::vector<std::size_t> link;  // of each body: the link that names it

  /// Velocities or forces in the order of bodies from those in the file's.
  Eigen::VectorXd in_order_of_bodies(const Eigen::VectorXd& of_file) const {
    Eigen::VectorXd of_bodies = of_file;
    Eigen::Index column = 6;
    for (const UrdfNumbers::Joint& joint : numbers.joints)
      if (joint.moves()) of_bodies[5 + Eigen::Index(body[joint.child])] = of_file[column++];
    return of_bodies;
  }
};

/// Links that move become bodies of their names.
Pair random_pair(RandomUrdf& random, const UrdfNumbers& numbers) {
  Pair pair{numbers, {}, Eigen::Isometry3d::Identity(), {}, {}, {0}, {0}};
  const Loaded loaded = load_urdf(numbers.text());
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  if (!loaded.experiment) return pair;
  pair.spec = loaded.experiment->robots.at(0);
  pair.root.linear() = UrdfNumbers::rotation(random.vector(3.));
  pair.root.translation() = random.vector(2.);
  const Eigen::Quaterniond q(pair.root.linear());
  const Eigen::Vector3d p = pair.root.translation();
  pair.state.base_orientation = {q.w(), q.x(), q.y(), q.z()};
  pair.state.base_position = {p.x(), p.y(), p.z()};
  std::map<std::string, std::size_t> bodies;
  simulation::for_each_link(
      pair.spec, [&](const simulation::TreeLink& at) { bodies[at.link.body.name] = at.body; });
  pair.link.resize(1 + bodies.size());
  pair.state.joint_positions.resize(bodies.size());
  for (const UrdfNumbers::Joint& joint : numbers.joints) {
    pair.body.push_back(pair.body[joint.parent]);
    if (!joint.moves()) continue;
    pair.body.back() = bodies.at(numbers.links[joint.child].name);
    pair.link[pair.body.back()] = joint.child;
    pair.q.push_back(random.uniform(-3., 3.));
    pair.state.joint_positions[pair.body.back() - 1] = pair.q.back();
  }
  pair.state.joint_rates.assign(pair.q.size(), 0.);
  return pair;
}

/// Axes of a body: those of its link, turned by the least rotation from z to the joint's axis.
Eigen::Matrix3d link_axes(const Eigen::Matrix3d& R_WB, const UrdfNumbers::Joint& joint) {
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), joint.axis);
  return R_WB * turn.toRotationMatrix().transpose();
}

class RandomRobot : public ::testing::TestWithParam<double> {};

TEST_P(RandomRobot, StandsWhereItsNumbersSay) {
  RandomUrdf random(7);
  for (int i = 0; i < 30; ++i) {
    const bool branches = i >= 15;
    const Pair pair = random_pair(
        random, branches ? random.tree(20, GetParam()) : random.robot(3, 4, GetParam()));
    if (!branches) {
      ASSERT_EQ(pair.spec.chains.size(), 3u);
    }
    const dts::Model<double> model(simulation::describe_robot(pair.spec));
    dts::Workspace<double> workspace(model);
    dts::forward_kinematics(model, pair.state, workspace);
    const auto truth = pair.numbers.poses(pair.root, pair.q);
    for (std::size_t body = 0; body < model.body_count(); ++body) {
      const std::size_t link = pair.link[body];
      const dts::BodyMotion<double>& here = workspace.bodies[body];
      EXPECT_LE((eigen(here.p_WB) - truth[link].translation()).norm(), 1e-12);
      const Eigen::Matrix3d R =
          body == 0 ? eigen(here.R_WB) : link_axes(eigen(here.R_WB), pair.numbers.joints[link - 1]);
      EXPECT_LE((R - truth[link].linear()).norm(), 1e-12) << "body " << body;
    }
  }
}

TEST_P(RandomRobot, AcceleratesAsItsOwnLinksTellOneByOne) {
  RandomUrdf random(8);
  for (int i = 0; i < 30; ++i) {
    const Pair pair =
        random_pair(random, i >= 15 ? random.tree(16, GetParam()) : random.robot(2, 3, GetParam()));
    const dts::Model<double> model(simulation::describe_robot(pair.spec));
    dts::Workspace<double> workspace(model);
    const Eigen::Vector3d g = random.vector(10.);
    const std::vector<double> torques(pair.q.size(), 0.7);
    dts::forward_dynamics(model, pair.state, {g.x(), g.y(), g.z()}, torques, workspace);
    std::vector<double> found(dts::velocity_count(model));
    dts::get_acceleration(model, workspace, std::span<double>(found));

    const UrdfNumbers::Still still = pair.numbers.at_rest(pair.root, pair.q, g);
    Eigen::VectorXd force = still.gravity;
    force.tail(Eigen::Index(torques.size())).array() += 0.7;
    const Eigen::VectorXd truth = pair.in_order_of_bodies(still.M.fullPivLu().solve(force));
    const Eigen::Map<const Eigen::VectorXd> a(found.data(), Eigen::Index(found.size()));
    EXPECT_LE((a - truth).lpNorm<Eigen::Infinity>(), 1e-10 * truth.lpNorm<Eigen::Infinity>());

    // Energy in motion sees every element of M.
    dts::State<double> moving = pair.state;
    Eigen::VectorXd v(Eigen::Index(found.size()));
    for (double& x : v) x = random.uniform(-2., 2.);
    const Eigen::VectorXd ours = pair.in_order_of_bodies(v);
    dts::set_velocity(model, std::span<const double>(ours.data(), std::size_t(ours.size())),
                      moving);
    dts::forward_kinematics(model, moving, workspace);
    const double energy = 0.5 * v.dot(still.M * v);
    EXPECT_NEAR(dts::kinetic_energy(model, workspace), energy, 1e-12 * energy);
  }
}

// 1e-6: a rounded file; 1e-9 and 0: common normals are far away, or anywhere.
INSTANTIATE_TEST_SUITE_P(Tilts, RandomRobot, ::testing::Values(2., 0.5, 1e-6, 1e-9, 0.));

// Bullet's <contact> of a link and Gazebo's extension of the robot.
TEST(Urdf, SurfacesAreMaterials) {
  const std::string ball = "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>";
  const std::string text =
      "<robot name=\"r\"><link name=\"a\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" "
      "izz=\"1\"/></inertial>" +
      ball +
      "<contact><lateral_friction value=\"0.7\"/><rolling_friction value=\"0.01\"/><stiffness "
      "value=\"30000\"/><damping value=\"1000\"/></contact></link><link name=\"b\"><inertial><mass "
      "value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial>" +
      ball +
      "</link><joint name=\"j\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/></joint>"
      "<gazebo reference=\"b\"><mu1>0.6</mu1><kp value=\"5000\"/><kd>0</kd></gazebo></robot>";
  const auto materials = [&](const std::string& arguments) {
    const Loaded loaded = load_urdf(text, arguments);
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    std::vector<std::optional<contact::MaterialConstants<double>>> found;
    const simulation::RobotSpec& robot = loaded.experiment->robots.at(0);
    for (const simulation::BodySpec* body : {&robot.base, &robot.chains.at(0).links.at(0).body}) {
      const int index = body->shapes.at(0).material;
      found.emplace_back();
      if (index != simulation::no_material)
        found.back() = loaded.experiment->materials.at(static_cast<std::size_t>(index)).constants;
    }
    return found;
  };
  const auto friction = materials("");
  EXPECT_EQ(friction[0]->static_friction, 0.7);
  EXPECT_EQ(friction[0]->rolling_resistance, 0.);
  EXPECT_EQ(friction[1]->kinetic_friction, 0.6);
  const auto all = materials(", contact = file");
  EXPECT_EQ(all[0]->normal_stiffness, 30000.);
  EXPECT_EQ(all[0]->normal_damping, 1000.);
  EXPECT_EQ(all[0]->rolling_resistance, 0.01);
  EXPECT_EQ(all[1]->normal_stiffness, 5000.);
  EXPECT_EQ(all[1]->normal_damping, contact::MaterialConstants<double>{}.normal_damping);
  const auto none = materials(", contact = ground");
  EXPECT_FALSE(none[0] || none[1]);
}

TEST(Urdf, LimitsDampingFrictionAndEffortComeAlong) {
  const Loaded loaded = load_urdf(
      robot(link_l + joint("knee", "revolute",
                           "<limit lower=\"-0.5\" upper=\"1.25\" effort=\"9\" velocity=\"8\"/>"
                           "<dynamics damping=\"0.3\" friction=\"0.2\"/>")),
      ", knee = -10 deg, location = 1,2,3, yaw_is_none = 1");
  EXPECT_EQ(
      loaded.diagnostics,
      "error 1:77 the robot takes no argument `yaw_is_none`; it takes name, base, shapes, "
      "meshes, contact, mimic, lock, inertia, hold, rotor_inertia, fields of its base, and the names of its moving "
      "joints\n");
  const Loaded good = load_urdf(
      robot(link_l + joint("knee", "revolute",
                           "<limit lower=\"-0.5\" upper=\"1.25\" effort=\"9\" velocity=\"8\"/>"
                           "<dynamics damping=\"0.3\" friction=\"0.2\"/>")),
      ", knee = -10 deg, location = 1,2,3");
  ASSERT_TRUE(good.experiment) << good.diagnostics;
  const simulation::RobotSpec& read = good.experiment->robots.at(0);
  EXPECT_EQ(read.location, (Vector3d{1., 2., 3.}));
  EXPECT_TRUE(read.mobile);
  EXPECT_EQ(read.chains.at(0).name, "knee");
  const simulation::LinkSpec& link = read.chains[0].links.at(0);
  EXPECT_EQ(link.body.name, "l");
  EXPECT_EQ(link.lower_limit, -0.5);
  EXPECT_EQ(link.upper_limit, 1.25);
  EXPECT_EQ(link.damping, 0.3);
  EXPECT_EQ(link.friction, 0.2);
  EXPECT_EQ(link.effort_limit, 9.);
  EXPECT_EQ(link.velocity_limit, 8.);
  EXPECT_DOUBLE_EQ(link.angle, -10. * M_PI / 180.);
}

const std::string looks =
    "<link name=\"l\"><visual><geometry><sphere radius=\"0.3\"/></geometry></visual>"
    "<collision><origin xyz=\"0 0 1\" rpy=\"0 0 0.5\"/><geometry><box size=\"1 2 3\"/></geometry>"
    "</collision><collision><geometry><cylinder radius=\"0.1\" length=\"0.4\"/></geometry>"
    "</collision></link>";

TEST(Urdf, CollisionGeometryBecomesShapesOfTheBodyThatItIsFixedTo) {
  const std::string text =
      robot(looks + joint("weld", "fixed", "<origin xyz=\"1 0 0\" rpy=\"0 0 0.5\"/>"));
  const Loaded loaded = load_urdf(text, ", base = fixed");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::RobotSpec& read = loaded.experiment->robots.at(0);
  EXPECT_FALSE(read.mobile);
  EXPECT_TRUE(read.chains.empty());
  ASSERT_EQ(read.base.shapes.size(), 2u);
  const simulation::ShapeSpec& box = read.base.shapes[0];
  EXPECT_EQ(std::get<simulation::Box>(box.geometry).dimensions, (Vector3d{1., 2., 3.}));
  EXPECT_EQ(box.location, (Vector3d{1., 0., 1.}));
  EXPECT_NEAR(box.orientation.w, std::cos(0.5), 1e-15);
  EXPECT_NEAR(box.orientation.z, std::sin(0.5), 1e-15);
  const auto& cylinder = std::get<simulation::Cylinder>(read.base.shapes[1].geometry);
  EXPECT_EQ(cylinder.radius, 0.1);
  EXPECT_EQ(cylinder.length, 0.4);

  const Loaded visual = load_urdf(text, ", shapes = visual");
  ASSERT_TRUE(visual.experiment) << visual.diagnostics;
  const auto& shapes = visual.experiment->robots.at(0).base.shapes;
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(std::get<simulation::Sphere>(shapes[0].geometry).radius, 0.3);
}

TEST(Urdf, AJointThatFollowsAnotherMovesByItselfOrIsFixedAtItsOffset) {
  // X = Trans(1, 0, 0) Rz(0.5), as the weld of the test above: the box at z = 1 turned by 1 rad.
  const std::string text =
      robot(looks + joint("finger", "continuous",
                          "<origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/>"
                          "<mimic joint=\"k\" multiplier=\"2\" offset=\"0.5\"/>"));
  const Loaded fixed = load_urdf(text, ", base = fixed, mimic = fixed");
  ASSERT_TRUE(fixed.experiment) << fixed.diagnostics;
  EXPECT_NE(fixed.diagnostics.find("<mimic>: the joint is fixed at its offset (1)"),
            std::string::npos)
      << fixed.diagnostics;
  const simulation::RobotSpec& read = fixed.experiment->robots.at(0);
  EXPECT_TRUE(read.chains.empty());
  ASSERT_EQ(read.base.shapes.size(), 2u);
  EXPECT_NEAR(read.base.shapes[0].location.x, 1., 1e-15);
  EXPECT_NEAR(read.base.shapes[0].location.z, 1., 1e-15);
  EXPECT_NEAR(read.base.shapes[0].orientation.w, std::cos(0.5), 1e-15);
  EXPECT_NEAR(read.base.shapes[0].orientation.z, std::sin(0.5), 1e-15);

  const std::string heavy = robot(link_l + joint("finger", "continuous", "<mimic joint=\"k\"/>"));
  const Loaded free = load_urdf(heavy, ", mimic = ignore, finger = 0.25");
  ASSERT_TRUE(free.experiment) << free.diagnostics;
  EXPECT_EQ(free.experiment->robots.at(0).chains.at(0).links.at(0).angle, 0.25);
  EXPECT_NE(free.diagnostics.find("<mimic>: the joint moves by itself (1)"), std::string::npos)
      << free.diagnostics;
  EXPECT_NE(
      load_urdf(heavy, ", mimic = both").diagnostics.find("`mimic` is couple, ignore or fixed"),
      std::string::npos);
}

TEST(Urdf, TellsInOneLineWhatItLeftOut) {
  const Loaded loaded = load_urdf(
      robot("<!-- meant --><material name=\"m\"/><gazebo/><gazebo/>" + link_l +
            "<link name=\"m\"><visual><geometry><sphere radius=\"1\"/></geometry></visual>"
            "<collision><geometry><!-- far --><mesh filename=\"package://r/x.stl\"/></geometry>"
            "</collision><collision><geometry><!-- near --><sphere radius=\"2\"/></geometry>"
            "</collision></link>\n" +
            joint("j", "continuous", "<limit effort=\"1\" velocity=\"2\"/><safety_controller/>") +
            joint("k", "fixed", "", "l", "m")));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.diagnostics,
            "note 1:2 left out: <gazebo> (2), <material> (1), <safety_controller> (1), <visual> "
            "(1), mesh of <collision> (1)\n");
  const auto& shapes = loaded.experiment->robots.at(0).chains.at(0).links.at(0).body.shapes;
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(std::get<simulation::Sphere>(shapes[0].geometry).radius, 2.);
}

TEST(Urdf, ARootThatOnlyFloatsIsTheWorldAndItsChildTheBase) {
  const Loaded loaded = load_urdf("<robot name=\"r\"><link name=\"world\"/>" + base + link_l +
                                  joint("free", "floating", "<axis xyz=\"0 0 0\"/>", "world", "b") +
                                  joint("j", "continuous", "") + "</robot>");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.diagnostics, "");
  const simulation::RobotSpec& read = loaded.experiment->robots.at(0);
  EXPECT_TRUE(read.mobile);
  EXPECT_GT(read.base.mass.mass, 0.);
  ASSERT_EQ(read.chains.size(), 1u);
  EXPECT_EQ(read.chains[0].links.at(0).body.name, "l");
}

TEST(Urdf, AJointThatCannotReach0StartsAtItsNearerLimit) {
  const std::string knee =
      robot(link_l + joint("knee", "revolute", "<limit lower=\"-2.5\" upper=\"-0.75\"/>"));
  const Loaded loaded = load_urdf(knee);
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.experiment->robots.at(0).chains.at(0).links.at(0).angle, -0.75);
  EXPECT_EQ(loaded.diagnostics,
            "note 5:37 joint `knee` starts at its limit, -0.75: 0 is beyond it (the argument "
            "`knee` says where else)\n");
  const Loaded bent = load_urdf(knee, ", knee = -1 rad");
  ASSERT_TRUE(bent.experiment) << bent.diagnostics;
  EXPECT_EQ(bent.experiment->robots.at(0).chains.at(0).links.at(0).angle, -1.);
  EXPECT_EQ(bent.diagnostics, "");
}

/// The closed form: 3 kg at (0.2, 0, 0) of link m, which stands at x = 1 turned by 90 deg about z.
TEST(Urdf, AJointWhoseLimitsAreEqualIsFixedThere) {
  const std::string mass =
      "<link name=\"m\"><inertial><origin xyz=\"0.2 0 0\"/><mass value=\"3\"/><inertia ixx=\"1\" "
      "iyy=\"2\" izz=\"2.5\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n";
  const Loaded loaded = load_urdf(
      "<robot name=\"r\"><link name=\"b\"/>" + mass +
      joint("j", "revolute",
            "<origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/><limit lower=\"1.5707963267948966\" "
            "upper=\"1.5707963267948966\"/>",
            "b", "m") +
      "</robot>");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_EQ(loaded.diagnostics, "note 1:2 left out: joint whose limits are equal: fixed (1)\n");
  const simulation::RobotSpec& read = loaded.experiment->robots.at(0);
  EXPECT_TRUE(read.chains.empty());
  EXPECT_EQ(read.base.mass.mass, 3.);
  EXPECT_NEAR(read.base.mass.center_of_mass.x, 1., 1e-15);
  EXPECT_NEAR(read.base.mass.center_of_mass.y, 0.2, 1e-15);
  EXPECT_NEAR(read.base.mass.inertia.xx, 2., 1e-15);
  EXPECT_NEAR(read.base.mass.inertia.yy, 1., 1e-15);
  EXPECT_NEAR(read.base.mass.inertia.zz, 2.5, 1e-15);
}

/// A fixed base, a turning l of mass m whose centre of mass stands 0.4 m beside the axis: the
/// closed forms k = m g 0.4/hold and c = 2 sqrt(k (I_zz + m 0.4^2)).
TEST(Urdf, HoldGivesEachJointASpringAndDamperByItsWeight) {
  const std::string arm =
      "<robot name=\"r\"><link name=\"world\"/><link name=\"l\"><inertial><origin xyz=\"0.4 0 0\"/>"
      "<mass value=\"2\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.08\" ixy=\"0\" ixz=\"0\" "
      "iyz=\"0\"/></inertial></link>\n" +
      joint("j", "continuous", "<axis xyz=\"0 0 1\"/><dynamics damping=\"0.5\"/>", "world", "l") +
      "</robot>";
  const Loaded loaded = load_urdf(arm, ", hold = 0.02 rad, j = 0.3 rad");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::LinkSpec& link = loaded.experiment->robots.at(0).chains.at(0).links.at(0);
  const double k = 2. * 9.80665 * 0.4 / 0.02;
  EXPECT_NEAR(link.stiffness, k, 1e-12 * k);
  EXPECT_NEAR(link.damping, 0.5 + 2. * std::sqrt(k * (0.08 + 2. * 0.16)), 1e-12 * k);
  EXPECT_EQ(link.rest_angle, 0.3);
  EXPECT_EQ(link.angle, 0.3);
  for (const char* wrong : {", hold = 0", ", hold = 1 m", ", hold = 2 rad", ", hold = strongly"})
    EXPECT_FALSE(load_urdf(arm, wrong).experiment) << wrong;
}

/// Of a real maker's twelve robots, which stand beside the repository where they are at hand: those
/// whose links branch at the base only.
TEST(Urdf, AMakersRobotsLoad) {
  const std::filesystem::path source = testing::source_folder();
  std::filesystem::path folder = source / "../shared/data/urdf";
  if (!std::filesystem::exists(folder))
    folder = source / "../../shared/data/urdf";  // checked out one folder deeper
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no ../shared/data/urdf";
  const std::map<std::string, double> masses{{"a1", 13.741},
                                             {"as2", 17.64},
                                             {"b2_description", 180.49829252380016},
                                             {"go2w_description", 19.523},
                                             {"laikago", 25.433},
                                             {"z1", 4.41872026}};
  for (const auto& [name, total] : masses) {
    const Loaded loaded = load_urdf(testing::read_file((folder / (name + ".urdf")).string()));
    ASSERT_TRUE(loaded.experiment) << name << loaded.diagnostics;
    const simulation::RobotSpec& read = loaded.experiment->robots.at(0);
    EXPECT_EQ(read.mobile, name != "z1") << name;
    double sum = read.base.mass.mass;
    for (const simulation::ChainSpec& chain : read.chains) {
      for (const simulation::LinkSpec& link : chain.links) sum += link.body.mass.mass;
    }
    EXPECT_NEAR(sum, total, 1e-9) << name;
  }
  // Their meshes are not there: whoever asks for one is told where it was looked for.
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".urdf") continue;
    const std::string text = testing::read_file(entry.path().string());
    for (const char* meshes : {"box", "hull"}) {
      const Loaded loaded = load_urdf(text, std::string(", shapes = visual, meshes = ") + meshes);
      EXPECT_FALSE(loaded.experiment) << entry.path();
      EXPECT_NE(loaded.diagnostics.find("there is no mesh `"), std::string::npos) << entry.path();
    }
  }
}

struct Case {
  const char* name;
  std::string text, diagnostics;
};
class WrongUrdf : public ::testing::TestWithParam<Case> {};

TEST_P(WrongUrdf, IsRefusedInTheseWordsAtThisLine) {
  const Loaded loaded = load_urdf(GetParam().text);
  EXPECT_FALSE(loaded.experiment);
  std::istringstream lines(loaded.diagnostics);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("included here") == std::string::npos) text += line + '\n';
  }
  EXPECT_EQ(text, GetParam().diagnostics);
}

const Case cases[] = {
    {"floating", robot(link_l + joint("j", "floating", "")),
     "error 4:17 a floating joint is not supported but as the only joint of a root without mass "
     "and shapes: only the base moves freely, links turn or slide about one axis\n"},
    {"planar", robot(link_l + joint("j", "planar", "")),
     "error 4:17 a planar joint is not supported: only the base moves freely (argument base = "
     "mobile), links turn or slide about one axis\n"},
    {"unknown_type", robot(link_l + joint("j", "ball", "")),
     "error 4:17 `ball` is no type of joint: expected revolute, continuous, prismatic or fixed\n"},
    {"mimic", robot(link_l + joint("j", "continuous", "\n<mimic joint=\"k\"/>")),
     "error 6:2 joint `j` follows `k`, and there is no such joint\n"},
    {"mimic_ring",
     robot(link_l + "<link name=\"m\">" + inertial + "</link>\n" +
           joint("j", "continuous", "\n<mimic joint=\"k\"/>") +
           joint("k", "continuous", "\n<mimic joint=\"j\"/>", "b", "m")),
     "error 7:2 joint `j` follows others in a ring\nerror 10:2 joint `k` follows others in a ring\n"},
    {"capsule",
     robot("<link name=\"l\">" + inertial +
           "<collision><geometry>\n<capsule radius=\"1\"/></geometry></collision></link>" +
           joint("j", "continuous", "")),
     "error 4:2 <capsule> lacks length=\"...\"\n"},
    {"cone",
     robot("<link name=\"l\">" + inertial +
           "<collision><geometry>\n<cone radius=\"1\"/></geometry></collision></link>" +
           joint("j", "continuous", "")),
     "error 4:2 <geometry> takes a box, a cylinder, a sphere, a capsule or a mesh\n"},
    {"two_roots", robot(link_l),
     "error 3:2 no joint carries link `l`, and none `b`: a robot has one root\n"},
    {"two_parents", robot(link_l + joint("j", "continuous", "") + joint("k", "fixed", "")),
     "error 6:2 link `l` is the child of a second joint: links form a tree\nnote 4:2 the first is "
     "here\n"},
    {"loop", robot(link_l + joint("j", "fixed", "", "l", "b") + joint("k", "fixed", "")),
     "error 1:2 the joints form a loop: no link is the root\n"},
    {"loop_apart",
     robot(link_l + "<link name=\"m\"/>\n" + joint("j", "fixed", "", "l", "m") +
           joint("k", "fixed", "", "m", "l")),
     "error 1:2 some joints form a loop that the root does not carry\n"},
    {"no_such_link", robot(link_l + joint("j", "fixed", "", "b", "ll")),
     "error 5:26 there is no link `ll`; did you mean `l`?\n"},
    {"wrong_limits", robot(link_l + joint("j", "revolute", "\n<limit upper=\"-1\"/>")),
     "error 6:2 lower = 0 is not below upper = -1 (each is 0 where it is not given)\n"},
    {"no_number",
     robot("<link name=\"l\"><inertial><mass value=\"one\"/><inertia ixx=\"1\" iyy=\"1\" "
           "izz=\"1e999\" ixy=\"0\" ixz=\"0\"/></inertial></link>\n" +
           joint("j", "continuous", "<origin xyz=\"1 2\"/>")),
     "error 3:32 `one` is no number\nerror 3:70 `1e999` is "
     "no number\nerror 5:44 xyz takes three numbers: \"x y z\"\n"},
    {"negative_damping", robot(link_l + joint("j", "continuous", "\n<dynamics damping=\"-1\"/>")),
     "error 6:11 `damping` must be at least 0, not -1\n"},
    {"zero_axis", robot(link_l + joint("j", "continuous", "<axis xyz=\"0 0 0\"/>")),
     "error 5:42 an axis of length 0 has no direction\n"},
    {"impossible_inertia",
     robot("<link name=\"l\"><inertial><mass value=\"1\"/>\n<inertia ixx=\"9\" iyy=\"1\" "
           "izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n" +
           joint("j", "continuous", "")),
     "error 3:17 the inertia of link `l` breaks the triangle inequality: no principal moment may "
     "exceed the sum of the other two: the argument inertia = repair takes the nearest that a body "
     "can have, 35 % of its greatest moment away\n"},
    {"two_links", robot(link_l + link_l + joint("j", "continuous", "")),
     "error 4:2 a second link `l`\nnote 3:2 the first is here\n"},
    {"same_names",
     robot(link_l + "<link name=\"m\">" + inertial + "</link>\n" + joint("j.1", "continuous", "") +
           joint("j-1", "continuous", "", "b", "m")),
     "error 7:2 the name `j_1` is taken\nnote 5:2 `j_1` is this Chain\n"},
    {"no_xml", "<robot name=\"r\">\n<link name=\"l\"></robot>",
     "error 2:18 this is not XML: Start-end tags mismatch\n"},
    {"no_urdf", "<skel/>",
     "error 1:1 this is a model of DART, which is not read here: expected a file of the language "
     "(.hook), a URDF (.urdf, .xacro), an MJCF (.xml) or an SDF (.sdf, .world); take the robot's "
     "URDF, MJCF or SDF, or convert it to one, and Include that\n"},
    {"empty", "", "error 1:1 this is not XML: No document element found\n"},
    {"xacro", robot("<xacro:property name=\"x\" value=\"1\"/>"),
     "error 3:2 the macros of xacro need its program, which is not installed: it comes with ROS "
     "and "
     "with `pip install xacro`; or expand the file elsewhere, `xacro FILE > robot.urdf`\n"},
};
INSTANTIATE_TEST_SUITE_P(Cases, WrongUrdf, ::testing::ValuesIn(cases),
                         [](const auto& of) { return of.param.name; });

TEST(Urdf, ALinkThatCarriesSeveralJointsStartsAChainForEach) {
  const std::string others = "<link name=\"m\">" + inertial + "</link><link name=\"n\">" +
                             inertial + "</link><link name=\"o\">" + inertial + "</link>\n";
  const Loaded loaded = load_urdf(
      robot("<link name=\"l\"/>" + others + joint("j", "continuous", "") +
            joint("k", "continuous", "", "l", "m") + joint("i", "continuous", "", "l", "n") +
            joint("tip", "continuous", "", "n", "o")));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::RobotSpec& read = loaded.experiment->robots.at(0);
  ASSERT_EQ(read.chains.size(), 3u);
  EXPECT_EQ(read.chains[0].name, "j");
  EXPECT_EQ(read.chains[1].name, "j.l.k");
  EXPECT_EQ(read.chains[2].name, "j.l.i");
  EXPECT_EQ(read.chains[0].carrier, 0u);
  EXPECT_EQ(read.chains[1].carrier, 1u);
  EXPECT_EQ(read.chains[2].carrier, 1u);
  EXPECT_EQ(read.chains[2].links.size(), 2u);
  EXPECT_EQ(read.chains[0].links[0].body.mass.mass, 0.);  // it carries what has one
}

TEST(Urdf, BranchingsAfterOneAnotherAreBounded) {
  const auto comb = [](int teeth) {
    std::string text;
    for (int i = 0; i < teeth; ++i) {
      const std::string number = std::to_string(i),
                        before = i == 0 ? "b" : "s" + std::to_string(i - 1);
      for (const char* kind : {"s", "t"}) {
        text += "<link name=\"" + (kind + number) + "\">" + inertial + "</link>\n";
        text += joint("to_" + (kind + number), "continuous", "", before, kind + number);
      }
    }
    return robot(text);
  };
  const Loaded most = load_urdf(comb(91));
  EXPECT_TRUE(most.experiment) << most.diagnostics;
  const Loaded more = load_urdf(comb(93));
  EXPECT_FALSE(more.experiment);
  EXPECT_NE(
      more.diagnostics.find("joint `to_s91` starts a chain on a chain, and so on, 91 deep: 90 "
                            "are the most"),
      std::string::npos)
      << more.diagnostics;
  EXPECT_FALSE(load_urdf(comb(20000)).experiment);
}

std::string quadruped() {
  return testing::read_file(testing::source_folder() + "/configs/robots/quadruped.urdf");
}

TEST(Urdf, HostileFilesAreRefusedOrRead) {
  const std::string whole = quadruped();
  ASSERT_GT(whole.size(), 5000u);
  for (std::size_t length = 0; length + 9 < whole.size(); length += 97)
    EXPECT_FALSE(load_urdf(whole.substr(0, length)).experiment) << length;
  std::mt19937 random(3);
  for (int i = 0; i < 150; ++i) {
    std::string text = whole;
    for (int k = 0; k < 4; ++k) text[random() % text.size()] = char(random());
    const Loaded loaded = load_urdf(text);
    EXPECT_NE(loaded.experiment.has_value(), loaded.diagnostics.find("error ") != std::string::npos)
        << i;
  }
  std::string deep = "<robot>", noise(20000, ' ');
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_FALSE(load_urdf(deep).experiment);
  for (char& c : noise) c = char(random());
  EXPECT_FALSE(load_urdf(noise).experiment);
}

TEST(Urdf, ManyLinksTakeNoLongerThanTheirNumber) {
  std::string many = base, loose = base;
  for (int i = 0; i < 20000; ++i) {
    const std::string name = "l" + std::to_string(i);
    many += "<link name=\"" + name + "\"/>";
    many += joint("j" + name, "fixed", "", i == 0 ? "b" : "l" + std::to_string(i - 1), name);
    loose += joint("j" + name, "fixed", "", "b", "m" + std::to_string(i));
  }
  EXPECT_TRUE(load_urdf("<robot>" + many + "</robot>").experiment);
  EXPECT_FALSE(load_urdf("<robot>" + loose + "</robot>").experiment);
}

TEST(Urdf, PrintsAsAFileThatMeansTheSame) {
  testing::expect_printed_runs_alike("scenes/standing_quadruped_urdf.hook",
                                     "world.walker.rear_left.rear_left_shank.location.z");
}

TEST(Urdf, AMistakeEndsTheCommandWithStatus2AndItsPlace) {
  const testing::Workplace place;
  place.file("robot.urdf", robot(link_l + joint("j", "planar", "")));
  place.file("scene.hook", "World w { Include \"robot.urdf\"; }");
  const testing::CommandResult checked = place.hookpoint("check scene.hook");
  EXPECT_EQ(checked.status, 2);
  EXPECT_NE(checked.err.find("robot.urdf:4:17: error: a planar joint"), std::string::npos)
      << checked.err;
}

TEST(Urdf, HoldMakesAQuadrupedStandWithJointsThatSagLessThanSaid) {
  const testing::Workplace place;
  place.file("scene.hook",
             "World w { deltat = auto; Include \"materials/rigid_floor.hook\" (load = 30 N, "
             "allowance = 2 mm); Terrain.Flat ground { material = rigid_floor; } Include "
             "\"robots/quadruped.urdf\" (name = r, rest_on = ground, hold = 0.05 rad, "
             "front_left_thigh_joint = 0.7, front_left_knee = -1.4, front_right_thigh_joint = 0.7, "
             "front_right_knee = -1.4, rear_left_thigh_joint = 0.7, rear_left_knee = -1.4, "
             "rear_right_thigh_joint = 0.7, rear_right_knee = -1.4); }");
  const testing::CommandResult ran = place.hookpoint(
      "run scene.hook --for 3s --out run --record w.r.front_left.front_left_shank.angle,"
      "w.r.rear_right.rear_right_shank.angle");
  ASSERT_EQ(ran.status, 0) << ran.err;
  std::istringstream trace(place.read("run/trace.csv"));
  std::string row, cell;
  for (std::string line; std::getline(trace, line);) row = line;
  std::istringstream last(row);
  std::getline(last, cell, ',');  // the time
  for (int leg = 0; leg < 2; ++leg) {
    std::getline(last, cell, ',');
    EXPECT_NEAR(std::stod(cell), -1.4, 0.05);
    EXPECT_GT(std::abs(std::stod(cell) + 1.4), 0.001);  // it does carry weight
  }
}

/// A uniform box of `mass` and edges x, y, z at `at` in its link's frame, that may touch.
std::string box_link(const std::string& name, double mass, double x, double y, double z,
                     const std::string& at) {
  std::ostringstream text;
  text << "<link name=\"" << name << "\"><inertial><origin xyz=\"" << at << "\"/><mass value=\""
       << mass << "\"/><inertia ixx=\"" << mass * (y * y + z * z) / 12. << "\" iyy=\""
       << mass * (x * x + z * z) / 12. << "\" izz=\"" << mass * (x * x + y * y) / 12.
       << "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial><collision><origin xyz=\"" << at
       << "\"/><geometry><box size=\"" << x << ' ' << y << ' ' << z
       << "\"/></geometry></collision></link>\n";
  return text.str();
}

std::string pitch_joint(const std::string& parent, const std::string& child,
                        const std::string& at) {
  return joint("to_" + child, "continuous", "<origin xyz=\"" + at + "\"/><axis xyz=\"0 1 0\"/>",
               parent, child);
}

/// A pelvis with two legs and a torso, on which hang two arms. 40 kg.
std::string humanoid() {
  std::string text = "<robot name=\"h\">" + box_link("pelvis", 6., 0.15, 0.3, 0.1, "0 0 0") +
                     box_link("torso", 15., 0.2, 0.3, 0.4, "0 0 0.25") +
                     pitch_joint("pelvis", "torso", "0 0 0.05");
  for (const auto& [side, y] : {std::pair{"left", "0.1"}, std::pair{"right", "-0.1"}}) {
    const std::string s = side;
    text += box_link(s + "_thigh", 4., 0.1, 0.1, 0.36, "0 0 -0.2") +
            box_link(s + "_shank", 3., 0.08, 0.08, 0.36, "0 0 -0.2") +
            box_link(s + "_foot", 1., 0.24, 0.1, 0.05, "0.03 0 -0.04") +
            box_link(s + "_arm", 1., 0.06, 0.06, 0.3, "0 0 -0.15") +
            box_link(s + "_hand", 0.5, 0.05, 0.05, 0.2, "0 0 -0.1") +
            pitch_joint("pelvis", s + "_thigh", std::string("0 ") + y + " -0.05") +
            pitch_joint(s + "_thigh", s + "_shank", "0 0 -0.4") +
            pitch_joint(s + "_shank", s + "_foot", "0 0 -0.4") +
            pitch_joint("torso", s + "_arm",
                        std::string("0 ") + (y[0] == '-' ? "-0.2" : "0.2") + " 0.4") +
            pitch_joint(s + "_arm", s + "_hand", "0 0 -0.3");
  }
  return text + "</robot>";
}

TEST(Urdf, HoldMakesAHumanoidStandWithArmsThatCarryThemselves) {
  const testing::Workplace place;
  place.file("humanoid.urdf", humanoid());
  place.file(
      "scene.hook",
      "World w { deltat = auto; Include \"materials/rigid_floor.hook\" (load = 50 N, "
      "allowance = 1 mm); Terrain.Flat ground { material = rigid_floor; } Include "
      "\"humanoid.urdf\" (name = r, rest_on = ground, hold = 0.03 rad, to_left_arm = 60 deg); }");
  const Loaded loaded = load_file(place.folder() / "scene.hook");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  Running run(loaded);
  const double height = run["r.position.z"];
  run.step(int(4. / loaded.experiment->deltat));
  EXPECT_NEAR(run["r.position.z"], height, 0.01);
  EXPECT_GT(std::abs(run["r.orientation.w"]), std::cos(0.03));  // leans by less than 0.06 rad
  EXPECT_NEAR(run["r.to_torso.torso.to_left_arm.left_arm.angle"], 60. * M_PI / 180., 0.03);

  const auto& chains = loaded.experiment->robots.at(0).chains;
  const auto stiffness = [&](const std::string& chain, std::size_t link) {
    return std::ranges::find(chains, chain, &simulation::ChainSpec::name)->links.at(link).stiffness;
  };
  // The hip's outer bodies reach 0.8 m down to the ankle and on to the foot's middle; the
  // shoulder's to the hand's.
  const double weight = 9.80665 * (6. + 15. + 2. * (4. + 3. + 1. + 1. + 0.5));
  EXPECT_NEAR(stiffness("to_left_thigh", 0), weight * std::hypot(0.03, 0.84) / 0.03, 1e-9 * weight);
  EXPECT_NEAR(stiffness("to_torso.torso.to_left_arm", 0), 9.80665 * 1.5 * 0.4 / 0.03, 1e-9);
  for (const simulation::ChainSpec& chain : chains)
    for (const simulation::LinkSpec& link : chain.links)
      EXPECT_EQ(link.limit_stiffness, std::min(1000., 10. * link.stiffness));
}

TEST(Urdf, InertiaStandsForAFormThatIsNotKnown) {
  const std::string text =
      "<robot name=\"h\">" + box_link("b", 3., 0.2, 0.3, 0.1, "0.01 0.02 0.03") + "</robot>";
  const Loaded loaded = load_urdf(text, ", shapes = inertia");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::BodySpec& read = loaded.experiment->robots.at(0).base;
  ASSERT_EQ(read.shapes.size(), 1u);
  const Vector3d edges = std::get<simulation::Box>(read.shapes[0].geometry).dimensions;
  EXPECT_LT(norm(edges - Vector3d{0.2, 0.3, 0.1}), 1e-6);
  EXPECT_LT(norm(read.shapes[0].location - Vector3d{0.01, 0.02, 0.03}), 1e-12);
}

TEST(Urdf, TheQuadrupedStandsOnItsFourFeet) {
  const testing::Workplace place;
  place.file("scene.hook", "Include \"scenes/standing_quadruped_urdf.hook\";");
  std::string record;
  for (const char* leg : {"front_left", "front_right", "rear_left", "rear_right"})
    record += std::string(",world.walker.") + leg + "." + leg + "_shank.contact.force.z";
  const testing::CommandResult ran =
      place.hookpoint("run scene.hook --for 3s --out run --record " + record.substr(1));
  ASSERT_EQ(ran.status, 0) << ran.err;
  std::istringstream trace(place.read("run/trace.csv"));
  std::string row;
  for (std::string line; std::getline(trace, line);) row = line;
  std::istringstream last(row);
  double sum = 0.;
  std::getline(last, row, ',');  // the time
  for (std::string cell; std::getline(last, cell, ',');) {
    EXPECT_GT(std::stod(cell), 10.);
    sum += std::stod(cell);
  }
  EXPECT_NEAR(sum, 9.81 * (6.5 + 0.5 + 4 * (0.4 + 0.8 + 0.25 + 0.05)), 0.01);
}

}  // namespace
}  // namespace hookpoint::tests
