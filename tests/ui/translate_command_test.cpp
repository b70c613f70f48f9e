// hookpoint translate: contact constants as parameters of other engines, and back.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/command.h"
#include "tests/support/folders.h"

namespace hookpoint {
namespace {

using nlohmann::json;
using testing::CommandResult;
using testing::config;
using testing::Workplace;

json answer(const Workplace& work, const std::string& arguments) {
  const CommandResult result = work.hookpoint("translate --json " + arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return json::parse(result.out);
}

const json& target(const json& answer, const std::string& engine) {
  for (const json& each : answer.at("targets"))
    if (each.at("engine") == engine) return each;
  throw std::runtime_error("no " + engine);
}

// 20 kN/m, 60 N s/m at 1 ms: ERP = dt k/(dt k + c), CFM = 1/(dt k + c) (ODE manual, How to use ERP and CFM).
TEST(Translate, IsTheManualsFormula) {
  const Workplace work;
  work.file(
      "m.hook",
      "Material m { normal_stiffness = 20 kN/m; normal_damping = 60 N.s/m; tangential_stiffness = 10 kN/m;\n"
      "tangential_damping = 30 N.s/m; static_friction = 0.8; kinetic_friction = 0.8; }\n");
  const json found = answer(work, "m.hook --load '10 N' --dt '1 ms'");
  EXPECT_EQ(found.at("material"), "m");
  EXPECT_EQ(found.at("load"), 10.);
  EXPECT_NEAR(found.at("mass").get<double>(), 10. / 9.81, 1e-12);
  EXPECT_EQ(found.at("deltat"), 1e-3);
  EXPECT_NEAR(found.at("predicted").at("static_depth").get<double>(), 10. / 20e3, 1e-15);
  EXPECT_EQ(found.at("predicted").at("creep_10deg"), 0.);
  const json& ode = target(found, "ode").at("parameters");
  EXPECT_NEAR(ode.at("soft_erp").get<double>(), 20. / 80., 1e-12);
  EXPECT_NEAR(ode.at("soft_cfm").get<double>(), 1. / 80., 1e-12);
  // The law holds, so that the foot is to creep by 1 mm/s at most.
  const double pull = 10. * std::sin(std::acos(-1.) / 18.);
  EXPECT_NEAR(ode.at("slip1").get<double>(), 1e-3 / pull, 1e-12);
  const json creeping = answer(work, "m.hook --load '10 N' --creep '1 m/s' --to ode");
  EXPECT_NEAR(target(creeping, "ode").at("parameters").at("slip1").get<double>(), 1. / 40., 1e-12);
  const json& bullet = target(found, "bullet").at("parameters");
  EXPECT_EQ(bullet.at("contactStiffness"), 20e3);
  EXPECT_EQ(bullet.at("contactDamping"), 60.);
  // Each is whole, and says where its formulas come from.
  std::set<std::string> engines;
  for (const json& each : found.at("targets")) {
    engines.insert(each.at("engine"));
    EXPECT_FALSE(each.at("snippet").get<std::string>().empty());
    EXPECT_FALSE(each.at("source").get<std::string>().empty());
    EXPECT_TRUE(each.at("basis") == "measured" || each.at("basis") == "formula");
    for (const char* key : {"static_depth", "creep_10deg", "rebound", "largest_stable_step"})
      EXPECT_TRUE(each.at("predicted").contains(key)) << key;
    EXPECT_TRUE(each.at("cannot").is_array());
  }
  EXPECT_EQ(engines, (std::set<std::string>{"mujoco", "bullet", "pybullet", "ode", "gazebo", "dart",
                                            "simbody", "drake", "drake_hydroelastic", "newton",
                                            "physx", "genesis", "raisim"}));
}

// At a constant impedance d the static force is K d^2/((1 - d) A) r with K = 1/(d t z)^2, so a body of M kg has
// M/((1 - d) t^2 z^2) N/m.
TEST(Translate, ReadsSolrefAsAStiffness) {
  const Workplace work;
  const json found = answer(
      work,
      "--from mujoco solref=0.02,1 solimp=0.9,0.9,0.001 cone=elliptic --load '24.525 N' --dt '2 ms'");
  EXPECT_NEAR(found.at("constants").at("normal_stiffness").get<double>(), 2.5 / (0.1 * 4e-4), 1e-3);
  EXPECT_TRUE(found.at("targets").empty());
  EXPECT_EQ(found.at("from").at("parameters").at("solref").at(0), 0.02);
  const std::string block = found.at("block");
  EXPECT_EQ(block.rfind("Material from_mujoco {", 0), 0u) << block;
}

// The Material that is read from an engine is translated to the same parameters.
TEST(Translate, GoesThereAndBack) {
  const Workplace work;
  for (
      const std::string& from :
      {std::string("ode soft_erp=0.25 soft_cfm=0.0125 slip1=0.0125 mu=0.7"),
       std::string(
           "pybullet contactStiffness=20000 contactDamping=60 lateralFriction=0.7 frictionAnchor=1"),
       std::string(
           "mujoco solref=-18867.9245283,-56.6037735849 solimp=0.0566037735849,0.0566037735849,0 "
           "cone=elliptic friction=0.7")}) {
    const std::string engine = from.substr(0, from.find(' '));
    const json found = answer(work, "--from " + from + " --load '9.81 N' --to " + engine);
    for (const auto& [name, value] : found.at("from").at("parameters").items()) {
      const json& again = target(found, engine).at("parameters").at(name);
      if (!value.is_number()) continue;
      EXPECT_NEAR(again.get<double>(), value.get<double>(), 2e-2 * std::abs(value.get<double>()))
          << engine << " " << name;
    }
  }
}

TEST(Translate, TakesLoadAndStepOfAWorld) {
  const Workplace work;
  const json found = answer(work, config("scenes/sloped_block.hook") + " --to ode");
  EXPECT_EQ(found.at("robot"), "block");
  EXPECT_EQ(found.at("contacts"), 4.);
  EXPECT_NEAR(found.at("load").get<double>() * 4., 9.81, 0.01);
  work.file(
      "two.hook",
      "World w { deltat = 2 ms; Material a { } Terrain.Flat ground { material = a; }\n"
      "Robot one { Base.mobile { location = 0, 0, 0.1; mass = 1; Shape.Sphere { radius = 0.1; } } }\n"
      "Robot two { Base.mobile { location = 1, 0, 0.1; mass = 3; Shape.Sphere { radius = 0.1; } } } }\n");
  const json both = answer(work, "two.hook --to ode");
  ASSERT_TRUE(both.is_array());
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].at("deltat"), 2e-3);
  EXPECT_NEAR(both[1].at("load").get<double>(), 3. * 9.81, 1e-9);
}

TEST(Translate, KeepsCreepBelowWhatIsWanted) {
  const Workplace work;
  const json found = answer(work, "stone --load '24.5 N' --creep '0.5 mm/s'");
  for (const char* engine : {"mujoco", "ode", "gazebo", "simbody", "drake", "genesis"})
    EXPECT_LE(target(found, engine).at("predicted").at("creep_10deg").get<double>(),
              0.5e-3 * (1. + 1e-9))
        << engine;
}

TEST(Translate, TheManualsExampleIsCurrent) {
  const Workplace work;
  const std::string page = testing::read_file(testing::source_folder() + "/docs/translate.md");
  const CommandResult result = work.hookpoint("translate rubber_mat --load '30 N' --to mujoco");
  EXPECT_NE(page.find("```\n" + result.out + "```\n"), std::string::npos) << result.out;
}

TEST(Translate, WrongInputIsSaidAndEndsWithStatus2) {
  const Workplace work;
  work.file("two.hook", "World w { }\n");
  const std::pair<const char*, const char*> cases[]{
      {"", "name one file or material"},
      {"rubber_mat stone --load 3N", "name one file or material"},
      {"rubber_mat", "needs --load"},
      {"nosuch --load 3N", "neither a file nor a material"},
      {"rubber_mat --load '3 kg'", "--load takes a value above 0"},
      {"rubber_mat --load 0N", "--load takes a value above 0"},
      {"rubber_mat --load 3N --to nosuch", "no engine `nosuch`"},
      {"rubber_mat --load 3N --material nosuch", "Material `nosuch`"},
      {"rubber_mat --load 3N --contact impulse", "no stiffness"},
      {"two.hook", "no terrain"},
      {"--from mujoco", "--from needs --load"},
      {"--from nosuch --load 3N", "no engine `nosuch`"},
      {"--from mujoco solreff=1 --load 3N", "no parameter `solreff`"},
      {"--from mujoco solref=0.02,x --load 3N", "not a number"},
      {"--from mujoco solref=1,2,3 --load 3N", "has 2 numbers, not 3"},
      {"--from mujoco solref=-1,5 --load 3N", "-damping not above 0"},
      {"--from mujoco cone=round --load 3N", "pyramidal or elliptic"},
      {"--from ode mu=-1 --load 3N", "mu is 0 or more"},
      {"--from pybullet --load 3N", "rigid"},
      {"--from raisim --load 3N", "rigid"},
  };
  for (const auto& [arguments, part] : cases) {
    const CommandResult result = work.hookpoint(std::string("translate ") + arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_NE(result.err.find(part), std::string::npos) << arguments << ": " << result.err;
  }
}

}  // namespace
}  // namespace hookpoint
