#include "studies/run/setting_list.h"

#include <fmt/format.h>

#include <map>

#include "language/syntax/syntax.h"

namespace hookpoint::studies {
namespace {

using language::Item;
using language::ItemKind;
using language::Span;

/// Goes through a parsed text; each setting keeps the object that it stands in.
class PrintedSettings {
 public:
  explicit PrintedSettings(const language::ParsedFile& file)
      : text_(file.source.text), syntax_(file.syntax) {}

  SettingList run() {
    add_items(syntax_.top, -1);
    number_siblings();
    SettingList settings;
    for (const Entry& entry : entries_) settings.emplace_back(trail(entry), entry.value);
    return settings;
  }

 private:
  struct Part {
    int parent = -1;  ///< -1 for none
    std::string type, label;
  };
  struct Entry {
    int part = -1;  ///< the object it belongs to
    std::string field, value;
  };

  std::string text(const Span& span) const { return text_.substr(span.offset, span.length); }

  std::string value_text(const Item& assignment) const {
    // A damaged file may hold `field = ;`, an empty list.
    if (assignment.value.begin == assignment.value.end) return "";
    const Span first = syntax_.expressions[assignment.value.begin].span;
    const Span last = syntax_.expressions[assignment.value.end - 1].span;
    return text({first.offset, last.offset + last.length - first.offset});
  }

  /// `leg[2]`
  std::string name_text(const Item& object) const {
    std::string name = text(object.name);
    if (object.indexed) name += "[" + text(syntax_.details[object.detail].index.span) + "]";
    return name;
  }

  void add_items(const language::Range& items, int parent) {
    for (std::uint32_t i = items.begin; i < items.end; ++i) {
      const Item& item = syntax_.items[i];
      if (item.kind == ItemKind::object) add_object(item, parent);
      if (item.kind == ItemKind::assignment)
        entries_.push_back({parent, text(item.place), value_text(item)});
      if (item.kind == ItemKind::wire)
        entries_.push_back({parent, wire_text(item), wire_fields(item)});
      if (item.kind == ItemKind::plugin)
        entries_.push_back({parent, "Plugin " + text(syntax_.details[item.detail].path), "there"});
    }
  }

  void add_object(const Item& item, int parent) {
    const int part = static_cast<int>(parts_.size());
    const std::string type = text(item.place), name = name_text(item);
    parts_.push_back({parent, type, name.empty() ? type : name});
    entries_.push_back({part, {}, type});
    add_items(item.items, part);
  }

  std::string wire_text(const Item& wire) const {
    const language::Detail& detail = syntax_.details[wire.detail];
    std::string ends = "Wire";
    if (detail.has_from) ends += " FROM " + text(detail.from.span);
    if (detail.has_to) ends += " TO " + text(detail.to.span);
    return ends;
  }

  /// "rate = 100 1/s; delay = 0.01 s"
  std::string wire_fields(const Item& wire) const {
    std::string fields;
    for (std::uint32_t i = wire.items.begin; i < wire.items.end; ++i) {
      const Item& field = syntax_.items[i];
      fields += (fields.empty() ? "" : "; ") + text(field.place) + " = " + value_text(field);
    }
    return fields.empty() ? "there" : fields;
  }

  /// One of several of the same parent by the same name is told by its type; of these, by a number.
  void number_siblings() {
    std::map<std::pair<int, std::string>, std::map<std::string, int>> kinds;
    for (const Part& part : parts_) ++kinds[{part.parent, part.label}][part.type];
    std::map<std::pair<int, std::string>, int> seen;
    for (Part& part : parts_) {
      const auto& types = kinds[{part.parent, part.label}];
      const bool repeated = types.at(part.type) > 1;
      if (types.size() > 1) part.label += " (" + part.type + ")";
      if (repeated) part.label += fmt::format("[{}]", seen[{part.parent, part.label}]++);
    }
  }

  std::string trail(const Entry& entry) const {
    std::string text = entry.field;
    for (int i = entry.part; i >= 0; i = parts_[static_cast<std::size_t>(i)].parent)
      text = parts_[static_cast<std::size_t>(i)].label + (text.empty() ? "" : "." + text);
    return text;
  }

  const std::string& text_;
  const language::Syntax& syntax_;
  std::vector<Part> parts_;
  std::vector<Entry> entries_;
};

}  // namespace

std::optional<SettingList> settings_of_text(std::string text) {
  const language::SourceFile source = language::source_file("", std::move(text));
  language::ParsedFile file{source};
  language::parse(file);
  if (file.report.has_errors()) return std::nullopt;
  return PrintedSettings(file).run();
}

}  // namespace hookpoint::studies
