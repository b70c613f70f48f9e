// Classes by name, and the rules that a class must keep when it declares its ports.
#include "control/registry.h"

#include <gtest/gtest.h>

#include "tests/support/component_bench.h"

namespace hookpoint::control {
namespace {

class Good final : public Component {
 public:
  Input current{*this, "current", "rad", "measured", 0.25};
  Parameter gain = Parameter{*this, "gain", "", 2., "output per input", 3}.range(0., 10.);
  Text mode = Text{*this, "mode", "how", "slow"}.choices({"slow", "fast"});
  Text file = Text{*this, "file", "what"}.path();
  Output output{*this, "output", "N.m", "command"};
  State memory{*this, "memory", "rad", "last input"};
  void update(const Tick&) override {
    output = gain[2] * current;
    memory = double{current};
  }
};

class TwiceTheSame final : public Component {
 public:
  Input a{*this, "a", "", ""};
  Output b{*this, "a", "", ""};
  void update(const Tick&) override {}
};

class WithoutName final : public Component {
 public:
  Input a{*this, "", "", ""};
  void update(const Tick&) override {}
};

class WithoutValues final : public Component {
 public:
  Input a{*this, "a", "", "", 0., 0};
  void update(const Tick&) override {}
};

class DefaultOutside final : public Component {
 public:
  Parameter a = Parameter{*this, "a", "", 3., ""}.range(0., 2.);
  void update(const Tick&) override {}
};

class DefaultNoChoice final : public Component {
 public:
  Text a = Text{*this, "a", "", "x"}.choices({"y", "z"});
  void update(const Tick&) override {}
};

class NamedLikeStub final : public Component {
 public:
  Parameter a{*this, "delay", "s", 0., ""};
  void update(const Tick&) override {}
};

class AttachedToNothing final : public Component {
 public:
  Input a = Input{*this, "a", "", ""}.attached("angle");
  void update(const Tick&) override {}
};

class NamedByNoIdentifier final : public Component {
 public:
  Input a{*this, "2a", "", ""};
  void update(const Tick&) override {}
};

class CountedByNothing final : public Component {
 public:
  Parameter a = Parameter{*this, "a", "", 0., "", 4}.counted_by("legs");
  void update(const Tick&) override {}
};

template <class Type>
std::string problem(const std::string& input = "", const std::string& output = "") {
  return declaration_problem(describe_class<Type>("X", "x", Attachment::none, input, output));
}

TEST(Registry, HoldsTheClassesThatComeWithIt) {
  for (const char* name : {"Controller.PD", "Controller.PID", "Controller.Trajectory",
                           "Signal.Step", "Signal.Ramp", "Signal.Sine", "Signal.Noise", "Gain",
                           "Sum", "Probe", "Data", "Filter", "Switch", "Sample", "Delay"}) {
    const ComponentClass* type = Registry::instance().find(name);
    ASSERT_NE(type, nullptr) << name;
    EXPECT_EQ(type->name, name);
    EXPECT_FALSE(type->doc.empty()) << name;
  }
  EXPECT_EQ(Registry::instance().find("Controller.Nothing"), nullptr);
  EXPECT_TRUE(Registry::instance().problems().empty());
}

TEST(Registry, EveryClassDeclaresItselfRightly) {
  for (const auto& [name, type] : Registry::instance().classes()) {
    EXPECT_EQ(declaration_problem(type), "") << name;
    const std::unique_ptr<Component> component = type.make();
    for (const PortDescription& port : component->ports()) {
      EXPECT_FALSE(port.doc.empty()) << name << '.' << port.name;
    }
  }
}

TEST(Registry, RefusesATakenNameAndSaysWhose) {
  Registry registry;
  registry.add(describe_class<Good>("Good", "the first"));
  registry.set_origin("libmine.so");
  registry.add(describe_class<TwiceTheSame>("Good", "the second"));
  registry.add(describe_class<Good>("Better", "of the plugin"));
  EXPECT_EQ(registry.find("Good")->doc, "the first");
  EXPECT_EQ(registry.find("Good")->origin, "");
  EXPECT_EQ(registry.find("Better")->origin, "libmine.so");
  ASSERT_EQ(registry.problems().size(), 1u);
  EXPECT_EQ(registry.problems()[0],
            "class 'Good' of 'libmine.so' is refused: the program has one of that name");
  registry.remove("libmine.so");
  EXPECT_EQ(registry.find("Better"), nullptr);
  EXPECT_NE(registry.find("Good"), nullptr);
}

TEST(Declaration, SaysWhatIsWrong) {
  EXPECT_EQ(problem<Good>("current", "output"), "");
  EXPECT_EQ(problem<Good>("gain", "output"), "");  // a parameter is an input too
  EXPECT_EQ(problem<Good>("goal", "output"), "the default port 'goal' does not exist");
  EXPECT_EQ(problem<Good>("output", ""), "the default port 'output' is of the wrong direction");
  EXPECT_EQ(problem<Good>("", "memory"), "the default port 'memory' is of the wrong direction");
  EXPECT_EQ(problem<TwiceTheSame>(), "two ports are named 'a'");
  EXPECT_EQ(problem<WithoutName>(), "a port has no name");
  EXPECT_EQ(problem<WithoutValues>(), "port 'a' has no values");
  EXPECT_EQ(problem<DefaultOutside>(), "the default of 'a' is outside its range");
  EXPECT_EQ(problem<DefaultNoChoice>(), "the default of 'a' is none of its choices");
  EXPECT_EQ(problem<NamedLikeStub>(), "port 'delay' has the name of a field of the stub");
  EXPECT_EQ(problem<AttachedToNothing>(),
            "port 'a' is attached, but the class attaches to nothing");
  EXPECT_EQ(problem<CountedByNothing>(),
            "port 'a' is counted by 'legs', which is no parameter of one number");
  EXPECT_EQ(problem<NamedByNoIdentifier>(), "port '2a' is not named by an identifier");
  for (const char* name : {"", ".X", "X.", "X..Y", "3D", "My class", "X-Y"}) {
    EXPECT_EQ(declaration_problem(describe_class<Good>(name, "", Attachment::none, "current")),
              "a class is named by identifiers joined by dots")
        << name;
  }
}

TEST(Declaration, IsWhatTheMembersSay) {
  Good good;
  ASSERT_EQ(good.ports().size(), 6u);
  const PortDescription& current = good.ports()[0];
  EXPECT_EQ(current.kind, PortKind::input);
  EXPECT_EQ(current.unit, "rad");
  EXPECT_EQ(current.doc, "measured");
  EXPECT_EQ(current.default_value, 0.25);
  const PortDescription& gain = good.ports()[1];
  EXPECT_EQ(gain.kind, PortKind::parameter);
  EXPECT_EQ(gain.first, 1u);
  EXPECT_EQ(gain.count, 3u);
  EXPECT_EQ(gain.minimum, 0.);
  EXPECT_EQ(gain.maximum, 10.);
  EXPECT_EQ(good.ports()[2].choices, (std::vector<std::string>{"slow", "fast"}));
  EXPECT_EQ(good.ports()[2].default_text, "slow");
  EXPECT_EQ(good.mode.value(), "slow");
  EXPECT_TRUE(good.ports()[3].path);
  EXPECT_EQ(good.ports()[3].first, 1u);
  EXPECT_EQ(good.ports()[4].kind, PortKind::output);
  EXPECT_EQ(good.ports()[5].kind, PortKind::state);
}

TEST(Declaration, ValuesAreReadAndWrittenByIndex) {
  Good good;
  EXPECT_EQ(find_value(good, "current"), 0u);
  EXPECT_EQ(find_value(good, "gain[0]"), 1u);
  EXPECT_EQ(find_value(good, "gain[2]"), 3u);
  EXPECT_EQ(find_value(good, "output"), 4u);
  for (const char* none :
       {"gain", "gain[3]", "gain[]", "gain[x]", "gain[1x]", "output[0]", "mode", "nothing", ""}) {
    EXPECT_EQ(find_value(good, none), std::nullopt) << none;
  }
  good.values()[3] = 5.;
  good.update({});
  EXPECT_EQ(good.values()[4], 1.25);
  EXPECT_EQ(good.values()[5], 0.25);
  EXPECT_FALSE(good.current.driven());
  good.set_driven(0, true);
  EXPECT_TRUE(good.current.driven());
}

TEST(Declaration, AssigningAnOutputCopiesItsValue) {
  class Copier final : public Component {
   public:
    Output a{*this, "a", "", ""};
    Output b{*this, "b", "", ""};
    void update(const Tick&) override {
      a = 3.;
      b = a;
      a = 4.;
    }
  } copier;
  copier.update({});
  EXPECT_EQ(copier.values()[0], 4.);
  EXPECT_EQ(copier.values()[1], 3.);
}

/// Counts its updates from 7, in two places at once.
class Counter final : public Component {
 public:
  Output count{*this, "count", "", "", 2};
  State seen = State{*this, "seen", "", "", 2}.initial(7.);
  void update(const Tick&) override {
    for (std::size_t i = 0; i < 2; ++i) {
      seen[i] = seen[i] + 1.;
      count[i] = seen[i];
    }
  }
};

TEST(Declaration, AStateHasAFirstValueAndElements) {
  Counter counter;
  EXPECT_EQ(counter.ports()[1].default_value, 7.);
  EXPECT_EQ(counter.seen[1], 7.);
  counter.seen[1] = 20.;
  counter.update({});
  EXPECT_EQ(counter.values()[0], 8.);
  EXPECT_EQ(counter.values()[1], 21.);
  EXPECT_EQ(counter.seen.get(1), 21.);
}

}  // namespace
}  // namespace hookpoint::control
