// Expression: a formula of ports as a component, and Input, a port of its own for one name of it.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "language/tree/fields.h"
#include "language/units.h"
#include "simulation/scene/formula_signals.h"

namespace hookpoint::simulation {

using language::FieldSchema;

namespace {

using control::PortDescription;

/// What the formulas of an Expression may name besides ports, in the order of their values.
constexpr std::array expression_words{std::string_view("time"), std::string_view("period"),
                                      std::string_view("previous")};

constexpr language::Dimension second{0, 0, 1, 0};

class Expression final : public control::Component {
 public:
  control::Text formula{*this, "formula",
                        "what is computed: an expression, in quotes, of ports by their trails; "
                        "also of `time` and `period` "
                        "(since the last update) and of `previous`, its own last value"};
  control::Text unit{*this, "unit", "of the value, as \"N.m\"; default: what the formula yields"};
  control::Parameter initial{*this, "initial", "?", 0., "`previous` at the first update"};
  control::Output output{*this, "output", "?", "the formula's value"};
  control::Input in =
      control::Input{*this, "in", "?", "the ports that the formula names, in its order"}.open();

  void start(double) override {
    // A class that nobody has given a formula has the value 0.
    FormulaInputs inputs({expression_words.begin(), expression_words.end()});
    compiled_.emplace(formula.value().empty() ? "0" : formula.value(), inputs);
    values_ = inputs.values_for(in);
  }

  void update(const control::Tick& tick) override {
    const double last = tick.count == 0 ? double{initial} : double{output};
    values_[0] = tick.time;
    values_[1] = tick.period;
    values_[2] = last;
    read_inputs(in, std::span(values_).subspan(expression_words.size()));
    output = (*compiled_)(values_);
  }

 private:
  std::optional<ComponentFormula> compiled_;
  std::vector<double> values_;  ///< of the words, then of the inputs
};

HOOKPOINT_REGISTER_COMPONENT(Expression, "Expression",
                             "output = a formula of ports, with its own last value as `previous`",
                             control::Attachment::none, "in")

class NamedInput final : public control::Component {
 public:
  control::Input input{*this, "input", "?", "what the name stands for"};
  control::Text unit{*this, "unit", "of the value, as \"rad/s\", where the wire's has none"};
  control::Output output{*this, "output", "?", "the same"};
  void update(const control::Tick&) override { output = double{input}; }
};

HOOKPOINT_REGISTER_COMPONENT(NamedInput, "Input",
                             "a name in the formulas of what it stands in: the end of a wire with "
                             "its own rate, delay and noise",
                             control::Attachment::none, "input")

FieldSchema& declared_field(language::ClassSchema& schema, std::string_view name) {
  return *std::ranges::find(schema.fields, name, &FieldSchema::name);
}

std::size_t text_index(const control::ComponentClass& type, std::string_view name) {
  const auto component = type.make();
  return std::ranges::find(component->ports(), name, &PortDescription::name)->first;
}

/// The formula's text, its unit checked.
std::string expression_text(const language::Object& object, std::size_t index, Loading& loading) {
  const auto formula = formula_of(object, "formula", loading);
  if (!formula) return "";
  std::optional<language::Dimension> declared;
  if (object.given("unit")) declared = declared_dimension(object, "unit", loading);
  std::optional<language::Dimension> previous = declared;
  if (!previous && object.given("initial")) previous = object.find("initial")->dimension;
  FormulaLoader loader(object, index,
                       {{expression_words[0], second},
                        {expression_words[1], second},
                        {expression_words[2], previous}},
                       loading);
  const auto unit = loader.add(*formula, object);
  if (unit && declared && unit->dimension && !language::fits(*unit->dimension, *declared)) {
    loading.error(place_of(object, "formula"),
                  fmt::format("the formula is in {}, `unit` says {}",
                              language::describe_dimension(*unit->dimension),
                              language::describe_dimension(*declared)));
  }
  return formula->text;
}

}  // namespace

void describe_formula_class(language::ClassSchema& schema) {
  const bool machine = schema.name == "StateMachine";
  if (schema.name == "Input") schema.top_level = false;
  if (schema.name != "Expression" && !machine) return;
  // What it holds are the values of ports that have names of their own.
  std::erase_if(schema.fields, [](const FieldSchema& field) { return field.name == "in"; });
  schema.default_input.clear();
  if (machine) return describe_state_machine(schema);
  FieldSchema& formula = declared_field(schema, "formula");
  formula.required = true;
  schema.children = {"Input"};
}

void load_formulas(const language::Object& object, const control::ComponentClass& type,
                   std::size_t index, ComponentSpec& spec, Loading& loading) {
  if (type.name == "Expression")
    spec.texts.emplace_back(text_index(type, "formula"), expression_text(object, index, loading));
  if (type.name == "StateMachine")
    spec.texts.emplace_back(text_index(type, "program"),
                            state_machine_program(object, index, loading));
  spec.open_inputs = static_cast<std::size_t>(
      std::ranges::count(loading.formula_inputs, index, &FormulaInput::component));
}

}  // namespace hookpoint::simulation
