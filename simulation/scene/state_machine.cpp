// StateMachine: one of several states at a time; guards, which are formulas of ports, lead from one
// to the next, and each state has a formula of its own for the output.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "language/tree/fields.h"
#include "language/units.h"
#include "simulation/scene/formula_signals.h"

namespace hookpoint::simulation {

using language::FieldSchema;
using language::object_field;
using language::text_field;

namespace {

using language::FormulaOperation;

/// What the formulas of a StateMachine may name besides ports, in the order of their values.
constexpr std::array machine_words{std::string_view("time"), std::string_view("period"),
                                   std::string_view("time_in_state")};
constexpr language::Dimension second_of_machine{0, 0, 1, 0};

class StateMachine final : public control::Component {
 public:
  control::Text unit{*this, "unit", "of the output, as \"N.m\"; default: what the formulas yield"};
  /// Lines `state OUTPUT`, and behind each those of its ways out, `to INDEX GUARD`; `initial
  /// INDEX`.
  control::Text program{*this, "program", "its states and transitions"};
  control::Output output{*this, "output", "?", "what the state says"};
  control::Output state{*this, "state", "", "which one it is in: 0 the first in the file"};
  control::Output time_in_state{*this, "time_in_state", "s", "since it entered the state"};
  control::State entered{*this, "entered", "s", "when it entered the state"};
  control::Input in =
      control::Input{*this, "in", "?", "the ports that the formulas name, in their order"}.open();

  void start(double) override {
    FormulaInputs inputs({machine_words.begin(), machine_words.end()});
    std::istringstream lines(program.value());
    for (std::string word; lines >> word;) {
      std::size_t index = 0;
      if (word != "state") lines >> index;
      std::string formula;
      if (word != "initial") std::getline(lines >> std::ws, formula);
      if (word == "initial") initial_ = index;
      if (word == "state") states_.push_back({ComponentFormula(formula, inputs), {}});
      if (word == "to") states_.back().ways.push_back({index, ComponentFormula(formula, inputs)});
    }
    values_ = inputs.values_for(in);
  }

  void update(const control::Tick& tick) override {
    if (states_.empty()) return;
    values_[0] = tick.time;
    values_[1] = tick.period;
    read_inputs(in, std::span(values_).subspan(machine_words.size()));
    if (tick.count == 0) {
      enter(initial_, tick);
    } else {
      take_way_out(tick);
    }
    time_in_state = tick.time - entered;
    values_[2] = time_in_state;
    output = states_[current()].output(values_);
  }

 private:
  struct Way {
    std::size_t to;
    ComponentFormula guard;
  };
  struct Phase {
    ComponentFormula output;
    std::vector<Way> ways;
  };

  std::size_t current() const { return static_cast<std::size_t>(state); }

  void enter(std::size_t next, const control::Tick& tick) {
    state = static_cast<double>(next);
    entered = tick.time;
  }

  /// The first whose guard holds. A moment less than a millionth of a period ahead counts as
  /// reached.
  void take_way_out(const control::Tick& tick) {
    values_[2] = tick.time - entered + 1e-6 * tick.period;
    for (Way& way : states_[current()].ways) {
      if (way.guard(values_) == 0.) continue;
      return enter(way.to, tick);
    }
  }

  std::vector<Phase> states_;
  std::size_t initial_ = 0;
  std::vector<double> values_;  ///< of the words, then of the inputs
};

HOOKPOINT_REGISTER_COMPONENT(StateMachine, "StateMachine",
                             "one of several states at a time, each with an output; guards lead "
                             "from one to the next",
                             control::Attachment::none, "in")

FieldSchema formula_field(std::string_view name, std::string doc) {
  return required(text_field(name, std::move(doc)));
}

/// Whether the formula says true or false.
bool is_condition(const language::Formula& formula) {
  const language::FormulaNode* node = &formula.nodes.back();
  while (node->operation == FormulaOperation::choose)
    node = &formula.nodes[formula.operands[node->operands.begin + 1]];
  if (node->operation != FormulaOperation::apply)
    return node->operation == FormulaOperation::boolean;
  return node->sign == language::Operator::logical_not || node->sign >= language::Operator::less;
}

class MachineLoader {
 public:
  MachineLoader(const language::Object& object, std::size_t index, Loading& loading)
      : object_(object),
        loading_(loading),
        states_(object.children_of("State")),
        formulas_(object, index,
                  {{machine_words[0], second_of_machine},
                   {machine_words[1], second_of_machine},
                   {machine_words[2], second_of_machine}},
                  loading) {}

  /// The program, as the component reads it.
  std::string run() {
    if (states_.empty()) {
      loading_.error(object_.position,
                     "a StateMachine needs a State: State NAME { output = ...; }");
      return "";
    }
    if (object_.given("unit")) unit_ = declared_dimension(object_, "unit", loading_);
    if (object_.given("initial"))
      program_ += fmt::format("initial {}\n", index_of(object_, "initial"));
    for (const language::Object* state : states_) add_state(*state);
    return std::move(program_);
  }

 private:
  void add_state(const language::Object& state) {
    const auto output = formula_of(state, "output", loading_);
    if (output) check_unit(state, formulas_.add(*output, object_));
    program_ += "state " + (output ? output->text : "") + "\n";
    for (const language::Object* transition : object_.children_of("Transition")) {
      if (transition->object("from") == &state) add_way(*transition);
    }
  }

  void add_way(const language::Object& transition) {
    const auto guard = formula_of(transition, "when", loading_);
    if (!guard) return;
    if (formulas_.add(*guard, object_) && !is_condition(*guard))
      loading_.error(place_of(transition, "when"),
                     "a guard is true or false, such as `load > 5 N`, and this is a number");
    program_ += fmt::format("to {} {}\n", index_of(transition, "to"), guard->text);
  }

  /// All outputs have one unit: what is declared, or that of the first which is known.
  void check_unit(const language::Object& state, const std::optional<language::FormulaUnit>& unit) {
    if (!unit || !unit->dimension) return;
    if (!unit_) unit_ = unit->dimension;
    if (language::fits(*unit->dimension, *unit_)) return;
    loading_.error(place_of(state, "output"),
                   fmt::format("this output is in {}, the others in {}",
                               language::describe_dimension(*unit->dimension),
                               language::describe_dimension(*unit_)));
  }

  /// Of the State that the field names.
  std::size_t index_of(const language::Object& object, std::string_view field) {
    const auto found = std::ranges::find(states_, object.object(field));
    if (found == states_.end())
      loading_.error(place_of(object, field), "this State is one of another StateMachine");
    return static_cast<std::size_t>(found - states_.begin());
  }

  const language::Object& object_;
  Loading& loading_;
  std::vector<const language::Object*> states_;
  FormulaLoader formulas_;
  std::optional<language::Dimension> unit_;
  std::string program_;
};

}  // namespace

void describe_state_machine(language::ClassSchema& schema) {
  std::erase_if(schema.fields, [](const FieldSchema& field) { return field.name == "program"; });
  schema.fields.push_back(
      object_field("initial", "State", "its state at the start; default: the first"));
  schema.children = {"Input", "State", "Transition"};
}

std::string state_machine_program(const language::Object& object, std::size_t index,
                                  Loading& loading) {
  return MachineLoader(object, index, loading).run();
}

void add_state_machine_parts(language::Schema& schema) {
  language::ClassSchema state;
  state.name = "State";
  state.only_in = "StateMachine";
  state.doc = "what its StateMachine does while it is in it";
  state.naming = language::Naming::required;
  state.fields = {
      formula_field("output", "a formula, in quotes, of ports, `time`, `period`, `time_in_state`")};
  schema.add(std::move(state));
  language::ClassSchema transition;
  transition.name = "Transition";
  transition.only_in = "StateMachine";
  transition.doc =
      "a way from one State to another; of those that are open the first is taken, "
      "one an update";
  transition.fields = {
      required(object_field("from", "State", "the state that it leaves")),
      required(object_field("to", "State", "the state that it enters")),
      formula_field(
          "when", "the guard, in quotes: a condition of ports, `time`, `period`, `time_in_state`"),
  };
  schema.add(std::move(transition));
}

}  // namespace hookpoint::simulation
