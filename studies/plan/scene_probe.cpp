#include "studies/plan/scene_probe.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/names.h"
#include "language/units.h"

namespace hookpoint::studies {
namespace {

std::optional<language::Dimension> unit_dimension(const language::Target& target) {
  const std::string& unit = target.object->unit_of(*target.field);
  const auto parsed = unit == "?" ? std::nullopt : language::parse_unit(unit);
  return parsed ? std::optional(parsed->dimension) : std::nullopt;
}

}  // namespace

SceneNames::SceneNames(const language::Object& tree)
    : tree_(tree), trails_(simulation::trails_of(tree)) {
  const auto worlds = tree.children_of("World");
  if (!worlds.empty()) world_ = worlds.front();
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

std::optional<SceneNumber> SceneNames::number(const std::string& name, std::string& why) {
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
  const auto target = resolve(name, why);
  if (!target) return std::nullopt;
  const language::Field* field =
      target->field == nullptr ? nullptr : target->object->find(target->field->name);
  const auto part = static_cast<std::size_t>(std::max(target->part, 0));
  const bool number = field != nullptr && part < field->numbers.size() &&
                      (target->part >= 0 || field->numbers.size() == 1);
  if (number) return SceneNumber{field->numbers[part], unit_dimension(*target)};
  why = fmt::format("`{}` is no number that the scene's file holds", name);
  return std::nullopt;
}

}  // namespace hookpoint::studies
