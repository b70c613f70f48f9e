#include "language/schema/absent.h"

#include <algorithm>

namespace hookpoint::language {
namespace {

std::vector<std::span<const Absent>>& table() {
  static std::vector<std::span<const Absent>> rows;
  return rows;
}

/// Whether `list`, separated by '|', has `name`, or a family or port that `name` is a part of.
bool one_of(std::string_view list, std::string_view name) {
  while (!list.empty()) {
    const std::string_view one = list.substr(0, list.find('|'));
    const bool begins = name.starts_with(one);
    if (begins && (one.ends_with('.') || name.size() == one.size() || name[one.size()] == '.'))
      return true;
    list.remove_prefix(std::min(one.size() + 1, list.size()));
  }
  return false;
}

}  // namespace

void add_absent(std::span<const Absent> rows) {
  const bool known = std::ranges::any_of(
      table(), [&](std::span<const Absent> added) { return added.data() == rows.data(); });
  if (!known) table().push_back(rows);
}

const std::vector<std::span<const Absent>>& absent() { return table(); }

std::string_view instead_of(std::string_view where, std::string_view name) {
  for (const std::span<const Absent> rows : table()) {
    const auto found = std::ranges::find_if(rows, [&](const Absent& one) {
      const bool of_same_kind = one.where.empty() == where.empty();
      return of_same_kind && (where.empty() || one_of(one.where, where)) && one_of(one.names, name);
    });
    if (found != rows.end()) return found->instead;
  }
  return "";
}

}  // namespace hookpoint::language
