#include "simulation/scene/formula_signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "language/units.h"
#include "language/wording.h"

namespace hookpoint::simulation {

std::size_t FormulaInputs::place(const std::string& name) {
  const auto word = std::ranges::find(words_, std::string_view(name));
  if (word != words_.end()) return static_cast<std::size_t>(word - words_.begin());
  return words_.size() + places_.emplace(name, places_.size()).first->second;
}

std::vector<double> FormulaInputs::values_for(const control::Input& in) const {
  if (in.count() < size()) throw std::logic_error("a formula reads more than it is given");
  return std::vector<double>(words_.size() + size());
}

void read_inputs(const control::Input& in, std::span<double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = in[i];
}

namespace {

std::unique_ptr<language::Formula> read_again(const std::string& text) {
  auto formula = language::read_formula(text);
  if (!formula) throw std::runtime_error("'" + text + "' is no formula");
  return std::make_unique<language::Formula>(std::move(*formula));
}

/// What stands before the formula where it is parsed: as a field of its own.
constexpr std::string_view before_formula = "formula = ";

}  // namespace

std::optional<language::Formula> formula_of(const language::Object& object, std::string_view field,
                                            Loading& loading) {
  const language::Position& quoted = place_of(object, field);
  const std::string& text = object.word(field);
  const language::SourceFile source = language::source_file("", std::string(before_formula) + text);
  language::ParsedFile file{source};
  language::parse_override(file);
  // A place in the text is one in the file, behind the quote; with an escape before it the field.
  const bool verbatim = quoted.file != nullptr && quoted.length == text.size() + 2;
  const auto place_in_file = [&](const language::Position& place) {
    if (!verbatim || place.offset < before_formula.size()) return quoted;
    return language::Position{quoted.file, quoted.offset + 1 + place.offset - before_formula.size(),
                              place.length};
  };
  language::Report report;
  report.append(file.report);
  std::optional<language::Formula> formula;
  if (!report.has_errors()) {
    const language::Range value = file.syntax.items[file.syntax.top.begin].value;
    const language::Variables none;
    language::Budget budget;
    const language::ExpressionEvaluator evaluator(file, none, report, budget);
    if (value.size() == 1) {
      formula = language::make_formula_of(evaluator, file.syntax.expressions[value.begin], report);
    } else {
      loading.error(quoted, fmt::format("`{}` takes one formula, not {}", field, value.size()));
    }
  }
  language::Diagnostics found;
  report.deliver(found);
  for (const language::Diagnostic& diagnostic : found.all())
    loading.error(place_in_file(diagnostic.position), diagnostic.message);
  if (!formula) return std::nullopt;
  for (language::FormulaNode& node : formula->nodes) node.place = place_in_file(node.place);
  for (language::Position& place : formula->places) place = place_in_file(place);
  formula->position = quoted;
  return formula;
}

ComponentFormula::ComponentFormula(const std::string& text, FormulaInputs& inputs)
    : formula_(read_again(text)), evaluator_(*formula_), names_(formula_->names.size()) {
  for (const std::string& name : formula_->names) places_.push_back(inputs.place(name));
}

double ComponentFormula::operator()(std::span<const double> values) {
  for (std::size_t i = 0; i < places_.size(); ++i) names_[i] = values[places_[i]];
  return evaluator_(names_);
}

namespace {

std::vector<std::string_view> names_of(const std::vector<FormulaWord>& words) {
  std::vector<std::string_view> names;
  for (const FormulaWord& word : words) names.push_back(word.name);
  return names;
}

}  // namespace

FormulaLoader::FormulaLoader(const language::Object& object, std::size_t index,
                             std::vector<FormulaWord> words, Loading& loading)
    : object_(object),
      index_(index),
      words_(std::move(words)),
      loading_(loading),
      inputs_(names_of(words_)) {}

std::optional<language::FormulaUnit> FormulaLoader::add(const language::Formula& formula,
                                                        const language::Object& scope) {
  std::vector<std::optional<language::Dimension>> dimensions(formula.names.size());
  bool good = true;
  for (std::size_t i = 0; i < formula.names.size(); ++i) {
    // All that is wrong with the names is told at once.
    const bool known = resolve(formula.names[i], formula.places[i], scope, dimensions[i]);
    good = good && known;
  }
  return good ? language::unit_of(formula, dimensions, loading_.diagnostics) : std::nullopt;
}

bool FormulaLoader::resolve(const std::string& name, const language::Position& place,
                            const language::Object& scope,
                            std::optional<language::Dimension>& dimension) {
  const std::size_t count = inputs_.size(), at = inputs_.place(name);
  if (at < inputs_.word_count()) {
    dimension = words_[at].dimension;
    return true;
  }
  language::Unresolved why;
  const auto reached = loading_.names.resolve(scope, name, true, why);
  // An object alone stands for the port that a wire from it would read.
  const bool whole_object =
      reached && reached->field == nullptr && !reached->object->schema->default_output.empty();
  const std::string trail =
      whole_object ? name + "." + reached->object->schema->default_output : name;
  const auto port = find_number(scope, trail, place, loading_.names, loading_);
  if (!port) return false;
  const language::Target& target = port->target;
  if (target.part < 0 && components_of(*target.field) > 1) {
    loading_.error(place, fmt::format("`{}` holds {} numbers; a formula takes one, such as `{}{}`",
                                      name, components_of(*target.field), name,
                                      language::part_name(*target.field, 0)));
    return false;
  }
  dimension = dimension_of_port(*target.object, *target.field);
  if (at - inputs_.word_count() < count) return true;  // an earlier formula has it
  loading_.formula_inputs.push_back(
      {index_, at - inputs_.word_count(), {name, target.object, target.port, place}});
  return true;
}

std::optional<language::Dimension> dimension_of_port(const language::Object& object,
                                                     const language::FieldSchema& field) {
  std::string unit = object.unit_of(field);
  const bool declares = object.schema->find("unit") != nullptr && object.given("unit") &&
                        field.name == object.schema->default_output;
  if (declares) unit = object.word("unit");
  if (unit == "?") return std::nullopt;
  const auto parsed = language::parse_unit(unit);
  return parsed ? std::optional(parsed->dimension) : std::nullopt;
}

std::optional<language::Dimension> declared_dimension(const language::Object& object,
                                                      std::string_view field, Loading& loading) {
  const auto parsed = language::parse_unit(object.word(field));
  if (parsed && parsed->numerator == 1. && parsed->denominator == 1.) return parsed->dimension;
  loading.error(place_of(object, field),
                parsed ? fmt::format("`{}` takes a unit of the SI without a prefix, such as \"{}\"",
                                     field, language::unit_text(parsed->dimension))
                       : fmt::format("\"{}\" is no unit, as \"N.m/rad\" is", object.word(field)));
  return std::nullopt;
}

}  // namespace hookpoint::simulation
