// Files, their Params and their Includes.
#include <algorithm>

#include "language/names.h"
#include "language/tree/builder.h"
#include "language/units.h"

namespace hookpoint::language {
namespace {

std::string_view kind_name(ValueKind kind) {
  switch (kind) {
    case ValueKind::number:
      return "a number";
    case ValueKind::boolean:
      return "true or false";
    case ValueKind::text:
      return "a string";
    default:
      return "a word";
  }
}

}  // namespace

void Builder::lay_file(FileScope& scope) {
  report_.order_file(scope.file.source);
  report_.append(scope.file.report);
  if (scope.file.reader != nullptr) return lay_foreign_file(scope);
  // Nothing was read of it: of its Params nothing is known.
  if (scope.file.report.has_errors() && scope.file.syntax.items.empty()) return;
  if (check_arguments(scope)) lay_items(scope, scope.file.syntax.top, true);
}

void Builder::take_parameters(const EvaluateOptions& options, FileScope& scope) {
  for (const auto& [name, value] : options.parameters) {
    const ParsedFile text = files_.override_text(name, value);
    report_.order_file(text.source);
    report_.append(text.report);
    if (text.report.has_errors()) continue;
    const Item& item = text.syntax.items[text.syntax.top.begin];
    const Variables none;
    std::optional<std::vector<Value>> values =
        ExpressionEvaluator(text, none, report_, budget_).evaluate_list(item.value);
    const Position place{&text.source, 0, name.size()};
    Given given{std::move(values).value_or(std::vector<Value>{}), place};
    for (Value& one : given.values) one.from_outside = true;
    scope.given.emplace(name, std::move(given));
  }
}

bool Builder::check_arguments(const FileScope& scope) {
  const Syntax& syntax = scope.file.syntax;
  for (const auto& [name, given] : scope.given) {
    if (find_param(scope.file, name) != nullptr) continue;
    const std::vector<std::string> names = param_names(scope.file);
    report_.error(given.position, "`" + scope.file.source.path + "` has no Param `" + name + "`" +
                                      did_you_mean(name, names));
    const Item* nearest = find_param(scope.file, nearest_name(name, names));
    if (nearest != nullptr) report_.note(position(scope, nearest->name), "the Param is here");
  }
  bool complete = true;
  for (std::uint32_t i = syntax.top.begin; i < syntax.top.end; ++i) {
    const Item& item = syntax.items[i];
    if (item.kind != ItemKind::param || !item.value.empty()) continue;
    const std::string name(evaluator(scope).text(item.name));
    const Position place = position(scope, item.name);
    if (scope.given.contains(name)) continue;
    complete = false;
    if (scope.includer == nullptr) {
      report_.error(place, "the Param `" + name +
                               "` has no value: give it a default, or set it with --set " + name +
                               "=VALUE");
    } else {
      report_.error(scope.place, "the argument `" + name + "` is missing");
      report_.note(place, "the Param is here, without a default");
    }
  }
  return complete;
}

void Builder::lay_param(FileScope& scope, const Item& item, bool top_of_file) {
  const std::string_view name = evaluator(scope).text(item.name);
  const Position place = position(scope, item.name);
  if (!top_of_file)
    return report_.error(place,
                         "a Param stands at the top of its file, not inside an object or a loop");
  std::optional<std::vector<Value>> values;
  if (!item.value.empty()) values = evaluator(scope).evaluate_list(item.value);
  const auto given = scope.given.find(std::string(name));
  if (given != scope.given.end()) {
    const bool good = !values || check_argument(given->second, *values, item, scope);
    values = good ? given->second.values : std::vector<Value>{};
  }
  const bool one_number =
      values && values->size() == 1 && values->front().kind == ValueKind::number;
  if (scope.includer == nullptr && one_number)
    open_.front().object->parameters.push_back(
        {std::string(name), values->front().quantity.value, values->front().quantity.dimension});
  define(scope, name, std::move(values).value_or(std::vector<Value>{}), place);
}

bool Builder::check_argument(Given& given, const std::vector<Value>& defaults, const Item& item,
                             const FileScope& scope) {
  for (std::size_t i = 0; i < given.values.size() && !defaults.empty(); ++i) {
    Value& value = given.values[i];
    const Value& example = defaults[std::min(i, defaults.size() - 1)];
    const Dimension &dimension = value.quantity.dimension, &wanted = example.quantity.dimension;
    std::string message;
    if (value.kind != example.kind) {
      message = std::string(kind_name(example.kind)) + ", not " + describe_value(value);
    } else if (value.kind == ValueKind::number && !wanted.dimensionless() &&
               !fits(dimension, wanted)) {
      message = "a value in " + unit_text(wanted) + ", not in " + unit_text(dimension);
    }
    if (!message.empty()) {
      const std::string name(evaluator(scope).text(item.name));
      report_.error(given.position, "the argument `" + name + "` takes " + message);
      report_.note(position(scope, item.name), "the Param is here");
      return false;
    }
    // A number without a unit takes that of the default, as a field's would.
    if (dimension.dimensionless()) value.quantity.dimension = wanted;
  }
  return true;
}

void Builder::lay_include(FileScope& scope, const Item& item) {
  // Looking for a file asks the operating system several times.
  constexpr std::size_t steps_of_a_search = 500;
  if (!take(Resource::steps, steps_of_a_search, position(scope, item.place))) return;
  const ParsedFile* file = find_include(scope, item);
  if (file == nullptr) return;
  FileScope inner{*file, &scope, position(scope, item.place), {}, {}, !item.value.empty()};
  take_arguments(scope, item, inner);
  report_.enter_include(file->source, inner.place);
  if (item.name.length == 0) {
    lay_file(inner);
  } else {
    lay_group(scope, item, inner);
  }
  report_.leave_include();
}

void Builder::lay_group(const FileScope& scope, const Item& item, FileScope& inner) {
  const Expression index =
      item.indexed ? scope.file.syntax.details[item.detail].index : Expression{};
  const std::optional<std::string> name =
      evaluator(scope).name_text(item.name, item.indexed, index);
  const ClassSchema& group = *schema_.schema().find("Group");
  const Position place = position(scope, item.name);
  if (!name || open_object(group, *name, place, place) == nullptr) return;
  lay_file(inner);
  close_object();
}

const ParsedFile* Builder::find_include(const FileScope& scope, const Item& item) {
  const std::filesystem::path found = include_path(scope, item);
  if (found.empty()) return nullptr;
  const Position place = position(scope, scope.file.syntax.details[item.detail].path);
  const ParsedFile& file = files_.load(found);
  for (const FileScope* open = &scope; open != nullptr; open = open->includer) {
    if (&open->file != &file) continue;
    report_.error(place, "`" + file.source.path + "` includes itself");
    return nullptr;
  }
  return &file;
}

std::filesystem::path Builder::include_path(const FileScope& scope, const Item& item) {
  if (item.value.empty()) return find_named(files_, scope.file, item, report_);
  const Expression& path = scope.file.syntax.expressions[item.value.begin];
  const std::optional<Value> value = evaluator(scope).evaluate(path);
  if (!value) return {};
  const Position place = position(scope, path.span);
  if (value->kind == ValueKind::text)
    return find_named(files_, scope.file, value->text, place, report_);
  report_.error(place,
                "an Include takes the path of a file, a string in quotes or a Param that "
                "holds one, not " +
                    describe_value(*value));
  return {};
}

void Builder::lay_plugin(const FileScope& scope, const Item& item, bool top_of_file) {
  const Position place = position(scope, item.place);
  if (!top_of_file)
    return report_.error(place,
                         "a Plugin stands at the top of its file, not inside an object or a loop");
  for (const FileScope* open = &scope; open != nullptr; open = open->includer) {
    if (open->chosen)
      return report_.error(place,
                           "a Plugin stands in no file whose Include has its path from a value: "
                           "name the plugin in the file that has the Include");
  }
  const std::filesystem::path found = find_named(files_, scope.file, item, report_);
  if (found.empty()) return;
  std::vector<std::string>& plugins = open_.front().object->plugins;
  const std::string library = std::filesystem::absolute(found).lexically_normal().string();
  if (std::ranges::find(plugins, library) == plugins.end()) plugins.push_back(library);
}

void Builder::take_arguments(const FileScope& scope, const Item& item, FileScope& inner) {
  const Syntax& syntax = scope.file.syntax;
  const Range arguments = syntax.details[item.detail].arguments;
  for (std::uint32_t i = arguments.begin; i < arguments.end; ++i) {
    const Argument& argument = syntax.arguments[i];
    const ExpressionEvaluator evaluate = evaluator(scope);
    const std::string name(evaluate.text(argument.name));
    const Position place = position(scope, argument.name);
    std::optional<std::vector<Value>> values = evaluate.evaluate_list(argument.value);
    const bool added =
        inner.given.emplace(name, Given{std::move(values).value_or(std::vector<Value>{}), place})
            .second;
    if (!added) report_.error(place, "the argument `" + name + "` is given twice");
  }
}

}  // namespace hookpoint::language
