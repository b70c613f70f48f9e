#include "language/tree/references.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "language/names.h"
#include "language/wording.h"

namespace hookpoint::language {
namespace {

std::string called(const Object& object) {
  if (object.parent == nullptr) return "the top of the file";
  return object.name.empty() ? "this " + object.type
                             : "`" + object.name + "` (" + object.type + ")";
}

/// The element that "goal[3]" means of a list that has it, as "goal" and 3; no index otherwise.
std::pair<std::string_view, std::optional<int>> split_element(std::string_view part) {
  const std::size_t open = part.find('[');
  if (open == std::string_view::npos || !part.ends_with(']')) return {part, std::nullopt};
  const std::string_view digits = part.substr(open + 1, part.size() - open - 2);
  int index = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, index);
  if (error != std::errc{} || stop != end || index < 0) return {part, std::nullopt};
  return {part.substr(0, open), index};
}

std::string no_element(const Object& object, const FieldSchema& list, int element) {
  std::string message = "`" + list.name + "` of " + called(object) + " has no element [" +
                        std::to_string(element) + "]";
  if (list.type == FieldType::numbers && list.max_count > 1)
    message += "; its elements are [0] to [" + std::to_string(list.max_count - 1) + "]";
  return message;
}

}  // namespace

std::vector<std::string_view> parts_of_trail(std::string_view trail) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t dot = trail.find('.');
    parts.push_back(trail.substr(0, dot));
    if (dot == std::string_view::npos) return parts;
    trail.remove_prefix(dot + 1);
  }
}

std::string_view part_letters(const FieldSchema& field) {
  if (field.type == FieldType::orientation) return "wxyz";
  if (field.type != FieldType::numbers || field.max_count < 2 || field.max_count > 3) return "";
  return field.max_count == 3 ? "xyz" : "xy";
}

std::optional<Target> Names::resolve(const Object& from, std::string_view trail, bool want_field,
                                     Unresolved& why) {
  const std::vector<std::string_view> parts = parts_of_trail(trail);
  for (const Object* scope = &from; scope != nullptr; scope = scope->parent) {
    // A lone name is the enclosing object's own port before it is an object; a longer trail begins
    // with an object.
    std::optional<Target> own = want_field ? field_of(*scope, parts, 0) : std::nullopt;
    if (own && parts.size() == 1) return own;
    const Object* first = child(*scope, parts[0], why);
    if (!why.message.empty()) return std::nullopt;
    if (first != nullptr) return descend(*first, parts, 1, want_field, why);
    if (own) return own;
  }
  const auto [list, element] = split_element(parts[0]);
  const FieldSchema* listed =
      want_field && element && from.schema != nullptr ? from.schema->find(list) : nullptr;
  if (listed != nullptr) {
    why.message = no_element(from, *listed, *element);
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (const Object* scope = &from; scope != nullptr; scope = scope->parent) {
    const std::vector<std::string> seen = names_in(*scope, want_field && parts.size() == 1);
    names.insert(names.end(), seen.begin(), seen.end());
  }
  const std::string kind = want_field && parts.size() == 1 ? "no object or port" : "no object";
  why.message = kind + " `" + std::string(parts[0]) + "` can be seen from here" +
                did_you_mean(parts[0], names);
  return std::nullopt;
}

std::optional<Target> Names::descend(const Object& object,
                                     const std::vector<std::string_view>& parts, std::size_t next,
                                     bool want_field, Unresolved& why) {
  if (next == parts.size()) return Target{&object, nullptr, -1, ""};
  const Object* found = child(object, parts[next], why);
  if (!why.message.empty()) return std::nullopt;
  if (found != nullptr) return descend(*found, parts, next + 1, want_field, why);
  std::optional<Target> field = want_field ? field_of(object, parts, next) : std::nullopt;
  if (field) return field;
  const FieldSchema* whole =
      want_field && object.schema != nullptr ? object.schema->find(parts[next]) : nullptr;
  const auto [list, element] = split_element(parts[next]);
  const FieldSchema* listed =
      want_field && element && object.schema != nullptr ? object.schema->find(list) : nullptr;
  if (listed != nullptr) {
    why.message = no_element(object, *listed, *element);
  } else if (whole != nullptr) {
    const std::string_view letters = part_letters(*whole);
    why.message = "`" + whole->name + "` of " + called(object) + " has no part `" +
                  std::string(parts[next + 1]) + "`";
    std::string rest(parts[next]);
    for (std::size_t i = next + 1; i < parts.size(); ++i) rest += '.' + std::string(parts[i]);
    std::vector<std::string> longer = names_in(object, want_field);
    std::erase_if(longer,
                  [&](const std::string& name) { return !name.starts_with(whole->name + '.'); });
    why.message += did_you_mean(rest, longer);
    if (!letters.empty()) why.message += "; its parts are";
    for (const char letter : letters)
      why.message += std::string(letter == letters.front() ? " " : ", ") + letter;
  } else {
    const std::string kind = want_field ? " has no object or port `" : " holds no object `";
    const std::vector<std::string> names = names_in(object, want_field);
    std::string hint = did_you_mean(parts[next], names);
    constexpr std::size_t most_names = 20;
    if (hint.empty() && !names.empty() && names.size() <= most_names)
      hint = "; it has " + join(names, ", ");
    why.message = called(object) + kind + std::string(parts[next]) + "`" + hint;
  }
  why.candidates.push_back(&object);
  return std::nullopt;
}

std::string part_name(const FieldSchema& field, int index) {
  const std::string_view letters = part_letters(field);
  if (letters.empty()) return '[' + std::to_string(index) + ']';
  return {'.', letters[static_cast<std::size_t>(index)]};
}

std::optional<Target> Names::field_of(const Object& object,
                                      const std::vector<std::string_view>& parts,
                                      std::size_t next) const {
  if (object.schema == nullptr) return std::nullopt;
  const FieldSchema* field = nullptr;
  if (const auto [list, element] = split_element(parts[next]);
      element && parts.size() == next + 1) {
    field = object.schema->find(list);
    const bool has = field != nullptr && field->type == FieldType::numbers &&
                     field->max_count > std::max(1, *element);
    if (!has) return std::nullopt;
    return Target{&object, field, *element, field->name + part_name(*field, *element)};
  }
  // A port's own name may hold a dot (contact.force) and begin with another's (integrator.steps):
  // the longest counts.
  std::size_t end = next;
  std::string name;
  for (std::size_t i = next; i < parts.size(); ++i) {
    if (i > next) name += '.';
    name += parts[i];
    if (const FieldSchema* longer = object.schema->find(name)) {
      field = longer;
      end = i + 1;
    }
  }
  if (field == nullptr || parts.size() > end + 1) return std::nullopt;
  if (parts.size() == end) return Target{&object, field, -1, field->name};
  const std::string_view part = parts[end];
  const std::size_t index =
      part.size() == 1 ? part_letters(*field).find(part[0]) : std::string_view::npos;
  if (index == std::string_view::npos) return std::nullopt;
  return Target{&object, field, static_cast<int>(index), field->name + '.' + std::string(part)};
}

const Object* Names::child(const Object& scope, std::string_view name, Unresolved& why) {
  const Table& seen = table(scope);
  const auto found = seen.find(name);
  if (found == seen.end()) return nullptr;
  if (found->second.rival == nullptr) return found->second.object;
  why.message =
      "`" + std::string(name) + "` means two objects: give one of the objects around them a name";
  why.candidates = {found->second.object, found->second.rival};
  return nullptr;
}

const Names::Table& Names::table(const Object& scope) {
  const auto [entry, added] = tables_.try_emplace(&scope);
  if (added) list(scope, 0, entry->second);
  return entry->second;
}

void Names::list(const Object& scope, int depth, Table& table) const {
  for (const std::unique_ptr<Object>& object : scope.children) {
    if (object->name.empty()) {
      list(*object, depth + 1, table);
      continue;
    }
    const auto [entry, added] = table.try_emplace(object->name, Seen{object.get(), nullptr, depth});
    Seen& seen = entry->second;
    if (added) continue;
    if (depth < seen.depth) {
      seen = {object.get(), nullptr, depth};
    } else if (depth == seen.depth) {
      seen.rival = object.get();
    }
  }
}

std::vector<std::string> Names::names_in(const Object& scope, bool want_field) {
  std::vector<std::string> names;
  for (const auto& [name, seen] : table(scope)) names.emplace_back(name);
  if (want_field && scope.schema != nullptr) {
    for (const FieldSchema& field : scope.schema->fields) names.push_back(field.name);
  }
  std::ranges::sort(names);
  return names;
}

std::optional<Reference> resolve(const Object& root, const std::string& trail, bool want_port,
                                 Diagnostics& diagnostics) {
  Names names;
  Unresolved why;
  std::optional<Target> target = names.resolve(root, trail, want_port, why);
  if (target && want_port && target->field == nullptr) {
    const std::string& port = target->object->schema->default_output;
    target->field = target->object->schema->find(port);
    target->port = port;
    if (target->field == nullptr)
      why.message =
          with_article(target->object->type) + " has no output of its own: name one of its ports";
  }
  if (target && target->field != nullptr && target->field->port == Direction::none) {
    why.message = "`" + target->port + "` of " + target->object->type + " is no port";
  }
  if (why.message.empty()) return Reference{trail, target->object, target->port, {}};
  diagnostics.error({}, "`" + trail + "`: " + why.message);
  return std::nullopt;
}

}  // namespace hookpoint::language
