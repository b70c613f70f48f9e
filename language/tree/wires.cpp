// Wires: both ends exist, are an output and an input that agree, and no input has two.
#include <algorithm>

#include "language/names.h"
#include "language/schema/absent.h"
#include "language/tree/checker.h"
#include "language/units.h"
#include "language/wording.h"

namespace hookpoint::language {
namespace {

bool may_be(Direction port, bool from) {
  return port == Direction::both || port == (from ? Direction::output : Direction::input);
}

std::vector<std::string> ports_of(const ClassSchema& schema, bool from) {
  std::vector<std::string> names;
  for (const FieldSchema& field : schema.fields) {
    if (may_be(field.port, from)) names.push_back(field.name);
  }
  return names;
}

/// What kind of value a port carries: ports of one kind can be wired.
int kind_of(const FieldSchema& field) {
  switch (field.type) {
    case FieldType::number:
    case FieldType::integer:
    case FieldType::numbers:
    case FieldType::orientation:
      return 0;
    case FieldType::boolean:
      return 1;
    default:
      return 2;
  }
}

/// Booleans also take numbers without a unit: what is not 0 is true.
bool kinds_agree(const FieldSchema& output, const FieldSchema& input) {
  const int from = kind_of(output), to = kind_of(input);
  return from == to || (from == 0 && to == 1 && (output.unit.empty() || output.unit == "?"));
}

/// What a port carries or takes, for a wire between two kinds.
std::string kind_text(const FieldSchema& field) {
  if (kind_of(field) == 1) return "true or false";
  if (kind_of(field) == 2) return "no number";
  return field.unit.empty() || field.unit == "?" ? "a number" : "a number in " + field.unit;
}

int values_of(const Target& target) {
  if (target.part >= 0) return 1;
  if (target.field->type == FieldType::orientation) return 4;
  return target.field->type == FieldType::numbers ? target.field->max_count : 1;
}

}  // namespace

void Checker::check_wire(Object& object, Wire& wire) {
  std::optional<End> from = check_end(object, wire.from, wire, true);
  std::optional<End> to = check_end(object, wire.to, wire, false);
  if (to) claim_input(*to, wire);
  if (!from || !to) return;
  check_agreement(*from, *to, wire);
  check_noise(*from, wire);
}

bool Checker::use_default_port(Target& target, bool from) const {
  const ClassSchema& schema = *target.object->schema;
  target.port = from ? schema.default_output : schema.default_input;
  target.field = target.port.empty() ? nullptr : schema.find(target.port);
  return target.field != nullptr;
}

std::optional<Checker::End> Checker::check_end(const Object& object,
                                               std::optional<Reference>& reference,
                                               const Wire& wire, bool from) {
  const std::string word = from ? "output" : "input";
  Target target{&object, nullptr, -1, ""};
  const Position place = reference ? reference->position : wire.position;
  if (reference) {
    if (report_.told_at(place)) return std::nullopt;
    Unresolved why;
    std::optional<Target> found = names_.resolve(object, reference->trail, true, why);
    if (!found) {
      report_unresolved(*reference, why);
      return std::nullopt;
    }
    target = *found;
  } else {
    reference.emplace().position = wire.position;
    while (target.object->type == "Group") target.object = target.object->parent;
  }
  if (target.field == nullptr && !use_default_port(target, from)) {
    const std::string hint = join(ports_of(*target.object->schema, from), ", ");
    const std::string kind = target.object->parent == nullptr ? "the top of the file"
                                                              : with_article(target.object->type);
    report_.error(place, kind + " has no " + word + " of its own: the wire needs " +
                             (from ? "FROM" : "TO") + " and a port" +
                             (hint.empty() ? "" : "; its " + word + "s are " + hint));
    return std::nullopt;
  }
  const FieldSchema& field = *target.field;
  if (!may_be(field.port, from)) {
    const std::vector<std::string> ports = ports_of(*target.object->schema, from);
    const std::string instead(instead_of(target.object->type + '.' + field.name, word));
    const std::string hint = !instead.empty() ? ": " + instead
                             : ports.empty()  ? ""
                                              : "; its " + word + "s are " + join(ports, ", ");
    report_.error(place,
                  "`" + target.port + "` of " + target.object->type + " is no " + word + hint);
    return std::nullopt;
  }
  reference->object = target.object;
  reference->port = target.port;
  return End{target, place, schema_.dimension(*target.object, field)};
}

void Checker::check_agreement(const End& from, const End& to, const Wire& wire) {
  const FieldSchema &output = *from.target.field, &input = *to.target.field;
  const std::string a = "`" + from.target.port + "`", b = "`" + to.target.port + "`";
  if (!kinds_agree(output, input)) {
    return report_.error(wire.position,
                         a + " is " + kind_text(output) + ", " + b + " takes " + kind_text(input));
  }
  if (values_of(from.target) != values_of(to.target)) {
    return report_.error(wire.position,
                         a + " carries " +
                             count_of(static_cast<std::size_t>(values_of(from.target)), "number") +
                             ", " + b + " takes " + std::to_string(values_of(to.target)));
  }
  const bool known = output.unit != "?" && input.unit != "?";
  if (known && !fits(from.dimension, to.dimension)) {
    report_.error(wire.position, a + " is in " + describe_dimension(from.dimension) + ", " + b +
                                     " in " + describe_dimension(to.dimension));
  }
}

void Checker::check_noise(const End& from, const Wire& wire) {
  for (const Field& field : wire.fields) {
    if (field.schema->name != wire_noise || from.target.field->unit == "?" ||
        fits(field.dimension, from.dimension))
      continue;
    report_.error(field.position, "`noise` takes the unit of `" + from.target.port + "`, " +
                                      describe_dimension(from.dimension) + ", not " +
                                      describe_dimension(field.dimension));
  }
}

void Checker::claim_input(const End& to, const Wire& wire) {
  const Target& target = to.target;
  const auto first = wired_.lower_bound({target.object, target.field, target.part});
  const auto whole = wired_.find({target.object, target.field, -1});
  // The whole and any part of it are one input.
  const bool any = first != wired_.end() && std::get<0>(first->first) == target.object &&
                   std::get<1>(first->first) == target.field &&
                   (target.part < 0 || std::get<2>(first->first) == target.part);
  if (!any && whole == wired_.end()) {
    wired_.emplace(std::tuple(target.object, target.field, target.part), wire.position);
    return;
  }
  const std::string trail = target.object->trail();
  report_.error(to.position,
                "a second wire into `" + trail + (trail.empty() ? "" : ".") + target.port + "`");
  report_.note(any ? first->second : whole->second, "the first one is here");
}

}  // namespace hookpoint::language
