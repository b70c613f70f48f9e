#include "language/tree/checker.h"

#include <algorithm>

#include "language/names.h"
#include "language/schema/absent.h"
#include "language/tree/field.h"
#include "language/units.h"
#include "language/wording.h"

namespace hookpoint::language {
namespace {

/// ": " and what to do where the language has no such port; "" if there is nothing to say.
std::string instead_of_port(const Reference& reference, const Unresolved& why) {
  if (why.candidates.size() != 1) return "";
  std::string_view rest = reference.trail;
  for (std::size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
    rest.remove_prefix(dot + 1);
    const std::string_view instead = instead_of(why.candidates.front()->type, rest);
    if (!instead.empty()) return ": " + std::string(instead);
  }
  return "";
}

Field* given_field(Object& object, const FieldSchema& schema) {
  const auto found =
      std::ranges::find(object.fields, &schema, [](const Field& field) { return field.schema; });
  return found == object.fields.end() ? nullptr : &*found;
}

}  // namespace

void Checker::apply(Object& root, const Override& setting, const std::vector<std::string>& params) {
  const ParsedFile text = files_.override_text(setting.trail, setting.value);
  report_.order_file(text.source);
  report_.append(text.report);
  if (text.report.has_errors()) return;
  const Item& item = text.syntax.items[text.syntax.top.begin];
  const Variables none;
  Budget budget;
  const ExpressionEvaluator evaluate(text, none, report_, budget);
  const Trail& trail = text.syntax.details[item.detail].to;
  const std::optional<std::string> words = evaluate.trail_text(trail);
  if (!words) return;
  if (trail.parts.size() == 1) {
    return report_.error(evaluate.position(trail.span),
                         "the file has no Param `" + *words + "`" + did_you_mean(*words, params) +
                             "; a field is set by its trail from the top, as in World.deltat");
  }
  Unresolved why;
  const std::optional<Target> target = names_.resolve(root, *words, true, why);
  const Reference reference{*words, nullptr, "", evaluate.position(trail.span)};
  if (!target) return report_unresolved(reference, why);
  if (target->field == nullptr || target->part >= 0) {
    const std::string what = target->field == nullptr ? " is an object" : " is a part of a field";
    return report_.error(reference.position,
                         "`" + *words + "`" + what + "; expected the trail of a field");
  }
  if (!target->field->setting) {
    return report_.error(reference.position, "`" + target->field->name + "` of " +
                                                 target->object->type +
                                                 " is a port: it cannot be set");
  }
  std::optional<Field> made = make_field(
      schema_.context(*target->object->schema, *target->field, evaluate, report_), item.value);
  if (!made) return;
  made->given = made->from_outside = true;
  // The tree is the caller's to change; only the look-up sees it as const.
  Object& object = const_cast<Object&>(*target->object);
  object.implicit = false;
  if (Field* given = given_field(object, *target->field)) {
    *given = std::move(*made);
    return;
  }
  const auto order = [](const Field& field) { return field.schema; };
  object.fields.insert(std::ranges::lower_bound(object.fields, target->field, {}, order),
                       std::move(*made));
}

void Checker::check(Object& root) { check_object(root); }

void Checker::check_object(Object& object) {
  if (report_.full()) return;
  if (object.parent != nullptr && schema_.of(*object.schema).has_required) check_required(object);
  if (object.parent != nullptr && schema_.of(*object.schema).has_other_units) check_units(object);
  for (Field& field : object.fields) {
    const bool refers =
        field.schema->type == FieldType::object || field.schema->type == FieldType::port;
    if (refers && !field.reference.trail.empty() && !report_.told_at(field.reference.position))
      check_reference(object, field);
  }
  for (Wire& wire : object.wires) check_wire(object, wire);
  for (const std::unique_ptr<Object>& child : object.children) check_object(*child);
}

void Checker::check_required(const Object& object) {
  if (report_.is_broken(object.position)) return;
  for (const FieldSchema& field : object.schema->fields) {
    if (!field.required || object.given(field.name)) continue;
    const std::string unit = field.unit.empty() || field.unit == "?" ? "" : " [" + field.unit + "]";
    report_.error(object.position, "this " + object.type + " needs `" + field.name + "`" + unit);
  }
}

void Checker::check_units(Object& object) {
  for (Field& field : object.fields) {
    if (!field.schema->other_unit || field.numbers.empty()) continue;
    const Field* choice = object.find(field.schema->other_unit->field);
    if (choice == nullptr || choice->words.empty()) continue;
    if (!fits(field.dimension, schema_.dimension(object, *field.schema)))
      report_.error(field.position, "`" + field.schema->name + "` takes a value in " +
                                        object.unit_of(*field.schema) + " where `" +
                                        choice->schema->name + "` is " + choice->words[0] +
                                        ", not in " + unit_text(field.dimension));
    // From here on it is in the unit that the object says.
    field.dimension = {};
  }
}

void Checker::report_unresolved(const Reference& reference, const Unresolved& why) {
  if (report_.is_broken(reference.position)) return;
  std::string_view rest = reference.trail;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('.'), rest.size());
    const std::string_view part = rest.substr(0, end);
    if (left_out_.contains(part) || left_out_.contains(part.substr(0, part.find('[')))) return;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  report_.error(reference.position, why.message + instead_of_port(reference, why));
  for (const Object* candidate : why.candidates) {
    if (candidate->position.file != nullptr)
      report_.note(candidate->position, "this " + candidate->type);
  }
  hints_.explain(reference.position, report_);
}

void Checker::check_reference(const Object& object, Field& field) {
  const FieldSchema& schema = *field.schema;
  const bool port = schema.type == FieldType::port;
  Reference& reference = field.reference;
  Unresolved why;
  std::optional<Target> target = names_.resolve(object, reference.trail, port, why);
  if (!target) return report_unresolved(reference, why);
  if (!port) {
    reference.object = target->object;
    if (matches_class(target->object->type, schema.refers_to)) return;
    std::string wanted = schema.refers_to;
    std::ranges::replace(wanted, '|', '/');
    report_.error(reference.position, "`" + schema.name + "` takes " + with_article(wanted) +
                                          ", but `" + reference.trail + "` is " +
                                          with_article(target->object->type));
    return report_.note(target->object->position,
                        "`" + reference.trail + "` is this " + target->object->type);
  }
  if (target->field == nullptr && !use_default_port(*target, true)) {
    return report_.error(reference.position,
                         "`" + reference.trail + "` is " + with_article(target->object->type) +
                             ", which has no output of its own; expected the trail of a port");
  }
  if (target->field->port == Direction::none) {
    return report_.error(reference.position,
                         "`" + target->port + "` of " + target->object->type + " is no port");
  }
  reference.object = target->object;
  reference.port = target->port;
}

}  // namespace hookpoint::language
