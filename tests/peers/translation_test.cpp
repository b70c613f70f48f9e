// Translated constants, given to each engine as its users give them, do what the translation says.
// ctest: alone, released
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "apps/shared/exported.h"
#include "apps/shared/translated.h"
#include "reference/engines.h"
#include "simulation/analysis/inverse_weight.h"
#include "simulation/experiment/robot_tree.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/native_contacts/native_contact.h"
#include "translation/translate.h"

namespace hookpoint {
namespace {

using native::Ball;
using native::Contact;
using translation::Parameters;
using translation::Situation;

using Make = std::function<std::unique_ptr<Contact>(const Ball&, const Parameters&,
                                                    const std::string& snippet)>;

/// The engines of this build by the names of their targets.
std::map<std::string, Make> engines() {
  std::map<std::string, Make> all;
  all["ode"] = [](const Ball& ball, const Parameters& p, const std::string&) {
    return native::ode_contact(ball, p.number("mu"), p.number("soft_erp"), p.number("soft_cfm"),
                               p.number("slip1"));
  };
  all["bullet"] = [](const Ball& ball, const Parameters& p, const std::string&) {
    return native::bullet_contact(ball, p.number("contactStiffness"), p.number("contactDamping"),
                                  p.number("friction"), p.word("frictionAnchor") == "1");
  };
  all["pybullet"] = [](const Ball& ball, const Parameters& p, const std::string&) {
    return native::pybullet_contact(ball, p.number("contactStiffness"), p.number("contactDamping"),
                                    p.number("lateralFriction"), p.word("frictionAnchor") == "1");
  };
#ifdef HOOKPOINT_NATIVE_MUJOCO
  all["mujoco"] = [](const Ball& ball, const Parameters&, const std::string& snippet) {
    return native::mujoco_contact(ball, snippet);
  };
#endif
#ifdef HOOKPOINT_NATIVE_DART
  all["dart"] = [](const Ball& ball, const Parameters& p, const std::string&) {
    return native::dart_contact(ball, p.number("error_reduction_parameter"),
                                p.number("max_error_reduction_velocity"),
                                p.number("constraint_force_mixing"), p.number("slip_compliance"),
                                p.number("friction_coeff"));
  };
#endif
#ifdef HOOKPOINT_NATIVE_SIMBODY
  all["simbody"] = [](const Ball& ball, const Parameters& p, const std::string&) {
    return native::simbody_contact(ball, p.number("stiffness"), p.number("dissipation"),
                                   p.number("us"), p.number("ud"), p.number("transition_velocity"));
  };
#endif
  return all;
}

void run(Contact& contact, double deltat, double duration) {
  for (int i = 0; i < std::lround(duration / deltat); ++i) contact.step();
}

/// Depth at rest under the load [m].
double measured_depth(Contact& contact, const Situation& at) {
  contact.start(0., 0., {0., 0., -at.load / at.mass});
  run(contact, at.deltat, 3.);
  return at.radius - contact.position()[2];
}

/// Speed downhill on 10 deg, once the contact rests [m/s].
double measured_creep(Contact& contact, const Situation& at) {
  const double g = at.load / at.mass;
  contact.start(0., 0., {g * std::sin(translation::slope), 0., -g * std::cos(translation::slope)});
  run(contact, at.deltat, 3.);
  const double from = contact.position()[0];
  run(contact, at.deltat, 1.);
  return contact.position()[0] - from;
}

/// Speed after over speed before, in the mean over where in a step the plane is met.
double measured_rebound(Contact& contact, const Situation& at) {
  constexpr int phases = 8;
  double sum = 0.;
  for (int phase = 0; phase < phases; ++phase) {
    // From above, so that an engine which sees a contact before it is made does.
    const double step = translation::impact_speed * at.deltat;
    contact.start(step * ((phase + 0.5) / phases - 20.), translation::impact_speed, {0., 0., 0.});
    run(contact, at.deltat, 20. * at.deltat);
    for (int i = 0; i < 100000; ++i) {
      contact.step();
      if (contact.position()[2] > at.radius + 1e-3 && contact.velocity()[2] > 0.) break;
    }
    sum += contact.velocity()[2] / translation::impact_speed;
  }
  return sum / phases;
}

constexpr double tolerance = 0.05;

void expect_predicted(Contact& contact, const translation::Behaviour& predicted,
                      const Situation& at) {
  ASSERT_TRUE(predicted.static_depth && predicted.rebound);
  EXPECT_NEAR(measured_depth(contact, at) / *predicted.static_depth, 1., tolerance);
  EXPECT_NEAR(measured_rebound(contact, at), *predicted.rebound, tolerance * *predicted.rebound);
  if (predicted.creep) {
    // The ball's inertia lets it roll by 1e-6 m/s.
    EXPECT_NEAR(measured_creep(contact, at), *predicted.creep,
                std::max(tolerance * *predicted.creep, 1e-6));
  }
}

class SevenGrounds : public ::testing::TestWithParam<std::string> {};

TEST_P(SevenGrounds, DoInEachEngineWhatTheTranslationSays) {
  application::TranslateRequest request;
  request.file = GetParam();
  request.load = "24.525 N";
  application::Application application;
  const auto answers = application::translated(application, request);
  ASSERT_TRUE(answers);
  ASSERT_EQ(answers->size(), 1u);
  const translation::Answer& answer = answers->front();
  const Situation& at = answer.at;
  std::size_t judged = 0;
  for (const auto& [name, make] : engines()) {
    SCOPED_TRACE(name);
    const translation::Target* target = translation::find_target(name);
    ASSERT_TRUE(target);
    EXPECT_EQ(target->basis, translation::Basis::measured);
    const auto translated = translation::translate_to(*target, answer.desired, at);
    const auto contact = make(Ball{at.mass, at.radius, at.deltat}, translated.parameters,
                              target->snippet(translated.parameters, at));
    const translation::Behaviour& predicted = translated.behaviour;
    expect_predicted(*contact, predicted, at);
    // The material's own depth, whatever the engine.
    EXPECT_NEAR(*predicted.static_depth * answer.desired.stiffness / at.load, 1., tolerance);
    ++judged;
  }
  EXPECT_GE(judged, 3u);
}

struct Own {
  const char* engine;
  std::vector<std::string> settings;
};

/// What users have in their files: an engine's defaults, and numbers of their own.
class OwnParameters : public ::testing::TestWithParam<Own> {};

TEST_P(OwnParameters, DoWhatIsPredictedOfThem) {
  const auto all = engines();
  const auto found = all.find(GetParam().engine);
  if (found == all.end()) GTEST_SKIP() << "this build has no " << GetParam().engine;
  Situation at;
  at.mass = 2.5;
  at.load = 24.525;
  const translation::Target* target = translation::find_target(GetParam().engine);
  const auto reading = translation::read_from(*target, GetParam().settings, at);
  const auto contact = found->second(Ball{at.mass, at.radius, at.deltat}, reading.from.parameters,
                                     target->snippet(reading.from.parameters, at));
  expect_predicted(*contact, reading.from.behaviour, at);
  EXPECT_NEAR(reading.desired.stiffness * *reading.from.behaviour.static_depth, at.load, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    All, OwnParameters,
    ::testing::Values(Own{"mujoco", {}}, Own{"mujoco", {"friction=0.6", "impratio=10"}},
                      Own{"mujoco", {"cone=elliptic", "impratio=100", "solimp=0.9,0.95,0.001"}},
                      Own{"mujoco", {"cone=elliptic", "solref=0.005,1", "solimp=0.015,1,0.022"}},
                      Own{"mujoco", {"solref=-20000,-300", "friction=0.8"}},
                      Own{"ode", {"slip1=1e-5"}},
                      Own{"ode", {"soft_erp=0.6", "soft_cfm=1e-4", "mu=0.7"}}, Own{"dart", {}},
                      Own{"dart",
                          {"constraint_force_mixing=0.5", "error_reduction_parameter=0.3",
                           "max_error_reduction_velocity=10", "slip_compliance=0.01"}},
                      Own{"bullet", {"contactStiffness=30000", "contactDamping=200"}},
                      Own{"pybullet",
                          {"contactStiffness=30000", "contactDamping=1000", "frictionAnchor=1"}},
                      Own{"simbody", {"us=0.8", "ud=0.6", "dissipation=0.5"}}));

#ifdef HOOKPOINT_NATIVE_MUJOCO
// The whole way: a scene of ours as MJCF, in MuJoCo itself.
TEST(ExportedToMujoco, ABlockStandsAndCreepsAsSaid) {
  application::Application application;
  application.give(
      "block.hook",
      "World w { deltat = 1 ms; Material m { normal_stiffness = 20 kN/m; normal_damping = 60 N.s/m; }\n"
      "Terrain.Slope hill { angle = 10 deg; material = m; } Robot block { Base.mobile { rest_on = hill;\n"
      "Shape.Box { dimensions = 0.2, 0.2, 0.04; mass = 4 kg; } } } }");
  application::ExportRequest request;
  request.file = "block.hook";
  request.format = "mjcf";
  const auto model = application::exported(application, request);
  ASSERT_TRUE(model);
  const auto before = native::mujoco_run(model->text, 1000).positions,
             after = native::mujoco_run(model->text, 2000).positions;
  const double c = std::cos(translation::slope), s = std::sin(translation::slope);
  const auto along = [&](const std::vector<double>& q) { return c * q[0] - s * q[2]; };
  const auto across = [&](const std::vector<double>& q) { return s * q[0] + c * q[2]; };
  // Half the block's height, less the depth of a quarter of its weight in the spring.
  EXPECT_NEAR(across(after), 0.02 - 9.81 * c / 20e3, 0.05 * 9.81 / 20e3);
  EXPECT_NEAR(along(after) - along(before), 1e-3, 0.05e-3);
}

/// A table whose four legs hang on stiff springs at hip and knee: its shanks are light, so that MuJoCo
/// scales their contacts by much more than one over its mass.
const std::string legged = R"(World w { deltat = 0.5 ms;
  Material m { normal_stiffness = 20 kN/m; normal_damping = 60 N.s/m; }
  Terrain.Flat ground { material = m; }
  Robot table { Base.mobile { location = 0, 0, 0.42; mass = 6; inertia = 0.1, 0.1, 0.1, 0, 0, 0; }
    For i in 0..3 { Chain leg[i] { hip_distance = i < 2 ? 0.2 : -0.2, i == 0 || i == 2 ? 0.2 : -0.2, 0;
      hip_orientation = pi/2, 0, 0;
      Link thigh { dhangle = -pi/2; mass = 0.5; center_of_mass = 0.1, 0, 0; inertia = 1e-3, 1e-3, 1e-3, 0, 0, 0;
        stiffness = 2000; damping = 20; }
      Link shank { dhlength = 0.2; mass = 0.1; center_of_mass = 0.1, 0, 0; inertia = 1e-4, 1e-4, 1e-4, 0, 0, 0;
        stiffness = 2000; damping = 20; Shape.Sphere { radius = 0.02; location = 0.2, 0, 0; } } } } } })";

TEST(ExportedToMujoco, FeetOfARobotWithJointsStandAsDeepAsHere) {
  application::Application application;
  application.give("table.hook", legged);
  application::ExportRequest request;
  request.file = "table.hook";
  request.format = "mjcf";
  const auto model = application::exported(application, request);
  ASSERT_TRUE(model);
  const auto run = native::mujoco_run(model->text, 8000);
  const double mass = 6. + 4. * 0.6;
  EXPECT_NEAR(run.deepest, mass * 9.81 / 4. / 20e3, 0.05 * mass * 9.81 / 4. / 20e3);
}

// Of every body of a robot with joints, beside MuJoCo's own of the exported model.
TEST(ExportedToMujoco, InverseWeightsAreMujocos) {
  for (const char* scene : {"standing_hexapod", "standing_quadruped_urdf"}) {
    application::Application application({}, [](const language::Diagnostics&) {});
    application::ExportRequest request;
    request.file = testing::source_folder() + "/configs/scenes/" + scene + ".hook";
    request.format = "mjcf";
    const auto model = application::exported(application, request);
    const auto root = application.evaluate(request.file, {});
    const auto experiment = application.load(*root);
    ASSERT_TRUE(model && experiment);
    const auto truth = native::mujoco_run(model->text, 0).inverse_weights;
    ASSERT_EQ(truth.size(), simulation::body_count(experiment->robots[0]) + 1);
    for (std::size_t body = 0; body + 1 < truth.size(); ++body)
      EXPECT_NEAR(simulation::inverse_weight(*experiment, 0, body) / truth[body + 1], 1., 1e-6)
          << scene << body;
  }
}

/// A box on four balls, whose contact the file states; gravity is tilted by 5 deg.
std::string box_on_balls(const std::string& option, const std::string& foot) {
  return "<mujoco><option timestep=\"0.001\" gravity=\"0.855 0 -9.7727\" " + option +
         R"( integrator="Euler"/><default><geom contype="0" conaffinity="1"/></default><worldbody>
  <geom type="plane" size="0 0 1" contype="1" friction="0"/>
  <body name="box" pos="0 0 0.12"><freejoint/><inertial pos="0 0 0" mass="4" diaginertia="0.03 0.04 0.05"/>
    <geom size="0.02" pos="0.1 0.1 -0.1" )" +
         foot + "/><geom size=\"0.02\" pos=\"-0.1 0.1 -0.1\" " + foot +
         "/><geom size=\"0.02\" pos=\"0.1 -0.1 -0.1\" " + foot +
         "/><geom size=\"0.02\" pos=\"-0.1 -0.1 -0.1\" " + foot +
         R"(/></body></worldbody>
  <keyframe><key qpos="0 0 0.12 1 0 0 0"/></keyframe></mujoco>)";
}

struct StatedContact {
  const char *option, *foot;
};
constexpr std::array stated_contacts{
    StatedContact{"", "priority=\"1\" friction=\"0.8\""},
    StatedContact{
        "cone=\"elliptic\" impratio=\"100\"",
        "priority=\"1\" friction=\"0.6\" solref=\"0.01 0.7\" solimp=\"0.5 0.99 0.002 0.4 3\""},
    StatedContact{"cone=\"elliptic\"",
                  "priority=\"1\" friction=\"0.6\" solref=\"-3000 -80\" solimp=\"0.8 0.8 0.01\""},
    StatedContact{"impratio=\"10\"", "priority=\"1\" condim=\"1\""},
};

/// Where the box is under `setting` of the World after 1 s [m].
Vector3d box_after_a_second(const StatedContact& stated, const std::string& setting) {
  application::Application application({}, [](const language::Diagnostics&) {});
  const testing::Workplace place;
  place.file("box.xml", box_on_balls(stated.option, stated.foot));
  const auto root = application.evaluate(
      place.file(
          "scene.hook",
          "World w { gravity = 0.855, 0, -9.7727; " + setting +
              " Terrain.Flat ground { } Include \"box.xml\" (name = box, contact = file); }"),
      {});
  const auto experiment = root ? application.load(*root) : std::nullopt;
  if (!experiment) {
    ADD_FAILURE() << setting;
    return {};
  }
  const auto engine = application.make_engine(*experiment);
  for (int i = 0; i < std::lround(1. / experiment->deltat); ++i) engine->step();
  return engine->state().bodies[0].position;
}

// The robot's file says what MuJoCo takes: the same bits of path but for the order of a few sums.
TEST(ContactOfAFile, RunsAtSettingsFileAsTheFileItselfInMujoco) {
  for (const StatedContact& stated : stated_contacts) {
    const auto truth = native::mujoco_run(box_on_balls(stated.option, stated.foot), 1000).positions;
    const Vector3d here =
        box_after_a_second(stated, "deltat = 1 ms; engine = mujoco; settings = file;");
    const Vector3d there{truth[0], truth[1], truth[2]};
    EXPECT_LT(norm(here - there), 1e-9) << stated.option << stated.foot;
    EXPECT_GT(norm(there - Vector3d{0., 0., 0.12}), 1e-5) << "it does not stay where it was put";
  }
}

TEST(ContactOfAFile, StandsUnderOurLawAsDeepAsInMujoco) {
  for (const StatedContact& stated : stated_contacts) {
    constexpr double level = 0.12;  // where the balls touch
    const double truth =
        level - native::mujoco_run(box_on_balls(stated.option, stated.foot), 1000).positions[2];
    const double here = level - box_after_a_second(stated, "deltat = 0.1 ms;").z;
    EXPECT_NEAR(here / truth, 1., 0.01) << stated.option << stated.foot;
  }
}

TEST(ExportedToMujoco, EveryRobotOfTheScenesCompiles) {
  for (const char* scene :
       {"standing_hexapod", "walking_hexapod", "standing_quadruped_urdf", "sloped_block"}) {
    application::Application application({}, [](const language::Diagnostics&) {});
    application::ExportRequest request;
    request.file = testing::source_folder() + "/configs/scenes/" + scene + ".hook";
    request.format = "mjcf";
    const auto model = application::exported(application, request);
    ASSERT_TRUE(model);
    for (const double number : native::mujoco_run(model->text, 100).positions)
      EXPECT_TRUE(std::isfinite(number)) << scene;
  }
}
#endif

INSTANTIATE_TEST_SUITE_P(All, SevenGrounds,
                         ::testing::Values("concrete", "gym_mat", "ice", "loose_sand",
                                           "packed_clay", "soft_moss", "stone"));

}  // namespace
}  // namespace hookpoint
