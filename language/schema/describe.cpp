#include "language/schema/describe.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>

#include "language/names.h"
#include "language/wording.h"

namespace hookpoint::language {
namespace {

/// "number [m]", "3 numbers [m]", "one of a, b", ...
std::string type_text(const FieldSchema& field) {
  std::string unit = field.unit.empty() ? "" : " [" + field.unit + "]";
  if (field.unit == "?") unit = " [any unit]";
  if (field.other_unit)
    unit = " [" + field.unit + ", or " + field.other_unit->unit + " where " +
           field.other_unit->field + " = " + field.other_unit->word + "]";
  std::string count = std::to_string(field.min_count);
  if (field.max_count > 1000) count += " or more";
  if (field.max_count <= 1000 && field.max_count != field.min_count)
    count += (field.one_or_all ? " or " : " to ") + std::to_string(field.max_count);
  switch (field.type) {
    case FieldType::number:
      return "number" + unit + (field.choices.empty() ? "" : ", or " + join(field.choices, ", ")) +
             (field.or_words ? ", or a word or string" : "");
    case FieldType::integer:
      return "whole number" + unit;
    case FieldType::boolean:
      return "true or false";
    case FieldType::text:
      return "string";
    case FieldType::choice:
      return "one of " + join(field.choices, ", ");
    case FieldType::numbers:
      return count + (count == "1" ? " number" : " numbers") + unit +
             (field.or_words ? ", or words or strings" : "");
    case FieldType::orientation:
      return "quaternion w, x, y, z, or roll, pitch, yaw [rad]";
    case FieldType::object: {
      std::string classes = field.refers_to.empty() ? "object" : field.refers_to;
      std::ranges::replace(classes, '|', '/');
      return "name of " + with_article(classes);
    }
    case FieldType::port:
      return "trail of a port";
    case FieldType::words:
      return count + (count == "1" ? " word" : " words");
    case FieldType::formula:
      return "expression";
  }
  return "";
}

std::string port_text(const FieldSchema& field) {
  switch (field.port) {
    case Direction::input:
      return "input";
    case Direction::output:
      return "output";
    case Direction::both:
      return "input and output";
    default:
      return "";
  }
}

/// Range, default, direction: what there is of it.
std::vector<std::string> facts(const FieldSchema& field) {
  std::vector<std::string> found;
  if (!range_text(field).empty()) found.push_back(range_text(field));
  if (field.required) found.emplace_back("required");
  if (!field.default_text.empty()) found.push_back("default " + field.default_text);
  if (!port_text(field).empty()) found.push_back(port_text(field) + (field.setting ? "" : " only"));
  return found;
}

std::string places(const ClassSchema& schema, const Schema* all) {
  std::vector<std::string> found;
  if (schema.top_level) found.emplace_back("the top of a file");
  if (all != nullptr) {
    for (const auto& [name, parent] : all->classes()) {
      const bool holds = std::ranges::any_of(parent.children, [&schema](const std::string& child) {
        return child == schema.name || (child.ends_with('.') && schema.name.starts_with(child));
      });
      if (holds && all->find(schema.name, parent.name) == &schema) found.push_back(name);
    }
  }
  return join(found, ", ");
}

std::string naming_text(const ClassSchema& schema) {
  if (schema.naming == Naming::required) return "needs a name";
  if (schema.naming == Naming::forbidden) return "has no name";
  return schema.default_name.empty() ? ""
                                     : "called `" + schema.default_name + "` when it has no name";
}

/// Lines "label: text" of a class beside its fields.
std::vector<std::pair<std::string, std::string>> class_facts(const ClassSchema& schema,
                                                             const Schema* all) {
  std::vector<std::pair<std::string, std::string>> found;
  const auto add = [&found](std::string label, std::string text) {
    if (!text.empty()) found.emplace_back(std::move(label), std::move(text));
  };
  add("from the plugin", schema.origin);
  add("stands in", places(schema, all));
  add("name", naming_text(schema));
  add("may hold", join(schema.children, ", "));
  add("a wire without FROM starts at", schema.default_output);
  add("a wire without TO ends at", schema.default_input);
  return found;
}

/// The anchor of a heading, as GitHub and the manual's site make it.
std::string anchor(const std::string& heading) {
  std::string found;
  for (const char c : heading) {
    if (c == '.') continue;
    found += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return found;
}

/// The classes by where they stand, each a link to its heading. Places of fewer than three share
/// the last row.
std::string class_index(const Schema& schema) {
  std::map<std::string, std::vector<std::string>> by_place;
  for (const auto& [name, entry] : schema.classes())
    by_place[places(entry, &schema)].push_back("[" + name + "](#" + anchor(name) + ")");
  std::string text = "\n| stands in | classes |\n|---|---|\n";
  std::vector<std::string> others;
  for (const auto& [place, links] : by_place) {
    if (links.size() < 3 || place.empty()) {
      others.insert(others.end(), links.begin(), links.end());
    } else {
      text += "| " + place + " | " + join(links, ", ") + " |\n";
    }
  }
  std::ranges::sort(others);
  return others.empty() ? text : text + "| elsewhere | " + join(others, ", ") + " |\n";
}

std::string describe_in(const ClassSchema& schema, const Schema* all) {
  std::string text = schema.name + (schema.only_in.empty() ? "" : " in " + schema.only_in) +
                     "\n  " + schema.doc + "\n";
  for (const auto& [label, fact] : class_facts(schema, all))
    text += "  " + label + ": " + fact + "\n";
  for (const FieldSchema& field : schema.fields) {
    text += "\n  " + field.name + "  " + type_text(field);
    for (const std::string& fact : facts(field)) text += "; " + fact;
    text += "\n      " + field.doc + "\n";
  }
  return text;
}

}  // namespace

std::string describe(const ClassSchema& schema) { return describe_in(schema, nullptr); }

std::string describe(const ClassSchema& schema, const Schema& all) {
  return describe_in(schema, &all);
}

std::string describe_all(const Schema& schema) {
  std::size_t width = 0;
  for (const auto& [name, entry] : schema.classes()) width = std::max(width, name.size());
  std::string text;
  for (const auto& [name, entry] : schema.classes()) {
    text += name + std::string(width + 2 - name.size(), ' ') + entry.doc + "\n";
  }
  return text;
}

std::string describe_markdown(const Schema& schema) {
  const auto cell = [](std::string text) {
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
      text.insert(at, "\\");
    return text;
  };
  std::string text = "# Classes of the language\n" + class_index(schema);
  for (const auto& [name, entry] : schema.classes()) {
    text += "\n## " + name + "\n\n" + entry.doc + "\n";
    const auto facts_of_class = class_facts(entry, &schema);
    if (!facts_of_class.empty()) text += "\n";
    for (const auto& [label, fact] : facts_of_class) text += "- " + label + ": " + fact + "\n";
    if (entry.fields.empty()) continue;
    text += "\n| field | takes | range, default, port | meaning |\n|---|---|---|---|\n";
    for (const FieldSchema& field : entry.fields) {
      text += "| `" + field.name + "` | " + cell(type_text(field)) + " | " +
              cell(join(facts(field), "; ")) + " | " + cell(field.doc) + " |\n";
    }
  }
  return text;
}

std::string unit_after(const FieldSchema& field) {
  const bool none = field.unit.empty() || field.unit == "?" || field.other_unit;
  return none ? "" : " " + field.unit;
}

std::string number_text(double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end};
}

std::string range_text(const FieldSchema& field) {
  const std::string unit = unit_after(field);
  const bool low = std::isfinite(field.minimum), high = std::isfinite(field.maximum);
  if (low && high && !field.exclusive_minimum && !field.exclusive_maximum) {
    return "from " + rounded_text(field.minimum) + " to " + rounded_text(field.maximum) + unit;
  }
  std::string text;
  if (low)
    text = (field.exclusive_minimum ? "greater than " : "at least ") + rounded_text(field.minimum) +
           unit;
  if (low && high) text += " and ";
  if (high)
    text +=
        (field.exclusive_maximum ? "less than " : "at most ") + rounded_text(field.maximum) + unit;
  return text;
}

}  // namespace hookpoint::language
