#include "language/tree/builder.h"

#include <algorithm>

#include "language/names.h"
#include "language/schema/absent.h"
#include "language/tree/field.h"
#include "language/units.h"
#include "language/wording.h"

namespace hookpoint::language {

std::unique_ptr<Object> Builder::build(const ParsedFile& file, const EvaluateOptions& options) {
  static const ClassSchema top;
  auto root = std::make_unique<Object>();
  root->schema = &top;
  root->position = {&file.source, 0, 1};
  open_.push_back({root.get(), {}});
  FileScope scope{file, nullptr, {}, {}, {}};
  take_parameters(options, scope);
  lay_file(scope);
  if (root->children.empty() && !report_.has_errors()) {
    report_.error(root->position, "the file describes nothing: expected at least one object");
  }
  lay_implicit_objects();
  return root;
}

void Builder::lay_implicit_objects() {
  for (const auto& [name, schema] : schema_.schema().classes()) {
    if (!schema.implicit || !open_.front().object->children_of(name).empty()) continue;
    Object* object =
        open_object(schema, schema.default_name.empty() ? name : schema.default_name, {}, {});
    if (object == nullptr) return;
    object->implicit = true;
    object->named = false;
    close_object();
  }
}

void Builder::lay_items(FileScope& scope, Range items, bool top_of_file) {
  std::vector<std::string_view> defined;
  for (std::uint32_t i = items.begin; i < items.end && !stopped(); ++i) {
    const Item& item = scope.file.syntax.items[i];
    if (item.kind == ItemKind::let) defined.push_back(evaluator(scope).text(item.name));
    if (!take(Resource::steps, 2, position(scope, item.place))) return;
    lay_item(scope, item, top_of_file);
  }
  // A block's variables end with it.
  for (const std::string_view name : defined) scope.variables.erase(name);
}

void Builder::lay_item(FileScope& scope, const Item& item, bool top_of_file) {
  switch (item.kind) {
    case ItemKind::object:
      return lay_object(scope, item);
    case ItemKind::assignment:
      return lay_assignment(scope, item);
    case ItemKind::wire:
      return lay_wire(scope, item);
    case ItemKind::param:
      return lay_param(scope, item, top_of_file);
    case ItemKind::let:
      return lay_let(scope, item);
    case ItemKind::include:
      return lay_include(scope, item);
    case ItemKind::plugin:
      return lay_plugin(scope, item, top_of_file);
    case ItemKind::for_loop:
      return lay_loop(scope, item);
  }
}

void Builder::lay_object(FileScope& scope, const Item& item) {
  const ClassSchema* schema = class_of(scope, item);
  if (schema == nullptr) return leave_out(scope, item);
  const Position place = position(scope, item.place);
  std::string name;
  if (item.name.length > 0) {
    const Expression index =
        item.indexed ? scope.file.syntax.details[item.detail].index : Expression{};
    const std::optional<std::string> text =
        evaluator(scope).name_text(item.name, item.indexed, index);
    if (!text) return leave_out(scope, item);
    hint_at_value(scope, evaluator(scope).text(item.name), position(scope, item.name));
    name = *text;
    if (schema->naming == Naming::forbidden)
      report_.error(position(scope, item.name), with_article(schema->name) + " has no name");
  } else if (schema->naming == Naming::required) {
    report_.error(place,
                  with_article(schema->name) + " needs a name: " + schema->name + " NAME { ... }");
  }
  if (open_object(*schema, std::move(name), place, position(scope, item.name)) == nullptr) return;
  lay_items(scope, item.items, false);
  close_object();
}

void Builder::leave_out(const FileScope& scope, const Item& item) {
  if (!take(Resource::steps, 1, position(scope, item.place))) return;
  const ExpressionEvaluator evaluate = evaluator(scope);
  if (item.name.length > 0) left_out_.emplace(evaluate.text(item.name));
  for (std::uint32_t i = item.items.begin; i < item.items.end; ++i)
    leave_out(scope, scope.file.syntax.items[i]);
}

const ClassSchema* Builder::class_of(const FileScope& scope, const Item& item) {
  const std::string name(evaluator(scope).text(item.place));
  const ClassSchema* schema = schema_.schema().find(name, owner().type);
  const Position place = position(scope, item.place);
  if (schema == nullptr) {
    if (report_.told_at(place)) return nullptr;
    const bool field = owner().schema->find(name) != nullptr;
    const std::string instead(instead_of("", name));
    report_.error(place, field ? "`" + name + "` is a field of " + owner().type + ": expected `" +
                                     name + " = ...;`"
                         : instead.empty() ? "unknown class `" + name + "`" +
                                                 did_you_mean(name, schema_.class_names())
                                           : "there is no class `" + name + "`: " + instead);
    return nullptr;
  }
  if (schema->name != "Group") check_place(*schema, place);
  return schema;
}

bool Builder::check_place(const ClassSchema& schema, const Position& place) {
  const Object& around = owner();
  const auto allowed = [&schema](const ClassSchema& parent) {
    return std::ranges::any_of(parent.children, [&schema](const std::string& child) {
      return child == schema.name || (child.ends_with('.') && schema.name.starts_with(child));
    });
  };
  const bool top = around.parent == nullptr;
  if (top ? schema.top_level : allowed(*around.schema)) return true;
  std::vector<std::string> places;
  for (const auto& [name, candidate] : schema_.schema().classes()) {
    if (allowed(candidate)) places.push_back(name);
  }
  if (schema.top_level) places.insert(places.begin(), "the top of a file");
  const std::string here = top ? "at the top of a file" : "inside " + around.type;
  report_.error(place, with_article(schema.name) + " cannot stand " + here + "; expected " +
                           join(places, ", "));
  return false;
}

Object* Builder::open_object(const ClassSchema& schema, std::string name, const Position& place,
                             const Position& name_place) {
  constexpr std::size_t deepest = 200;
  if (!take(Resource::objects, 1, place)) return nullptr;
  if (open_.size() > deepest) {
    report_.error(place, "objects are nested deeper than " + std::to_string(deepest) + " levels");
    too_deep_ = true;
    return nullptr;
  }
  Open& around = open_.back();
  auto object = std::make_unique<Object>();
  object->schema = &schema;
  object->type = schema.name;
  object->named = !name.empty();
  object->name = schema.default_name;
  if (object->named) object->name = std::move(name);
  object->position = place;
  object->parent = around.object;
  object->defaults = &schema_.of(schema).defaults;
  Object* added = object.get();
  if (!added->name.empty()) {
    const std::string key = schema.names_a_subject ? schema.name + " " + added->name : added->name;
    const auto [entry, is_new] = around.names.emplace(key, added);
    if (!is_new) {
      report_.error(added->named ? name_place : place, "the name `" + added->name + "` is taken");
      report_.note(entry->second->position, "`" + added->name + "` is this " + entry->second->type);
      hints_.explain(name_place, report_);
    }
  }
  around.object->children.push_back(std::move(object));
  open_.push_back({added, {}});
  return added;
}

Object& Builder::owner() const {
  const auto found = std::find_if(open_.rbegin(), open_.rend(),
                                  [](const Open& open) { return open.object->type != "Group"; });
  return *found->object;
}

void Builder::lay_assignment(FileScope& scope, const Item& item) {
  Object& object = owner();
  if (object.parent == nullptr) {
    const std::string name(evaluator(scope).text(item.place));
    report_.error(position(scope, item.place),
                  "`" + name + "` stands in no object; a variable is `Let " + name + " = ...;`");
    return;
  }
  add_field(scope, *object.schema, item, object.fields);
}

void Builder::add_field(const FileScope& scope, const ClassSchema& schema, const Item& item,
                        std::vector<Field>& fields) {
  const ExpressionEvaluator evaluate = evaluator(scope);
  for (std::uint32_t i = item.value.begin; i < item.value.end && !scope.copied.empty(); ++i) {
    const Expression& expression = scope.file.syntax.expressions[i];
    if (const Trail* trail = evaluate.lone_trail(expression))
      hint_at_values(scope, *trail, position(scope, expression.span));
  }
  add_field(schema, std::string(evaluate.text(item.place)), position(scope, item.place), fields,
            [&](const FieldSchema& field) {
              return make_field(schema_.context(schema, field, evaluate, report_), item.value);
            });
}

void Builder::add_field(const ClassSchema& schema, const std::string& name, const Position& place,
                        std::vector<Field>& fields,
                        const std::function<std::optional<Field>(const FieldSchema&)>& make) {
  const FieldSchema* field = schema.find(name);
  if (field == nullptr) {
    if (report_.told_at(place)) return;
    std::vector<std::string> names;
    for (const FieldSchema& candidate : schema.fields) {
      if (candidate.setting) names.push_back(candidate.name);
    }
    const std::string instead(instead_of(schema.name, name));
    std::string hint = instead.empty() ? did_you_mean(name, names) : ": " + instead;
    if (hint.empty() && !names.empty()) hint = "; its fields are " + join(names, ", ");
    return report_.error(place, with_article(schema.name) + " has no field `" + name + "`" + hint);
  }
  if (!field->setting)
    return report_.error(
        place, "`" + name + "` of " + schema.name + " is a port: it can be wired, not set");
  const auto order = [](const Field& given) { return given.schema; };
  const auto at = std::ranges::lower_bound(fields, field, {}, order);
  if (at != fields.end() && at->schema == field) {
    report_.error(place, "`" + name + "` is given twice");
    report_.note(at->position, "first given here");
    return;
  }
  std::optional<Field> made = make(*field);
  if (!made) {
    // It stays as an empty shell, so that a wrong value is not called missing as well.
    made.emplace().schema = field;
    made->position = place;
  }
  made->given = true;
  fields.insert(at, std::move(*made));
}

void Builder::lay_wire(FileScope& scope, const Item& item) {
  const ExpressionEvaluator evaluate = evaluator(scope);
  const Detail& detail = scope.file.syntax.details[item.detail];
  Wire wire;
  wire.position = position(scope, item.place);
  if (!take(Resource::objects, 1, wire.position)) return;
  const auto take_end = [&](bool has, const Trail& trail, std::optional<Reference>& end) {
    if (!has) return true;
    const std::optional<std::string> text = evaluate.trail_text(trail);
    hint_at_values(scope, trail, position(scope, trail.span));
    if (text) end = Reference{*text, nullptr, "", position(scope, trail.span)};
    return text.has_value();
  };
  const bool good = take_end(detail.has_from, detail.from, wire.from) &&
                    take_end(detail.has_to, detail.to, wire.to);
  const ClassSchema& schema = *schema_.schema().find("Wire");
  for (std::uint32_t i = item.items.begin; i < item.items.end; ++i) {
    const Item& inner = scope.file.syntax.items[i];
    if (inner.kind == ItemKind::assignment) {
      add_field(scope, schema, inner, wire.fields);
    } else {
      report_.error(position(scope, inner.place), "a wire holds only rate, delay and noise");
    }
  }
  if (good) open_.back().object->wires.push_back(std::move(wire));
}

bool Builder::define(FileScope& scope, std::string_view name, std::vector<Value> values,
                     const Position& place) {
  const auto [entry, added] = scope.variables.try_emplace(name, Variable{std::move(values), place});
  if (added && name != "pi") return true;
  report_.error(place, name == "pi"
                           ? "`pi` is a constant"
                           : "the variable `" + std::string(name) + "` is defined already");
  if (!added) report_.note(entry->second.position, "defined here");
  return false;
}

void Builder::lay_let(FileScope& scope, const Item& item) {
  const ExpressionEvaluator evaluate = evaluator(scope);
  std::optional<std::vector<Value>> values = evaluate.evaluate_list(item.value);
  define(scope, evaluate.text(item.name), std::move(values).value_or(std::vector<Value>{}),
         position(scope, item.name));
}

void Builder::lay_loop(FileScope& scope, const Item& item) {
  if (!item.value.empty()) return lay_loop_over_list(scope, item);
  const ExpressionEvaluator evaluate = evaluator(scope);
  const Detail& detail = scope.file.syntax.details[item.detail];
  const std::optional<long> first = evaluate.evaluate_integer(detail.first, "the range of For");
  const std::optional<long> last = evaluate.evaluate_integer(detail.last, "the range of For");
  if (!first || !last) return;
  constexpr long longest = 1'000'000;
  if (*last - *first >= longest) {
    return report_.error(position(scope, detail.last.span),
                         "For goes through more than " + std::to_string(longest) + " values");
  }
  const Position place = position(scope, item.name);
  for (long i = *first; i <= *last && !stopped(); ++i) {
    Value value;
    value.quantity.value = static_cast<double>(i);
    value.position = place;
    if (!lay_round(scope, item, std::move(value))) return;
  }
}

void Builder::lay_loop_over_list(FileScope& scope, const Item& item) {
  std::optional<std::vector<Value>> values = evaluator(scope).evaluate_list(item.value);
  if (!values) return;
  for (Value& value : *values) {
    if (value.kind == ValueKind::word && value.text.find('.') != std::string::npos) {
      return report_.error(value.position, "For goes through single words: `" + value.text +
                                               "` is a trail; name its last part, and write the "
                                               "rest inside the loop");
    }
  }
  for (Value& value : *values)
    if (stopped() || !lay_round(scope, item, std::move(value))) return;
}

void Builder::hint_at_value(const FileScope& scope, std::string_view name, const Position& place) {
  const auto loop = scope.copied.find(name);
  if (loop == scope.copied.end()) return;
  const std::string from = '`' + std::string(loop->second.from) + '`';
  const Value& value = scope.variables.at(name).values[0];
  const std::string unit = unit_text(value.quantity.dimension);
  const std::string held = value.kind == ValueKind::number ? rounded_text(value.quantity.value) +
                                                                 (unit.empty() ? "" : " ") + unit
                                                           : describe_value(value);
  hints_.add(place, loop->second.place,
             "`" + std::string(name) + "` holds " + held + ", not the word " + from + ": " + from +
                 " is a variable of this file, whose value stands in the list; give the variable "
                 "another name");
}

void Builder::hint_at_values(const FileScope& scope, const Trail& trail, const Position& place) {
  for (std::uint32_t i = trail.parts.begin; i < trail.parts.end && !scope.copied.empty(); ++i)
    hint_at_value(scope, evaluator(scope).text(scope.file.syntax.parts[i].name), place);
}

bool Builder::lay_round(FileScope& scope, const Item& item, Value value) {
  const std::string_view name = evaluator(scope).text(item.name);
  const Position place = position(scope, item.name);
  constexpr std::size_t steps_of_a_round = 10;
  if (!take(Resource::steps, steps_of_a_round, place)) return false;
  const bool word = value.kind == ValueKind::word;
  const Position written = value.position;
  if (!define(scope, name, {std::move(value)}, place)) return false;
  scope.variables[name].stands_for_word = word;
  if (!word && written.file == &scope.file.source) {
    const std::string_view source =
        std::string_view(scope.file.source.text).substr(written.offset, written.length);
    if (scope.variables.contains(source) && source != name) scope.copied[name] = {source, written};
  }
  lay_items(scope, item.items, false);
  scope.variables.erase(name);
  scope.copied.erase(name);
  return true;
}

}  // namespace hookpoint::language
