#include "language/tree/print.h"

#include <filesystem>
#include <set>

#include "language/schema/describe.h"
#include "language/tree/field.h"
#include "language/tree/references.h"
#include "language/units.h"
#include "language/values/formula.h"

namespace hookpoint::language {
namespace {

class Printer {
 public:
  explicit Printer(const Object& root) : root_(root) {}

  std::string run() {
    for (const std::string& plugin : root_.plugins) text_ += "Plugin " + quote(plugin) + ";\n";
    for (const std::unique_ptr<Object>& child : root_.children) {
      if (child->schema->own_file)
        include(*child);
      else if (!child->implicit)
        print(*child, 0);
    }
    for (const Wire& wire : root_.wires) print(root_, wire, 0);
    return std::move(text_);
  }

  std::string value_text(const Object& object, const Field& field) {
    std::string text;
    const auto add = [&text](const std::string& element) {
      text += (text.empty() ? "" : ", ") + element;
    };
    switch (field.schema->type) {
      case FieldType::boolean:
        return field.numbers[0] != 0. ? "true" : "false";
      case FieldType::object:
      case FieldType::port:
        return reference_text(object, field.reference);
      case FieldType::choice:
        return field.words[0];
      case FieldType::text:
        return quote(field.words[0]);
      case FieldType::words:
        for (const std::string& word : field.words) add(quote(word));
        return text;
      case FieldType::formula:
        return field.formula->text;
      default:
        break;
    }
    for (std::size_t i = 0; i < field.words.size(); ++i)  // they stand for the numbers
      add(i < field.quoted.size() && field.quoted[i] ? quote(field.words[i]) : field.words[i]);
    if (!field.words.empty()) return text;
    const std::string unit = unit_text(field.dimension);
    for (const double number : field.numbers)
      add(number_text(number) + (unit.empty() ? "" : " " + unit));
    return text;
  }

 private:
  void indent(int depth) { text_.append(2 * static_cast<std::size_t>(depth), ' '); }

  /// The file of the object, by its absolute path, once.
  void include(const Object& object) {
    const std::string path = std::filesystem::absolute(object.position.file->path).string();
    if (included_.insert(path).second) text_ += "Include " + quote(path) + ";\n";
  }

  void print(const Object& object, int depth) {
    indent(depth);
    text_ += object.type;
    if (object.named) text_ += ' ' + object.name;
    if (object.fields.empty() && object.children.empty() && object.wires.empty()) {
      text_ += ";\n";
      return;
    }
    text_ += " {\n";
    for (const Field& field : object.fields) print(object, field, depth + 1);
    for (const std::unique_ptr<Object>& child : object.children) print(*child, depth + 1);
    for (const Wire& wire : object.wires) print(object, wire, depth + 1);
    indent(depth);
    text_ += "}\n";
  }

  void print(const Object& object, const Field& field, int depth) {
    indent(depth);
    text_ += field.schema->name + " = " + value_text(object, field) + ";\n";
  }

  void print(const Object& object, const Wire& wire, int depth) {
    indent(depth);
    text_ += "Wire";
    // An end that was not written is the object's own default port and stays unwritten.
    if (!wire.from->trail.empty()) text_ += " FROM " + reference_text(object, *wire.from);
    if (!wire.to->trail.empty()) text_ += " TO " + reference_text(object, *wire.to);
    if (wire.fields.empty()) {
      text_ += ";\n";
      return;
    }
    text_ += " {";
    for (const Field& field : wire.fields)
      text_ += ' ' + field.schema->name + " = " + value_text(object, field) + ';';
    text_ += " }\n";
  }

  /// The trail from the top if it means the same from here, else as it was written.
  std::string reference_text(const Object& from, const Reference& reference) {
    std::string trail = reference.object->trail();
    if (!reference.port.empty()) trail += (trail.empty() ? "" : ".") + reference.port;
    Unresolved why;
    const std::optional<Target> target = names_.resolve(from, trail, !reference.port.empty(), why);
    const bool same =
        target && target->object == reference.object && target->port == reference.port;
    return same ? trail : reference.trail;
  }

  const Object& root_;
  std::string text_;
  std::set<std::string> included_;
  Names names_;
};

}  // namespace

std::string quote(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? "\\n" : c == '\t' ? "\\t" : std::string(1, c);
  }
  return quoted + '"';
}

std::string print(const Object& root) { return Printer(root).run(); }

std::string print_value(const Object& root, const Object& object, const Field& field) {
  return Printer(root).value_text(object, field);
}

}  // namespace hookpoint::language
