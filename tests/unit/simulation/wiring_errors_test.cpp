// What is wrong with wires, attachments and components, each with the diagnostic that says so, at
// its place.
#include <gtest/gtest.h>

#include "control/registry.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

using namespace control;

/// Reads the joint's angle and drives its torque unless wires say otherwise.
class AttachedGain final : public Component {
 public:
  Parameter gain{*this, "gain", "", 1., "a gain"};
  Input angle = Input{*this, "angle_in", "rad", "the joint's"}.attached("angle");
  Output torque = Output{*this, "drive", "N.m", "the joint's"}.attached("torque");
  void update(const Tick&) override { torque = gain * angle; }
};
HOOKPOINT_REGISTER_COMPONENT(AttachedGain, "Test.Attached", "a gain on a joint", Attachment::joint,
                             "angle_in", "drive")

class Three final : public Component {
 public:
  Parameter gains{*this, "gains", "", 1., "three of them", 3};
  Output output{*this, "output", "", "their sum"};
  void start(double) override {
    if (gains[0] < 0.) throw std::runtime_error("the first gain is below 0; raise it");
  }
  void update(const Tick&) override { output = gains[0] + gains[1] + gains[2]; }
};
HOOKPOINT_REGISTER_COMPONENT(Three, "Test.Three", "three gains")

const std::string arm =
    "World w { Robot bot { Base.fixed { } Chain leg { Link one { mass = 1; Shape.Sphere radius = "
    "1; } } } }\n";

struct Case {
  const char* name;
  std::string text;
  std::string diagnostics;
};

class WrongWiring : public ::testing::TestWithParam<Case> {};

TEST_P(WrongWiring, IsRefusedInTheseWords) {
  const Loaded loaded = load_text(arm + GetParam().text);
  EXPECT_FALSE(loaded.experiment);
  EXPECT_EQ(loaded.diagnostics, GetParam().diagnostics);
}

const Case cases[] = {
    {"two_wires_into_one_input",
     "Controller.PD p { Wire FROM w.bot.leg.one.angle TO current;\nWire FROM w.bot.leg.one.rate TO "
     "current; }",
     "error 3:33 a second wire into `p.current`\nnote 2:19 the first one is here\n"},
    {"into_an_output", "Controller.PD p { Wire FROM w.bot.leg.one.rate TO output; }",
     "error 2:51 `output` of Controller.PD is no input; its inputs are goal, pconstant, dconstant, "
     "current, rate_in\n"},
    {"into_a_state", "Controller.PD p { Wire FROM output TO w.bot.leg.one.angle; }",
     "error 2:39 `angle` of Link is no input; its inputs are torque\n"},
    {"unlike_units", "Wire FROM w.bot.leg.one.angle TO w.bot.leg.one.torque;",
     "error 2:1 `angle` is in rad, `torque` in N.m\n"},
    {"vector_into_number", "Wire FROM w.bot.base.location TO w.bot.leg.one.torque;",
     "error 2:1 `location` carries 3 numbers, `torque` takes 1\n"},
    {"dangling_end", "Controller.PD p { Wire FROM w.bot.leg.two.angle TO current; }",
     "error 2:29 `leg` (Chain) has no object or port `two`; it has hip_distance, "
     "hip_force, hip_moment, hip_orientation, one\nnote 1:38 this Chain\n"},
    {"no_default_port", "Wire FROM w.bot TO w.bot.leg.one.torque;",
     "error 2:11 a Robot has no output of its own: the wire needs FROM and a port; its outputs are "
     "self_contact, position, orientation, velocity, angular_velocity, linear_acceleration, "
     "angular_acceleration, "
     "contact.force, contact.count, contact.moment, contact.center_of_pressure, contact.normal_load, contact.tangential_load, kinetic_energy, potential_energy, numerical_energy, center_of_mass, "
     "center_of_mass_velocity, total_mass\n"},
    {"noise_in_another_unit",
     "Controller.PD p { Wire FROM w.bot.leg.one.angle TO current { noise = 2 mm; } }",
     "error 2:70 `noise` takes the unit of `angle`, rad, not m\n"},
    {"nothing_to_read", "Controller.PD p { Wire FROM w.bot.leg.one.upper_limit TO current; }",
     "error 2:29 `upper_limit` of this Link is not given, so there is nothing to read\n"},
    {"loop_of_two",
     "Controller.PD p { Wire FROM q.output TO current; }\n"
     "Controller.PD q { Wire FROM p.output TO current; }",
     "error 2:19 an algebraic loop: `q.output` to `p.output` to `q.output` within one step; give "
     "one of these wires a delay\n"
     "note 2:19 from `q.output` to `p.current` here\n"
     "note 3:19 from `p.output` to `q.current` here\n"},
    {"loop_of_one", "Controller.PD p { Wire FROM output TO current; }",
     "error 2:19 an algebraic loop: `p.output` to `p.output` within one step; give one of these "
     "wires a delay\n"
     "note 2:19 from `p.output` to `p.current` here\n"},
    {"attached_to_nothing", "Test.Attached a;",
     "error 2:1 this Test.Attached is attached to nothing: give `joint = ...`, or wire its "
     "angle_in, drive\n"},
    {"attached_to_nothing_in_part", "Test.Attached a { Wire TO w.bot.leg.one.torque; }",
     "error 2:1 this Test.Attached is attached to nothing: give `joint = ...`, or wire its "
     "angle_in\n"},
    {"attached_to_a_base", "Test.Attached a { joint = w.bot.base; }",
     "error 2:27 `joint` takes a Link, but `w.bot.base` is a Base.fixed\n"
     "note 1:23 `w.bot.base` is this Base.fixed\n"},
    {"two_attached",
     "Test.Attached a { joint = w.bot.leg.one; }\nTest.Attached b { joint = w.bot.leg.one; }",
     "error 3:27 a second signal into `w.bot.leg.one.torque`\nnote 2:27 the first one is here\n"},
    {"attached_and_wired",
     "Test.Attached a { joint = w.bot.leg.one; }\nController.PD p { Wire TO w.bot.leg.one.torque; "
     "}",
     "error 2:27 a second signal into `w.bot.leg.one.torque`\nnote 3:19 the first one is here\n"},
    {"wrong_count", "Test.Three t { gains = 1,2; }",
     "error 2:24 `gains` takes one number for all or 3 numbers, not 2\n"},
    {"element_that_is_not", "Wire FROM w.bot.leg.one.angle TO t.gains[3];\nTest.Three t;",
     "error 2:34 `gains` of `t` (Test.Three) has no element [3]; its elements are [0] to [2]\n"
     "note 3:1 this Test.Three\n"},
    {"list_and_its_element",
     "Test.Three s; Test.Three t;\nWire FROM w.bot.base.location TO p.point;\nWire FROM s TO "
     "t.gains[1];\nWire FROM s TO t.gains.y;",
     "error 3:34 no object `p` can be seen from here\nerror 5:16 a second wire into "
     "`t.gains.y`\nnote 4:1 the first one is here\n"},
    {"cannot_start", "Test.Three t { gains = -1; }",
     "error 2:1 the first gain is below 0; raise it\n"},
    {"no_file", "Data d { file = \"nowhere.csv\"; column = \"force\"; }",
     "error 2:17 there is no file \"nowhere.csv\" beside this one, in the configs/ of a folder "
     "above it or along the search path (HOOKPOINT_PATH, the installation's configs/)\n"},
    {"delay_too_long",
     "Controller.PD p { Wire FROM w.bot.leg.one.angle TO current { delay = 1e8 s; } }",
     "error 2:19 more than ten million samples would be under way: shorten the delay or lower the "
     "rate\n"},
};

std::string case_name(const ::testing::TestParamInfo<Case>& tested) { return tested.param.name; }
INSTANTIATE_TEST_SUITE_P(Load, WrongWiring, ::testing::ValuesIn(cases), case_name);

std::string push_of(const std::string& fields) {
  const Loaded loaded = load_text(
      "World w { Robot b { Base.mobile { mass = 1; Shape.Sphere radius = 1; } }\nPush p { body = "
      "b.base;" +
      fields + " } }");
  EXPECT_FALSE(loaded.experiment);
  return loaded.diagnostics;
}

TEST(WrongPush, NeedsAWindow) {
  EXPECT_EQ(push_of(""), "error 2:1 this Push never ends; give `to` or `duration`\n");
  EXPECT_EQ(push_of(" to = 1; duration = 1;"),
            "error 2:44 `to` already ends this Push; leave one of `to` and `duration` out\n");
  EXPECT_EQ(push_of(" from = 2; to = 1;"),
            "error 2:40 this Push ends before it begins; `to` must be after `from`\n");
  EXPECT_EQ(push_of(" to = 1; edge = 0.6;"),
            "error 2:40 the two edges of this Push are longer than the Push itself; make `edge` at "
            "most half of it\n");
}

}  // namespace
}  // namespace hookpoint
