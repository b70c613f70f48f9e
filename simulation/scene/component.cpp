// Controllers, sensors, actuators and sources: the classes of control::Registry as classes of the
// language (what a component declares of its ports, and the fields of the stub around it), and
// their objects as plain values.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "control/registry.h"
#include "language/tree/fields.h"
#include "simulation/scene/formula_signals.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::append;
using language::choice_field;
using language::Direction;
using language::Fields;
using language::FieldSchema;
using language::list_field;
using language::number_field;
using language::object_field;
using language::orientation_field;
using language::port_only;
using language::text_field;

namespace {

using control::Attachment;
using control::PortDescription;
using control::PortKind;

/// What the stub does to all of its wires, in the fields of a Wire. The noise is in the unit of the
/// value carried.
const Fields<ComponentSpec>& stub_fields() {
  static const Fields<ComponentSpec> fields{
      positive(number_field(language::wire_rate, "Hz", &ComponentSpec::rate,
                            "updates a second, and samples a second of its wires, held in between; "
                            "if not given, one each step")),
      not_negative(number_field(language::wire_delay, "s", "",
                                "of each of its wires: a sample arrives that much later")),
      not_negative(number_field(language::wire_noise, "?", "",
                                "of those of its wires that carry this unit: standard deviation of "
                                "zero-mean Gaussian noise, added when sampled")),
  };
  return fields;
}

std::vector<FieldSchema> attachment_fields(Attachment attachment) {
  switch (attachment) {
    case Attachment::none:
      return {};
    case Attachment::joint:
      return {object_field(
          attachment_field(attachment), "Link",
          "the joint, by its link, that it is attached to; needed unless wires take its place")};
    case Attachment::body:
      return {object_field(attachment_field(attachment), "Base.|Link",
                           "the body that it is attached to; needed unless wires take its place")};
  }
  return {};
}

FieldSchema text_of(const PortDescription& port) {
  if (!port.choices.empty())
    return choice_field(port.name, port.choices, port.default_text, port.doc);
  FieldSchema field = text_field(port.name, port.doc);
  if (!port.default_text.empty()) field.default_text = fmt::format("\"{}\"", port.default_text);
  return field;
}

std::string document(const PortDescription& port) {
  if (port.world != control::WorldValue::none)
    return port.doc + "; if not given, that of the World's gravity";
  if (!port.counted_by.empty())
    return fmt::format("{}; one for all, or one for each of `{}`", port.doc, port.counted_by);
  if (port.attached.empty()) return port.doc;
  return fmt::format("{}; {} `{}` of what it is attached to unless wired", port.doc,
                     port.kind == PortKind::output ? "drives" : "reads", port.attached);
}

/// A number, an orientation, or an array that takes one number for all of its elements, or as many as are in use.
FieldSchema value_of(const PortDescription& port) {
  const bool computed = port.kind == PortKind::output || port.kind == PortKind::state;
  if (port.orientation)
    return with_port(Direction::both, orientation_field(port.name, document(port)));
  const bool open = computed || port.world != control::WorldValue::none;
  const std::string value = open ? "" : fmt::format("{}", port.default_value);
  FieldSchema field =
      port.count > 1
          ? list_field(port.name, port.unit, 1, static_cast<int>(port.count), value, document(port))
          : number_field(port.name, port.unit, value, document(port));
  field.one_or_all = port.count > 1 && port.counted_by.empty();
  field.minimum = port.minimum;
  field.maximum = port.maximum;
  if (computed) return port_only(Direction::output, std::move(field));
  return with_port(Direction::both, std::move(field));
}

void load_text(const language::Object& object, const PortDescription& port, ComponentSpec& spec,
               Loading& loading) {
  if (!object.given(port.name)) return;
  std::string text = object.word(port.name);
  if (port.path && !text.empty()) {
    const std::filesystem::path path = find_file(text, place_of(object, port.name), loading);
    if (path.empty()) return;
    text = std::filesystem::absolute(path).string();
  }
  spec.texts.emplace_back(port.first, std::move(text));
}

/// How many elements of an array are in use: all, or as many as the parameter says that counts
/// them, where it says a number that the array can have.
std::size_t elements_in_use(const language::Object& object, const PortDescription& port) {
  if (port.counted_by.empty()) return port.count;
  const double counted = object.number(port.counted_by);
  const bool possible = counted >= 1. && counted <= static_cast<double>(port.count);
  return possible ? static_cast<std::size_t>(counted) : port.count;
}

/// One number holds for all elements of an array.
void load_numbers(const language::Object& object, const PortDescription& port, ComponentSpec& spec,
                  Loading& loading) {
  if (!object.given(port.name)) return;
  const std::vector<double>& numbers = object.numbers(port.name);
  const std::size_t used = elements_in_use(object, port);
  if (numbers.size() != 1 && numbers.size() != used && numbers.size() != port.count) {
    const std::string each =
        port.counted_by.empty() ? "" : fmt::format(", one for each of `{}`", port.counted_by);
    return loading.error(place_of(object, port.name),
                         fmt::format("`{}` takes one number for all or {} numbers{}, not {}",
                                     port.name, used, each, numbers.size()));
  }
  const std::size_t given = numbers.size() == 1 ? port.count : numbers.size();
  for (std::size_t i = 0; i < given; ++i)
    spec.values.emplace_back(port.first + i, numbers[numbers.size() == 1 ? 0 : i]);
}

void load_component(const language::Object& object, const control::ComponentClass& type,
                    Loading& loading) {
  ComponentSpec spec = load_fields(object, stub_fields());
  spec.trail = loading.trails.at(&object);
  spec.type = type.name;
  if (const auto field = attachment_field(type.attachment);
      type.attachment != Attachment::none && object.given(field))
    spec.attached = loading.trails.at(object.object(field));
  const auto component = type.make();
  for (const PortDescription& port : component->ports()) {
    if (port.kind == PortKind::text) load_text(object, port, spec, loading);
    if (port.kind == PortKind::input || port.kind == PortKind::parameter)
      load_numbers(object, port, spec, loading);
  }
  load_formulas(object, type, loading.components.size(), spec, loading);
  loading.components.push_back(&object);
  loading.experiment.components.push_back(std::move(spec));
}

}  // namespace

std::string_view attachment_field(Attachment attachment) {
  return attachment == Attachment::joint ? "joint" : "body";
}

language::ClassSchema component_schema(const control::ComponentClass& type) {
  language::ClassSchema schema;
  schema.name = type.name;
  schema.doc = type.doc;
  schema.origin = type.origin;
  schema.top_level = true;
  schema.default_input = type.default_input;
  schema.default_output = type.default_output;
  const std::unique_ptr<control::Component> component = type.make();
  for (const PortDescription& port : component->ports()) {
    schema.fields.push_back(port.kind == PortKind::text ? text_of(port) : value_of(port));
  }
  append(schema.fields, attachment_fields(type.attachment));
  append(schema.fields, schemas(stub_fields()));
  describe_formula_class(schema);
  return schema;
}

void add_component_classes(language::Schema& schema) {
  for (const auto& [name, type] : control::Registry::instance().classes())
    schema.add(component_schema(type));
  add_state_machine_parts(schema);
}

std::string component_class_problem(const language::Schema& schema,
                                    const control::ComponentClass& type) {
  // A family holds either components or classes of another kind: who may stand where goes by it.
  const std::string family = type.name.substr(0, type.name.find('.'));
  for (const auto& [name, other] : schema.classes()) {
    const bool component = control::Registry::instance().find(name) != nullptr;
    if (name == type.name) return fmt::format("the language has a class '{}'", name);
    if (!component && (name == family || name.starts_with(family + ".")))
      return fmt::format("'{}' of the language is no component, so '{}.' is not free", name,
                         family);
  }
  language::Schema joined = schema;
  joined.add(component_schema(type));
  const std::vector<std::string> problems = language::schema_problems(joined);
  return problems.empty() ? "" : problems.front();
}

std::vector<std::string> component_families() {
  std::vector<std::string> families;
  for (const auto& [name, type] : control::Registry::instance().classes()) {
    if (!component_schema(type).top_level) continue;  // stands inside of another
    const std::size_t dot = name.find('.');
    std::string family = dot == std::string::npos ? name : name.substr(0, dot + 1);
    if (std::ranges::find(families, family) == families.end())
      families.push_back(std::move(family));
  }
  return families;
}

void load_components(const language::Object& parent, Loading& loading) {
  for (const auto& child : parent.children) {
    if (const auto* type = control::Registry::instance().find(child->type))
      load_component(*child, *type, loading);
    load_components(*child, loading);
  }
}

}  // namespace hookpoint::simulation
