#include "studies/measure/scene_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "language/names.h"
#include "language/syntax/syntax.h"
#include "language/units.h"
#include "simulation/experiment/material_fields.h"
#include "simulation/scene/load.h"

namespace hookpoint::studies {
namespace {

std::optional<language::Dimension> unit_dimension(const language::Target& target) {
  const std::string& unit = target.object->unit_of(*target.field);
  const auto parsed = unit == "?" ? std::nullopt : language::parse_unit(unit);
  return parsed ? std::optional(parsed->dimension) : std::nullopt;
}

/// How the names of a formula are used.
struct NameUse {
  bool as_number = false, as_word = false;
};

std::vector<NameUse> uses_of(const language::Formula& formula,
                             const std::function<bool(const std::string&)>& holds_word) {
  using Op = language::FormulaOperation;
  std::vector<NameUse> uses(formula.names.size());
  const auto node_of = [&](const language::FormulaNode& node,
                           std::uint32_t operand) -> const auto& {
    return formula.nodes[formula.operands[node.operands.begin + operand]];
  };
  for (const language::FormulaNode& node : formula.nodes) {
    bool words = false;
    const bool compares =
        node.sign == language::Operator::equal || node.sign == language::Operator::not_equal;
    if (node.operation == Op::apply && compares) {
      const auto &one = node_of(node, 0), &other = node_of(node, 1);
      words = one.operation == Op::name && other.operation == Op::name &&
              (holds_word(formula.names[one.name]) || holds_word(formula.names[other.name]));
    }
    for (std::uint32_t i = 0; i < node.operands.size(); ++i) {
      const language::FormulaNode& operand = node_of(node, i);
      if (operand.operation == Op::name)
        (words ? uses[operand.name].as_word : uses[operand.name].as_number) = true;
    }
  }
  const language::FormulaNode& whole = formula.nodes.back();
  if (whole.operation == Op::name) uses[whole.name].as_number = true;
  return uses;
}

}  // namespace

bool is_string(std::string_view text) {
  return text.size() >= 2 && text.front() == '"' && text.find('"', 1) == text.size() - 1;
}

SceneNames::SceneNames(const language::Object& tree, std::map<std::string, std::string> words,
                       const simulation::Experiment* experiment)
    : tree_(tree),
      words_(std::move(words)),
      experiment_(experiment),
      trails_(simulation::trails_of(tree)) {
  const auto worlds = tree.children_of("World");
  if (worlds.empty()) return;
  world_ = worlds.front();
  // A choice of the World, such as its engine and its contact law, is a word of every run.
  for (const language::FieldSchema& choice : world_->schema->fields) {
    if (choice.type != language::FieldType::choice) continue;
    const language::Field* field = world_->find(choice.name);
    const bool is_param =
        std::ranges::find(tree.parameters, choice.name, &language::ParameterValue::name) !=
        tree.parameters.end();
    if (field != nullptr && !field->words.empty() && !is_param)
      words_.try_emplace(choice.name, field->words[0]);
  }
}

std::optional<language::Target> SceneNames::resolve(const std::string& trail, std::string& why) {
  language::Unresolved unresolved;
  const language::Object& from = world_ != nullptr ? *world_ : tree_;
  auto target = names_.resolve(from, trail, true, unresolved);
  if (!target) why = unresolved.message;
  return target;
}

std::optional<ScenePort> SceneNames::port(const std::string& trail, std::string& why,
                                          const simulation::Experiment* experiment) {
  if (is_string(trail)) {
    why = trail + " is a string, no number of a run";
    return std::nullopt;
  }
  const auto target = resolve(trail, why);
  if (!target) return std::nullopt;
  const auto object = trails_.find(target->object);
  if (target->field == nullptr || !simulation::is_number(*target->field) ||
      object == trails_.end()) {
    why = fmt::format("`{}` is no number of a run", trail);
    return std::nullopt;
  }
  const int count = target->part < 0 ? simulation::components_of(*target->field) : 1;
  if (count > 1) {
    why = fmt::format("`{}` holds {} numbers; take one, such as `{}{}`", trail, count, trail,
                      language::part_name(*target->field, 0));
    return std::nullopt;
  }
  ScenePort port{object->second + "." + target->port, unit_dimension(*target), ""};
  if (experiment != nullptr)
    port.missing = simulation::missing_port(*experiment, *target->object, *target->field);
  return port;
}

std::vector<std::optional<SceneNumber>> SceneNames::numbers(
    const language::Formula& formula,
    const std::function<void(std::size_t, const std::string&)>& wrong) {
  const auto uses = uses_of(formula, [this](const std::string& name) { return holds_word(name); });
  std::vector<std::optional<SceneNumber>> found;
  for (std::size_t i = 0; i < formula.names.size(); ++i) {
    const std::string& name = formula.names[i];
    std::string why;
    found.push_back(uses[i].as_number ? number(name, why) : word(name, why));
    if (found.back() && uses[i].as_number && uses[i].as_word) {
      found.back().reset();
      why = fmt::format("`{}` is a number, and compared with a word", name);
    }
    if (!found.back() && wrong) wrong(i, why);
  }
  return found;
}

void SceneNames::expect_words(std::vector<std::string> words) {
  for (const auto& [name, word] : words_) words.push_back(word);
  expected_ = std::move(words);
}

bool SceneNames::holds_word(const std::string& name) const {
  return is_string(name) || words_.contains(name);
}

std::string SceneNames::with_word(const std::string& name) const {
  const std::size_t end = name.find('.');
  const auto held = words_.find(name.substr(0, end));
  return end == std::string::npos || held == words_.end() ? name : held->second + name.substr(end);
}

std::optional<SceneNumber> SceneNames::word(const std::string& name, std::string& why) {
  const auto held = words_.find(name);
  const std::string text = is_string(name)        ? language::unquote(name)
                           : held != words_.end() ? held->second
                                                  : name;
  const bool number = std::ranges::find(tree_.parameters, name, &language::ParameterValue::name) !=
                      tree_.parameters.end();
  if (number && held == words_.end()) {
    why = fmt::format("`{}` is a number, and compared with a word", name);
    return std::nullopt;
  }
  std::string no_object;
  if (expected_ && std::ranges::find(*expected_, text) == expected_->end() &&
      !resolve(text, no_object)) {
    why = fmt::format("`{}` is no word of a Sweep, a Fix or a Param, nor an object of the scene{}",
                      text, language::did_you_mean(text, *expected_));
    return std::nullopt;
  }
  auto place = std::ranges::find(compared_, text);
  if (place == compared_.end()) place = compared_.insert(place, text);
  return SceneNumber{static_cast<double>(place - compared_.begin()), language::Dimension{}};
}

std::optional<double> SceneNames::loaded_constant(const language::Target& target) {
  if (target.object->type != "Material" || target.field == nullptr) return std::nullopt;
  if (experiment_ == nullptr) {
    language::Diagnostics unreported;
    loaded_ = simulation::load_experiment(tree_, unreported);
    if (!loaded_) return std::nullopt;
    experiment_ = &*loaded_;
  }
  const auto constants = simulation::material_fields();
  const auto constant = std::ranges::find_if(
      constants, [&](const auto& each) { return each.name == target.field->name; });
  const auto material = std::ranges::find(experiment_->materials, target.object->name,
                                          &simulation::MaterialSpec::name);
  if (constant == constants.end() || material == experiment_->materials.end()) return std::nullopt;
  return material->constants.*(constant->member);
}

std::optional<SceneNumber> SceneNames::number(const std::string& name, std::string& why) {
  if (holds_word(name)) {
    why = is_string(name) ? name + " is a string, no number"
                          : fmt::format(
                                "`{}` holds the word `{}`, which is no number: compare it "
                                "with another word, or take a field, such as `{}.FIELD`",
                                name, words_.at(name), name);
    return std::nullopt;
  }
  const auto parameter = std::ranges::find(tree_.parameters, name, &language::ParameterValue::name);
  if (parameter != tree_.parameters.end())
    return SceneNumber{parameter->value, parameter->dimension};
  if (name.find('.') == std::string::npos) {
    std::vector<std::string> known;
    for (const language::ParameterValue& value : tree_.parameters) known.push_back(value.name);
    why = fmt::format("no Param of the scene that is a number is called `{}`{}", name,
                      language::did_you_mean(name, known));
    return std::nullopt;
  }
  const auto target = resolve(with_word(name), why);
  if (!target) return std::nullopt;
  const language::Field* field =
      target->field == nullptr ? nullptr : target->object->find(target->field->name);
  const auto part = static_cast<std::size_t>(std::max(target->part, 0));
  const bool number = field != nullptr && part < field->numbers.size() &&
                      (target->part >= 0 || field->numbers.size() == 1);
  if (number) return SceneNumber{field->numbers[part], unit_dimension(*target)};
  if (const auto constant = loaded_constant(*target); constant && field == nullptr)
    return SceneNumber{*constant, unit_dimension(*target)};
  why = fmt::format("`{}` is no number that the scene's file holds", name);
  return std::nullopt;
}

}  // namespace hookpoint::studies
