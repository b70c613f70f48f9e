// Robots read from MJCF: poses of their bodies, masses and free accelerations against MuJoCo's own
// compiled model of the same text; what is refused, in which words and where.
// ctest: alone
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <random>
#include <regex>
#include <sstream>

#include "dts/configuration.h"
#include "dts/forward_dynamics.h"
#include "simulation/dts_engine/robot_description.h"
#include "simulation/experiment/robot_tree.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"
#include "tests/support/mjcf_robot.h"
#include "tests/support/mjcf_text.h"
#include "tests/support/text.h"
#ifdef HOOKPOINT_HAS_MUJOCO
#include <mujoco/mujoco.h>
#endif

namespace hookpoint::tests {
namespace {

const std::string ball = "<geom size=\"0.1\"/>";

std::filesystem::path makers_folder() {
  const std::filesystem::path source = testing::source_folder();
  for (const char* way : {"../shared/data/mjcf", "../../shared/data/mjcf"}) {
    if (std::filesystem::exists(source / way)) return source / way;
  }
  return {};
}

#ifdef HOOKPOINT_HAS_MUJOCO

/// MuJoCo's own reading of a text.
class Compiled {
 public:
  explicit Compiled(const std::string& text) {
    const testing::Workplace place;
    char problem[1000] = "";
    model = mj_loadXML(place.file("robot.xml", text).c_str(), nullptr, problem, sizeof problem);
    EXPECT_NE(model, nullptr) << problem << text;
    if (model == nullptr) return;
    data = mj_makeData(model);
    // What acts on bodies that nothing drives and nothing brakes.
    model->opt.disableflags |=
        mjDSBL_CONSTRAINT | mjDSBL_PASSIVE | mjDSBL_ACTUATION | mjDSBL_CONTACT;
  }
  ~Compiled() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Compiled(const Compiled&) = delete;
  Compiled& operator=(const Compiled&) = delete;

  int joint(const std::string& name) const { return mj_name2id(model, mjOBJ_JOINT, name.c_str()); }
  int body(const std::string& name) const { return mj_name2id(model, mjOBJ_BODY, name.c_str()); }

  mjModel* model = nullptr;
  mjData* data = nullptr;
};

/// One of ours and the same of MuJoCo's, in one state.
struct Worst {
  double position = 0., mass = 0., acceleration = 0.;
  int joints = 0;
};

/// The robot of `spec` in random states; of a file with one free base at most.
Worst compare(const simulation::RobotSpec& spec, const Compiled& truth, unsigned seed) {
  Worst worst;
  const mjModel& m = *truth.model;
  mjData& d = *truth.data;
  std::mt19937 random(seed);
  const auto uniform = [&] { return double(random()) / double(std::mt19937::max()) * 2. - 1.; };
  const dts::Model<double> model(simulation::describe_robot(spec));
  dts::Workspace<double> workspace(model);
  double mass = spec.base.mass.mass;
  std::vector<const simulation::LinkSpec*> links;
  simulation::for_each_link(spec, [&](const simulation::TreeLink& at) {
    links.push_back(&at.link);
    mass += at.link.body.mass.mass;
  });
  worst.joints = int(links.size());
  const auto* const free = std::find(m.jnt_type, m.jnt_type + m.njnt, int(mjJNT_FREE));
  const std::size_t base_rates = spec.mobile ? 6 : 0;
  const int base = spec.mobile ? m.jnt_bodyid[free - m.jnt_type] : 0;
  const int base_q = spec.mobile ? m.jnt_qposadr[free - m.jnt_type] : 0;
  const int base_v = spec.mobile ? m.jnt_dofadr[free - m.jnt_type] : 0;
  // A maker's default class may give a free joint an armature, which ours does not have.
  if (spec.mobile) std::fill_n(m.dof_armature + base_v, 6, 0.);
  if (spec.mobile) worst.mass = std::abs(mass - m.body_subtreemass[base]);
  // Joints by the order of MuJoCo; ours are called by the bodies that they carry.
  std::vector<int> joint_of_link;
  std::map<int, int> joints_left;  // of a body, that ours without mass have taken
  for (const simulation::LinkSpec* link : links) {
    const int body = truth.body(link->body.name);
    if (body >= 0) {
      joint_of_link.push_back(m.body_jntadr[body] + m.body_jntnum[body] - 1);
      continue;
    }
    // BODY_JOINT: one of the joints ahead of the body's last.
    int found = -1;
    for (int j = 0; j < m.njnt; ++j) {
      const std::string name = mj_id2name(&m, mjOBJ_JOINT, j);
      if (link->body.name.ends_with("_" + name)) found = j;
    }
    joint_of_link.push_back(found);
  }
  for (int round = 0; round < 4; ++round) {
    dts::State<double> state;
    state.base_position = {uniform(), uniform(), uniform()};
    Quaterniond turn{uniform(), uniform(), uniform(), uniform()};
    turn = normalized(turn);
    if (!spec.mobile) state.base_position = {}, turn = {};
    state.base_orientation = turn;
    const double pose[] = {state.base_position.x,
                           state.base_position.y,
                           state.base_position.z,
                           turn.w,
                           turn.x,
                           turn.y,
                           turn.z};
    if (spec.mobile) std::copy_n(pose, 7, d.qpos + base_q);
    std::fill_n(d.qvel, m.nv, 0.);
    state.joint_positions.clear();
    for (const int j : joint_of_link) {
      const double q = uniform();
      state.joint_positions.push_back(q);
      d.qpos[m.jnt_qposadr[j]] = q;
    }
    state.joint_rates.assign(links.size(), 0.);
    std::ranges::copy(std::array{1.5, -2., 9.}, truth.model->opt.gravity);
    mj_forward(&m, &d);
    const std::vector<double> none(links.size(), 0.);
    dts::forward_dynamics(model, state, {m.opt.gravity[0], m.opt.gravity[1], m.opt.gravity[2]},
                          none, workspace);
    std::vector<double> found(dts::velocity_count(model));
    dts::get_acceleration(model, workspace, std::span<double>(found));
    // Ours: angular (world axes), linear, joints. MuJoCo's: linear, angular (body axes), joints.
    double size = 1.;
    for (int i = 0; i < m.nv; ++i) size = std::max(size, std::abs(d.qacc[i]));
    const auto differ = [&](double a, double b) {
      worst.acceleration = std::max(worst.acceleration, std::abs(a - b) / size);
    };
    if (spec.mobile) {
      const double* a = d.qacc + base_v;
      const Vector3d angular = rotate(turn, Vector3d{a[3], a[4], a[5]});
      differ(found[0], angular.x);
      differ(found[1], angular.y);
      differ(found[2], angular.z);
      for (std::size_t i = 0; i < 3; ++i) differ(found[3 + i], a[i]);
    }
    for (std::size_t i = 0; i < links.size(); ++i)
      differ(found[base_rates + i], d.qacc[m.jnt_dofadr[joint_of_link[i]]]);
    // A body's centre of mass is that of what is welded to it: as ours has them together.
    for (std::size_t i = 0; i < links.size(); ++i) {
      const int body = truth.body(links[i]->body.name);
      if (body < 0) continue;
      double whole = 0.;
      Vector3d moment;
      for (int b = body; b < m.nbody; ++b) {
        if (m.body_weldid[b] != m.body_weldid[body]) continue;
        whole += m.body_mass[b];
        moment += m.body_mass[b] * Vector3d{d.xipos[3 * b], d.xipos[3 * b + 1], d.xipos[3 * b + 2]};
      }
      const simulation::MassSpec& ours = links[i]->body.mass;
      worst.mass = std::max(worst.mass, std::abs(whole - ours.mass));
      const dts::BodyMotion<double>& here = workspace.bodies[i + 1];
      const Vector3d center = here.p_WB + here.R_WB * ours.center_of_mass;
      worst.position = std::max(worst.position, norm(center - (1. / whole) * moment));
    }
  }
  return worst;
}

TEST(Mjcf, AgreesWithTheCompiledModelOfDrawnRobots) {
  RandomMjcf random(11);
  for (int i = 0; i < 60; ++i) {
    const std::string text = random.robot(2 + i % 8);
    const Loaded loaded = load_mjcf(text);
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics << text;
    ASSERT_EQ(loaded.experiment->robots.size(), 1u);
    const Compiled truth(text);
    ASSERT_NE(truth.model, nullptr);
    const Worst worst = compare(loaded.experiment->robots[0], truth, unsigned(i));
    EXPECT_LE(worst.position, 1e-12) << text;
    EXPECT_LE(worst.mass, 1e-12) << text;
    EXPECT_LE(worst.acceleration, 1e-9) << text;
  }
}

/// A maker's file as MuJoCo 2.2.2 takes it: without meshes, which are not there, and without what
/// came later and moves nothing; what it includes stands in it.
void simplify(pugi::xml_node node, const std::filesystem::path& folder) {
  for (pugi::xml_node child = node.first_child(); child;) {
    const pugi::xml_node next = child.next_sibling();
    const std::string tag = child.name();
    if (tag == "include") {
      pugi::xml_document other;
      other.load_file((folder / child.attribute("file").value()).c_str());
      for (const pugi::xml_node& inside : other.document_element().children())
        node.insert_copy_before(inside, child);
      node.remove_child(child);
      return simplify(node, folder);
    }
    const bool aside = tag == "sensor" || tag == "actuator" || tag == "keyframe" ||
                       tag == "option" || tag == "visual" || tag == "asset" || tag == "camera" ||
                       tag == "position" || tag == "motor" || tag == "mesh" || tag == "material" ||
                       tag == "statistic" || tag == "light" || tag == "site";
    const bool mesh = tag == "geom" && (child.attribute("mesh") ||
                                        std::string(child.attribute("class").value()) == "visual" ||
                                        std::string(child.attribute("type").value()) == "mesh");
    child.remove_attribute("material");
    child.remove_attribute("actuatorfrcrange");
    child.remove_attribute("actuatorfrclimited");
    if (aside || (mesh && std::string(node.name()) != "default")) {
      node.remove_child(child);
    } else {
      if (mesh) child.remove_attribute("type");
      simplify(child, folder);
    }
    child = next;
  }
}

TEST(Mjcf, AgreesWithTheCompiledModelOfMakersRobots) {
  const std::filesystem::path folder = makers_folder();
  if (folder.empty()) GTEST_SKIP() << "no ../shared/data/mjcf";
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".xml" || name == "sensor_feet") continue;
    const testing::Workplace place;
    const Loaded loaded = load_file(place.file(
        "scene.hook", "World w { Include \"" + entry.path().string() + "\" (name = r); }"));
    ASSERT_TRUE(loaded.experiment) << name << loaded.diagnostics;
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file(entry.path().c_str()));
    simplify(document.document_element(), folder);
    document.document_element().prepend_child("compiler").append_attribute("autolimits") = "true";
    std::ostringstream text;
    document.save(text);
    const Compiled truth(text.str());
    ASSERT_NE(truth.model, nullptr) << name;
    int joints = 0;
    for (const simulation::RobotSpec& robot : loaded.experiment->robots) {
      const Worst worst = compare(robot, truth, 3);
      joints += worst.joints + (robot.mobile ? 1 : 0);
      std::cout << name << ' ' << robot.name << ": " << worst.joints << " joints, position "
                << worst.position << " m, mass " << worst.mass << " kg, acceleration "
                << worst.acceleration << '\n';
      EXPECT_LE(worst.position, 1e-9) << name;
      EXPECT_LE(worst.mass, 1e-9) << name;
      EXPECT_LE(worst.acceleration, 1e-9) << name;
    }
    EXPECT_EQ(joints, truth.model->njnt) << name;
    ++count;
  }
  EXPECT_GE(count, 14u);
}

#endif

TEST(Mjcf, AServoHasAGoalAndAMotorALimit) {
  const std::string body = "<body name=\"b\" pos=\"0 0 1\"><freejoint/>" + ball +
                           "<body name=\"l\"><joint name=\"q\" "
                           "armature=\"0.02\" frictionloss=\"0.3\" damping=\"0.4\"/>" +
                           ball + "</body></body>\n";
  const Loaded motor = load_mjcf(
      world(body, "<actuator><motor joint=\"q\" gear=\"3\" ctrlrange=\"-2 1\"/></actuator>"));
  ASSERT_TRUE(motor.experiment) << motor.diagnostics;
  const simulation::LinkSpec& link = motor.experiment->robots.at(0).chains.at(0).links.at(0);
  EXPECT_EQ(link.effort_limit, 6.);
  EXPECT_EQ(link.rotor_inertia, 0.02);
  EXPECT_EQ(link.friction, 0.3);
  EXPECT_EQ(link.damping, 0.4);
  const std::string key =
      "<keyframe><key name=\"home\" qpos=\"0 0 2 1 0 0 0 0.5\" ctrl=\"0.9\"/></keyframe>";
  const Loaded servo =
      load_mjcf(world(body,
                      "<actuator><position joint=\"q\" gear=\"3\" kp=\"10\" kv=\"2\" "
                      "forcerange=\"-5 5\"/></actuator>" +
                          key),
                ", keyframe = home");
  ASSERT_TRUE(servo.experiment) << servo.diagnostics;
  const simulation::RobotSpec& read = servo.experiment->robots.at(0);
  EXPECT_EQ(read.location, (Vector3d{0., 0., 2.}));
  EXPECT_EQ(read.chains.at(0).links.at(0).angle, 0.5);
  EXPECT_EQ(read.chains.at(0).links.at(0).effort_limit, 15.);
  // torque = gear (kp (ctrl - gear q) - kv gear dq/dt)
  const testing::Workplace place;
  place.file("robot.xml", world(body,
                                "<actuator><position joint=\"q\" gear=\"3\" kp=\"10\" "
                                "kv=\"2\"/></actuator>" +
                                    key));
  place.file("scene.hook", "World w { Include \"robot.xml\" (name = r, keyframe = home); }");
  const std::string printed = place.hookpoint("print scene.hook").out;
  EXPECT_NE(printed.find("pconstant = 90"), std::string::npos) << printed;
  EXPECT_NE(printed.find("dconstant = 18"), std::string::npos) << printed;
  EXPECT_NE(printed.find("goal = 0.3 rad"), std::string::npos) << printed;
}

TEST(Mjcf, GeomsThatTouchNothingAreShapesWithoutContact) {
  const Loaded loaded = load_mjcf(world(
      "<body><freejoint/><geom type=\"capsule\" size=\"0.1 0.2\"/><geom size=\"0.3\" contype=\"0\" "
      "conaffinity=\"0\" friction=\"0.2\"/><geom size=\"0.4\" contype=\"0\" friction=\"0.2\"/>"
      "</body>"));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::BodySpec& base = loaded.experiment->robots.at(0).base;
  ASSERT_EQ(base.shapes.size(), 2u);
  ASSERT_EQ(base.shapes_without_contact.size(), 1u);
  EXPECT_EQ(std::get<simulation::Sphere>(base.shapes_without_contact[0].geometry).radius, 0.3);
  const auto& capsule = std::get<simulation::Capsule>(base.shapes[0].geometry);
  EXPECT_EQ(capsule.radius, 0.1);
  EXPECT_EQ(capsule.length, 0.4);
  EXPECT_EQ(base.shapes[0].material, simulation::no_material);
  ASSERT_NE(base.shapes[1].material, simulation::no_material);
}

/// A ball of 2 kg on the ground, whose geom has `contact` of its own.
Loaded load_resting_ball(const std::string& contact, const std::string& before = "",
                         const std::string& arguments = ", contact = file") {
  const testing::Workplace place;
  place.file("robot.xml",
             mujoco(before + "<worldbody><body><freejoint/><geom size=\"0.1\" mass=\"2\" " +
                    contact + "/></body></worldbody>"));
  return load_file(
      place.file("scene.hook",
                 "World w { deltat = 1 ms; Terrain.Flat ground { } Include \"robot.xml\" (name "
                 "= r, rest_on = ground" +
                     arguments + "); }"));
}

TEST(Mjcf, ContactOfTheFileIsKeptInItsWordsAndAsASpring) {
  const Loaded loaded = load_resting_ball(
      "friction=\"0.7 0.01 0.002\" condim=\"6\" solref=\"0.02 0.8\" solimp=\"0.9 0.9\"",
      "<option cone=\"elliptic\" impratio=\"10\"/>");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::MaterialSpec& material = loaded.experiment->materials.at(0);
  ASSERT_TRUE(material.mujoco);
  EXPECT_EQ(material.mujoco->row.reference, (std::array{0.02, 0.8}));
  EXPECT_EQ(material.mujoco->row.impedance, (std::array{0.9, 0.9, 0.001, 0.5, 2.}));
  EXPECT_EQ(material.mujoco->friction, (contact::MujocoFriction{true, 10.}));
  // K = 1/(d t z)^2 and k = K d^2 m/(1 - d); z is the damping ratio of the mass m.
  const double stiffness = 2. / (0.016 * 0.016 * 0.1);
  EXPECT_NEAR(material.constants.normal_stiffness / stiffness, 1., 1e-9);
  EXPECT_NEAR(material.constants.normal_damping / (2. * 0.8 * std::sqrt(2. * stiffness)), 1., 1e-9);
  EXPECT_EQ(material.constants.tangential_stiffness, material.constants.normal_stiffness);
  EXPECT_EQ(material.constants.kinetic_friction, 0.7);
  EXPECT_EQ(material.constants.spinning_resistance, 0.01);
  EXPECT_EQ(material.constants.rolling_resistance, 0.002);
  // Creep on 10 deg: R f/B = (1 - d)/(d m impratio) m g sin(10 deg) d t/2.
  const double creep = 0.1 / 0.9 / 10. * 9.81 * std::sin(M_PI / 18.) * 0.9 * 0.02 / 2.;
  for (const std::string& words :
       {std::string("78125 N/m"), std::string("2 kg"), fmt::format("{:.4g} mm/s", 1e3 * creep)})
    EXPECT_NE(loaded.diagnostics.find(words), std::string::npos) << words << loaded.diagnostics;
  for (const char* read : {"solref of <geom>", "solimp of <geom>", "condim of <geom>", "<option>"})
    EXPECT_EQ(loaded.diagnostics.find(read), std::string::npos) << loaded.diagnostics;
  const Loaded more = load_resting_ball("", "<option cone=\"elliptic\" timestep=\"0.01\"/>");
  EXPECT_NE(more.diagnostics.find("timestep of <option>"), std::string::npos) << more.diagnostics;
  EXPECT_EQ(more.diagnostics.find("cone of <option>"), std::string::npos) << more.diagnostics;
  // It starts as deep as that spring carries it.
  EXPECT_NEAR(loaded.experiment->robots[0].location.z, 0.1 - 2. * 9.81 / stiffness, 1e-9);
}

TEST(Mjcf, WithoutNumbersOfItsOwnTheContactHasMujocosDefaults) {
  const Loaded loaded = load_resting_ball("");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::MaterialSpec& material = loaded.experiment->materials.at(0);
  ASSERT_TRUE(material.mujoco);
  EXPECT_EQ(material.mujoco->row, contact::MujocoRow{});
  EXPECT_EQ(material.mujoco->friction, contact::MujocoFriction{});
}

#ifdef HOOKPOINT_HAS_MUJOCO
// The ground is a geom of condim 3. Of two geoms the larger condim counts, or that of the one with priority.
TEST(Mjcf, AGeomOfOneRowHasTheFrictionOfThreeOnTheGround) {
  for (const auto& [priority, dimension] : {std::pair{0, 3}, {1, 1}}) {
    const std::string geom = fmt::format("friction=\"0.4\" condim=\"1\" priority=\"{}\"", priority);
    const Loaded loaded = load_resting_ball(geom);
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    const Compiled truth(
        world("<geom type=\"plane\" size=\"1 1 1\" friction=\"0.1\"/><body pos=\"0 0 "
              "0.09\"><freejoint/><geom size=\"0.1\" " +
              geom + "/></body>"));
    truth.model->opt.disableflags = 0;
    mj_forward(truth.model, truth.data);
    ASSERT_EQ(truth.data->ncon, 1);
    const mjContact& contact = truth.data->contact[0];
    EXPECT_EQ(contact.dim, dimension);
    EXPECT_EQ(loaded.experiment->materials.at(0).constants.kinetic_friction,
              contact.dim == 1 ? 0. : contact.friction[0]);
  }
}

TEST(Mjcf, MasksOfContactSayWhatTouchesTheGround) {
  for (const auto& [type, affinity] : {std::pair{0, 0}, {0, 1}, {1, 0}, {2, 2}, {2, 4}, {3, 0}}) {
    const std::string body = fmt::format(
        "<body pos=\"0 0 0.09\"><freejoint/><geom size=\"0.1\" contype=\"{}\" "
        "conaffinity=\"{}\"/></body>",
        type, affinity);
    const Compiled truth(world("<geom type=\"plane\" size=\"1 1 1\"/>" + body));
    truth.model->opt.disableflags = 0;
    mj_forward(truth.model, truth.data);
    const Loaded loaded = load_mjcf(world(body));
    ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
    EXPECT_EQ(loaded.experiment->robots[0].base.shapes.size(), std::size_t(truth.data->ncon))
        << body;
    const bool noted = loaded.diagnostics.find("lack bit 1") != std::string::npos;
    EXPECT_EQ(noted, truth.data->ncon == 0 && type != 0) << loaded.diagnostics;
  }
}
#endif

TEST(Mjcf, AGeomThatTouchesThroughAPairAloneIsNamed) {
  const Loaded loaded =
      load_mjcf(world("<geom name=\"floor\" type=\"plane\" size=\"1 1 1\"/><body><freejoint/><geom "
                      "name=\"foot\" size=\"0.1\" contype=\"0\" conaffinity=\"0\"/></body>",
                      "<contact><pair geom1=\"foot\" geom2=\"floor\"/></contact>"));
  EXPECT_NE(loaded.diagnostics.find("contact of geom `foot` by a <pair>"), std::string::npos)
      << loaded.diagnostics;
}

TEST(Mjcf, OtherwiseFrictionAloneOrNothingCounts) {
  const std::string stated = "friction=\"0.7\" solref=\"0.01 1\"";
  const Loaded friction = load_resting_ball(stated, "", "");
  ASSERT_TRUE(friction.experiment);
  EXPECT_FALSE(friction.experiment->materials.at(0).mujoco);
  const Loaded ground = load_resting_ball(stated, "", ", contact = ground");
  ASSERT_TRUE(ground.experiment);
  EXPECT_EQ(ground.experiment->robots[0].base.shapes.at(0).material, simulation::no_material);
}

TEST(Mjcf, ContactThatCannotBeIsAnError) {
  const auto has = [](const Loaded& loaded, const std::string& words) {
    EXPECT_FALSE(loaded.experiment);
    EXPECT_NE(loaded.diagnostics.find(words), std::string::npos) << loaded.diagnostics;
  };
  has(load_resting_ball("condim=\"2\""), "condim is 1, 3, 4 or 6");
  has(load_resting_ball("solref=\"0.02 -1\""), "solref is a time constant and a damping ratio");
  has(load_resting_ball("solref=\"0 0\""), "solref is a time constant and a damping ratio");
  has(load_text(
          "World w { deltat = auto; Material m { solref = 1e-300, 1; } Terrain.Flat g { material = m; } "
          "Robot r { Base.mobile { rest_on = g; Shape.Sphere { radius = 0.1; mass = 2 kg; } } } }"),
      "no stiffness within the range of numbers");
  EXPECT_TRUE(load_resting_ball("", "<option impratio=\"0\"/>", "").experiment);
  has(load_resting_ball("", "<option impratio=\"0\"/>"), "impratio is above 0");
  has(load_resting_ball("", "<option cone=\"round\"/>"), "cone is elliptic or pyramidal");
}

// What a Material states itself holds; nothing to stand on leaves the defaults, and a warning says so.
TEST(Mjcf, StatedConstantsHoldAndALoadIsNeeded) {
  const std::string words = "solref = 0.02, 1; ";
  const auto with = [&](const std::string& more) {
    return load_text(
        "World w { deltat = 1 ms; Material m { " + words + more +
        "} Terrain.Flat ground { material = m; } Robot r { Base.mobile { rest_on = ground; "
        "Shape.Sphere { radius = 0.1; mass = 2 kg; } } } }");
  };
  const Loaded stated = with("normal_stiffness = 5 kN/m; ");
  ASSERT_TRUE(stated.experiment) << stated.diagnostics;
  EXPECT_EQ(stated.experiment->materials[0].constants.normal_stiffness, 5000.);
  EXPECT_NE(stated.experiment->materials[0].constants.tangential_stiffness, 5000.);
  const Loaded lonely = load_text("World w { deltat = 1 ms; Material m { " + words +
                                  "} Terrain.Flat ground { material = m; } }");
  EXPECT_NE(lonely.diagnostics.find("no robot stands on or with Material m"), std::string::npos)
      << lonely.diagnostics;
}

/// The acceleration of the only joint of `text`, at 0 under gravity [rad/s^2].
double acceleration_of(const std::string& text) {
  const Loaded loaded = load_mjcf(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  if (!loaded.experiment) return 0.;
  const dts::Model<double> model(simulation::describe_robot(loaded.experiment->robots.at(0)));
  dts::Workspace<double> workspace(model);
  const dts::State<double> state = dts::zero_state(model);
  dts::forward_dynamics(model, state, {0., 0., -9.81}, std::vector<double>{0.}, workspace);
  std::vector<double> found(dts::velocity_count(model));
  dts::get_acceleration(model, workspace, std::span<double>(found));
  return found.back();
}

TEST(Mjcf, AnInertialInAFrameIsMovedByIt) {
  // The centre is (0.1 + 0.2 cos 30, 0, -0.2 sin 30) deg; the joint is 0.3 above: m g x / (I + m r^2).
  const double x = 0.1 + 0.2 * std::sqrt(0.75), z = -0.1 - 0.3;
  const double expected = 2. * 9.81 * x / (0.02 + 2. * (x * x + z * z));
  EXPECT_NEAR(expected, 10.95540676, 1e-8);  // MuJoCo 3.14
  EXPECT_NEAR(
      acceleration_of(world("<body><joint axis=\"0 1 0\" pos=\"0 0 0.3\"/><frame pos=\"0.1 0 0\" "
                            "euler=\"0 30 0\"><inertial pos=\"0.2 0 0\" mass=\"2\" "
                            "diaginertia=\"0.01 0.02 0.025\"/></frame></body>")),
      expected, 1e-12);
}

TEST(Mjcf, AnInertialStaysWhereNoGeomHasAMass) {
  // m g x / (I + m x^2) of the <inertial>
  const std::string inertial = "<inertial pos=\"0.1 0 0\" mass=\"2\" diaginertia=\"0.1 0.1 0.1\"/>";
  for (const char* geom :
       {"", "<geom size=\"0.1\" group=\"3\"/>", "<geom size=\"0.1\" mass=\"0\"/>"})
    EXPECT_NEAR(
        acceleration_of(
            mujoco("<compiler inertiafromgeom=\"true\" inertiagrouprange=\"0 1\"/><worldbody><body>"
                   "<joint axis=\"0 1 0\"/>" +
                   inertial + geom + "</body></worldbody>")),
        16.35, 1e-12)
        << geom;
}

TEST(Mjcf, WhatStandsOnTheWorldNeedsNoMass) {
  const std::string text = world(
      "<body><geom type=\"mesh\" mesh=\"m\"/><body><joint axis=\"0 1 0\"/><geom size=\"0.1\" "
      "mass=\"1\" pos=\"0.2 0 0\"/></body></body>",
      "<asset><mesh name=\"m\" file=\"m.stl\"/></asset>");
  // m g x / (2/5 m r^2 + m x^2)
  EXPECT_NEAR(acceleration_of(text), 9.81 * 0.2 / (0.004 + 0.04), 1e-12);
  const Loaded scaled = load_mjcf("<mujoco><compiler settotalmass=\"3\"/>" + text.substr(8));
  EXPECT_NE(scaled.diagnostics.find("that of a mesh is not computed"), std::string::npos)
      << scaled.diagnostics;
}

/// The mass of the first robot [kg].
double mass_of(const std::string& text) {
  const Loaded loaded = load_mjcf(text);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  if (!loaded.experiment) return 0.;
  double mass = loaded.experiment->robots.at(0).base.mass.mass;
  simulation::for_each_link(loaded.experiment->robots[0], [&](const simulation::TreeLink& at) {
    mass += at.link.body.mass.mass;
  });
  return mass;
}

TEST(Mjcf, ALaterDefaultHoldsButNotInClassesBeforeIt) {
  const std::string body = "<worldbody><body><freejoint/><geom size=\"0.1\"/></body></worldbody>";
  const double ball_volume = 4. / 3. * M_PI * 1e-3;
  EXPECT_NEAR(
      mass_of(mujoco("<default><geom density=\"500\"/></default><default class=\"main\"><geom "
                     "density=\"2000\"/></default>" +
                     body)),
      2000. * ball_volume, 1e-12);
  const std::string of_class =
      "<worldbody><body childclass=\"k\"><freejoint/><geom/></body></worldbody>";
  const std::string k = "<default class=\"k\"><geom size=\"0.1\"/></default>";
  const std::string dense = "<geom density=\"3000\"/>";
  EXPECT_NEAR(
      mass_of(mujoco("<default>" + k + "</default><default>" + dense + "</default>" + of_class)),
      1000. * ball_volume, 1e-12);
  EXPECT_NEAR(mass_of(mujoco("<default>" + k + dense + "</default>" + of_class)),
              3000. * ball_volume, 1e-12);
}

// Accelerations [rad/s^2] in MuJoCo 3.14. MuJoCo 2.2.2 has euler before xyaxes, whoever states it.
TEST(Mjcf, AnOrientationOfItsOwnGoesBeforeThatOfAClass) {
  const std::string defaults =
      "<default><default class=\"k\"><geom type=\"box\" size=\"0.3 0.1 0.05\" zaxis=\"1 0 0\" "
      "mass=\"3\"/><default class=\"l\"><geom euler=\"0 0 30\"/></default><default "
      "class=\"m\"><geom quat=\"1 0 0 1\"/></default></default></default>";
  const std::pair<const char*, double> rows[] = {
      {"class=\"k\" euler=\"0 0 30\"", -17.89057751},
      {"class=\"k\" quat=\"1 0 1 0\"", -17.46587537},
      {"class=\"l\"", -17.89057751},
      {"class=\"m\"", -17.46587537},
      {"class=\"l\" xyaxes=\"0 1 0 0 0 1\"", -19.29836066},
      {"class=\"m\" axisangle=\"1 1 0 20\"", -17.45829263},
      {"class=\"l\" zaxis=\"1 1 0\"", -17.80937973},
  };
  for (const auto& [geom, expected] : rows)
    EXPECT_NEAR(acceleration_of(mujoco(
                    defaults + "<worldbody><body><joint axis=\"0 1 0\" pos=\"0.5 0 0\"/><geom " +
                    geom + "/></body></worldbody>")),
                expected, 1e-8)
        << geom;
}

TEST(Mjcf, ARangeWithoutEndsIsNone) {
  const auto link = [&](const std::string& range) {
    const Loaded loaded = load_mjcf(
        world("<body><joint type=\"slide\" range=\"" + range + "\"/>" + ball + "</body>"));
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    return loaded.experiment ? loaded.experiment->robots.at(0).chains.at(0).links.at(0)
                             : simulation::LinkSpec{};
  };
  for (const char* open : {"-inf inf", "-1e16 +1e16", "-INF inf"}) {
    EXPECT_FALSE(link(open).lower_limit) << open;
    EXPECT_FALSE(link(open).upper_limit) << open;
  }
  EXPECT_EQ(link("-1 inf").lower_limit, -1.);
  EXPECT_FALSE(link("-1 inf").upper_limit);
}

TEST(Mjcf, WhatIsUnreadIsNotedOfClassesToo) {
  const Loaded loaded = load_mjcf(mujoco(
      "<default><geom margin=\"0.01\" gap=\"0.005\" priority=\"1\" solmix=\"3\" condim=\"1\" "
      "shellinertia=\"true\"/><joint margin=\"0.1\"/><general dyntype=\"filter\" "
      "dynprm=\"0.1\"/><mesh inertia=\"shell\"/></default><asset><mesh "
      "file=\"m.stl\"/></asset><worldbody><body><joint name=\"q\"/>" +
      ball + "</body></worldbody><actuator><general joint=\"q\"/></actuator>"));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  for (const char* unread :
       {"margin of <geom> (1)", "gap of <geom>", "priority of <geom>", "solmix of <geom>",
        "condim of <geom>", "shellinertia of <geom>", "margin of <joint>", "dyntype of <general>",
        "dynprm of <general>", "inertia of <mesh>"})
    EXPECT_NE(loaded.diagnostics.find(unread), std::string::npos) << unread << loaded.diagnostics;
}

TEST(Mjcf, AFreeJointMayBeOneByItsClass) {
  const Loaded loaded = load_mjcf(
      mujoco("<default><joint type=\"free\"/></default><worldbody><body><joint name=\"q\"/>" +
             ball + "</body></worldbody>"));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_TRUE(loaded.experiment->robots.at(0).mobile);
}

// A point of 1 kg, 0.1 m below a ball of 1 kg: m x^2 about the centre of both is 2 (0.05)^2.
TEST(Mjcf, AnInertialWithoutMomentsIsAPoint) {
  const Loaded loaded =
      load_mjcf(world("<body><freejoint/><geom size=\"0.1\" mass=\"1\"/><body><inertial pos=\"0 0 "
                      "-0.1\" mass=\"1\"/></body></body>"));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::MassSpec& mass = loaded.experiment->robots.at(0).base.mass;
  EXPECT_EQ(mass.mass, 2.);
  EXPECT_NEAR(mass.inertia.xx, 0.004 + 0.005, 1e-15);
  EXPECT_NEAR(mass.inertia.zz, 0.004, 1e-15);
}

TEST(Mjcf, MeshesMayStandInTheFileOrInAnotherFolder) {
  const testing::Workplace place;
  place.file("t.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\n");
  const auto box = [&](const std::string& mesh) {
    place.file(
        "robot.xml",
        mujoco(
            "<compiler strippath=\"true\"/><default><mesh scale=\"2 2 2\"/></default><asset><mesh "
            "name=\"m\" " +
            mesh +
            "/></asset><worldbody><body><freejoint/><inertial pos=\"0 0 0\" mass=\"1\" "
            "diaginertia=\"1 1 1\"/><geom type=\"mesh\" mesh=\"m\"/></body></worldbody>"));
    const Loaded loaded = load_file(
        place.file("scene.hook", "World w { Include \"robot.xml\" (name = r, meshes = box); }"));
    EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
    if (!loaded.experiment) return Vector3d{};
    return std::get<simulation::Box>(loaded.experiment->robots.at(0).base.shapes.at(0).geometry)
        .dimensions;
  };
  EXPECT_EQ(box("file=\"some/where/t.obj\""), (Vector3d{2., 4., 6.}));
  EXPECT_EQ(box("vertex=\"0 0 0 1 0 0 0 2 0 0 0 3\""), (Vector3d{2., 4., 6.}));
}

TEST(Mjcf, AMocapBodyStandsStillWithWhatItCarries) {
  const Loaded loaded = load_mjcf(
      world(
          "<body><freejoint/>" + ball +
              "</body><body mocap=\"true\" pos=\"1 0 1\"><geom size=\"0.1\"/><body name=\"kid\"><joint "
              "axis=\"0 1 0\"/><geom size=\"0.1\" pos=\"0 0 -0.2\"/></body></body>",
          "<keyframe><key name=\"k\" qpos=\"0 0 1 1 0 0 0 0.5\"/></keyframe>"),
      ", keyframe = k");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  ASSERT_EQ(loaded.experiment->robots.size(), 2u);
  EXPECT_EQ(loaded.experiment->robots[1].chains.at(0).links.at(0).angle, 0.5);
  EXPECT_NE(loaded.diagnostics.find("mocap of <body>"), std::string::npos) << loaded.diagnostics;
}

TEST(Mjcf, IncludesStandInTheirPlace) {
  const testing::Workplace place;
  place.file("legs.xml",
             "<mujocoinclude><body name=\"b\"><freejoint/>" + ball + "</body></mujocoinclude>");
  place.file("classes.xml", mujoco("<default><geom density=\"5\"/></default>"));
  place.file("robot.xml", mujoco("<include file=\"classes.xml\"/><worldbody><include "
                                 "file=\"legs.xml\"/></worldbody>"));
  const Loaded loaded =
      load_file(place.file("scene.hook", "World w { Include \"robot.xml\" (name = r); }"));
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  EXPECT_NEAR(loaded.experiment->robots.at(0).base.mass.mass, 5. * 4. / 3. * M_PI * 1e-3, 1e-15);
}

struct Wrong {
  const char* name;
  std::string text, message;
};
class WrongMjcf : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongMjcf, IsAnErrorAtItsPlace) {
  const Loaded loaded = load_mjcf(GetParam().text);
  EXPECT_FALSE(loaded.experiment);
  EXPECT_NE(loaded.diagnostics.find(GetParam().message), std::string::npos) << loaded.diagnostics;
}

std::string deep_bodies() {
  std::string text = "<body><freejoint/>" + ball;
  std::string end = "</body>";
  for (int i = 0; i < 3000; ++i) {
    text += "<body>" + ball;
    end += "</body>";
  }
  return world(text + end);
}

std::string deep_classes() {
  std::string text;
  for (int i = 0; i < 60000; ++i) text += fmt::format("<default class=\"c{}\">", i);
  for (int i = 0; i < 60000; ++i) text += "</default>";
  return mujoco("<default>" + text + "</default>");
}

const std::string two_robots = "<body name=\"t\"><freejoint/>" + ball +
                               "<body><joint name=\"j1\"/>" + ball +
                               "</body></body><body name=\"u\"><freejoint/>" + ball +
                               "<body><joint name=\"j2\"/>" + ball + "</body></body>";

const Wrong wrongs[] = {
    {"ball", world("<body>\n<joint type=\"ball\"/>" + ball + "</body>"),
     "error 4:8 a ball joint is not read: write three hinges"},
    {"unknown_attribute", world("<body><freejoint/>\n<geom sizes=\"1\" size=\"1\"/></body>"),
     "error 4:7 <geom> has no attribute `sizes`; did you mean `size`?"},
    {"unknown_section", mujoco("<worldbodies/>"), "error 2:2 <mujoco> has no <worldbodies>"},
    {"unknown_element",
     world("<body><freejoint/>" + ball +
           "\n<composite count=\"1000000000\"/>"
           "</body>"),
     "error 4:2 <composite> of a body is not read"},
    {"unknown_class", world("<body><freejoint/>\n<geom class=\"none\" size=\"1\"/></body>"),
     "error 4:7 there is no default class `none`"},
    {"no_size", world("<body><freejoint/>\n<geom type=\"box\" size=\"1 1\"/></body>"),
     "error 4:18 size of a box has 3 numbers greater than 0"},
    {"no_mass",
     world("<body name=\"b\"><freejoint/>" + ball +
           "<body>\n<joint name=\"q\"/></body>"
           "</body>"),
     "error 4:2 joint `q` moves a body without mass"},
    {"mesh_mass", world("<body><freejoint/>\n<geom type=\"mesh\" mesh=\"m\"/></body>"),
     "error 4:2 body `body_1` has the mass of its geoms, and that of a mesh is not computed"},
    {"range", world("<body>\n<joint range=\"2 1\"/>" + ball + "</body>"),
     "error 4:8 2 is not below 1"},
    {"number", world("<body><freejoint/>\n<geom size=\"wide\"/></body>"),
     "error 4:7 `wide` is no number"},
    {"too_many_numbers", world("<body pos=\"1 2 3 4\"><freejoint/>" + ball + "</body>"),
     "error 3:7 pos takes 3 numbers at most"},
    {"includes_itself", mujoco("<include file=\"robot.xml\"/>"),
     "error 2:10 `robot.xml` is included a second time, or includes itself"},
    {"no_file", mujoco("<include file=\"none.xml\"/>"), "error 2:10 there is no file `none.xml`"},
    {"inner_free",
     world("<body>" + ball + "<joint/><body>\n<freejoint/>" + ball + "</body></body>"),
     "error 4:2 a free joint is the only one of a body of the world"},
    {"second_body",
     world("<body name=\"b\"><freejoint/>" + ball + "<body name=\"b\">" + ball + "</body></body>"),
     "a second body `b`"},
    {"deep", deep_bodies(), "bodies hang on each other 501 deep: 500 are the most"},
    {"entities",
     "<!DOCTYPE m [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]>\n" +
         world("<body><freejoint/>\n<geom size=\"&b;\"/></body>"),
     "`&b;` is no number"},
    {"actuator_of_nothing",
     world("<body><freejoint/>" + ball + "</body>", "<actuator>\n<motor joint=\"q\"/></actuator>"),
     "there is no joint `q`"},
    {"deep_classes", deep_classes(),
     "default classes stand in each other 501 deep: 500 are the most"},
    {"unknown_in_world", world("<body><freejoint/>" + ball + "</body>\n<boddy/>"),
     "error 4:2 <worldbody> has no <boddy>; did you mean `body`?"},
    {"unknown_in_body", world("<body><freejoint/>" + ball + "\n<geomm/></body>"),
     "error 4:2 <body> has no <geomm>"},
    {"unknown_default", mujoco("<default>\n<jointt/></default>"),
     "error 3:2 <default> has no <jointt>"},
    {"unknown_actuator", mujoco("<actuator>\n<motr/></actuator>"),
     "error 3:2 <actuator> has no <motr>"},
    {"unknown_equality", mujoco("<equality>\n<glue/></equality>"),
     "error 3:2 <equality> has no <glue>"},
    {"replicate_in_world", world("<body><freejoint/>" + ball + "</body>\n<replicate count=\"3\"/>"),
     "error 4:2 <replicate> of the world is not read"},
    {"attach_in_world", world("<attach model=\"m\"/>"),
     "error 3:2 <attach> of the world is not read"},
    {"two_orientations",
     world("<body>\n<joint/><geom size=\"1\" quat=\"1 0 0 0\" euler=\"0 0 1\"/></body>"),
     "<geom> has an orientation already, quat: one is allowed"},
    {"unread_number", world("<body><freejoint/>\n<geom size=\"0.1\" gap=\"x\"/></body>"),
     "`x` is no number"},
    {"sensor_of_nothing",
     world("<body><freejoint/>" + ball + "</body>", "<sensor>\n<jointpos joint=\"q\"/></sensor>"),
     "there is no joint `q`"},
    {"exclude_of_nothing",
     world("<body name=\"b\"><freejoint/>" + ball + "</body>",
           "<contact>\n<exclude body1=\"b\" body2=\"c\"/></contact>"),
     "there is no body `c`"},
    {"tendon_of_nothing",
     world("<body name=\"b\"><freejoint/>" + ball + "</body>",
           "<tendon><fixed>\n<joint joint=\"q\" coef=\"1\"/></fixed></tendon>"),
     "there is no joint `q`"},
    {"coupled_robots",
     world(two_robots, "<equality>\n<joint joint1=\"j1\" joint2=\"j2\"/></equality>"),
     "joint `j1` cannot follow `j2`, which is of another robot"},
    {"kv_and_ratio",
     world("<body><joint name=\"q\"/>" + ball + "</body>",
           "<actuator>\n<position joint=\"q\" kv=\"1\" dampratio=\"1\"/></actuator>"),
     "kv and dampratio are given: one is allowed"},
    {"two_ctrl_ranges",
     world("<body><joint name=\"q\" range=\"0 1\"/>" + ball + "</body>",
           "<actuator>\n<position joint=\"q\" inheritrange=\"1\" ctrlrange=\"0 1\"/></actuator>"),
     "ctrlrange and inheritrange are given: one is allowed"},
    {"no_range_to_inherit",
     world("<body><joint name=\"q\"/>" + ball + "</body>",
           "<actuator>\n<position joint=\"q\" inheritrange=\"1\"/></actuator>"),
     "joint `q` has no range to inherit"},
    {"nothing_moves", world(ball), "error 1:2 the file has no <body> that moves"},
};
INSTANTIATE_TEST_SUITE_P(Files, WrongMjcf, ::testing::ValuesIn(wrongs),
                         [](const auto& of) { return of.param.name; });

TEST(Mjcf, AKeyframeThatIsNotThereIsNamed) {
  const Loaded loaded = load_mjcf(
      world("<body><freejoint/>" + ball + "</body>", "<keyframe><key name=\"home\"/></keyframe>"),
      ", keyframe = homes");
  EXPECT_FALSE(loaded.experiment);
  EXPECT_NE(loaded.diagnostics.find("the file has no <key> `homes`; it has home"),
            std::string::npos)
      << loaded.diagnostics;
}

}  // namespace
}  // namespace hookpoint::tests
