// What the language has not, though somebody may look for it: a class, a field, a port or a word.
// Said where it is used, and on the manual's page of limits.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace hookpoint::language {

struct Absent {
  /// Class whose field or port it would be; several, and families as "Terrain.", separated by '|'.
  /// Of a word the class and its field: "Link.joint". "" for a class.
  std::string_view where;
  /// The names that it may have, separated by '|'; a family of classes ends in a dot. "..." for
  /// more numbers than the field takes, "input" for a wire to it.
  std::string_view names;
  std::string_view instead;  ///< why not, and what to do instead, without a full stop
};

/// Adds rows to the program's table; the same rows again are no others. `rows` stay where they are.
/// Before anything is evaluated: not thread-safe.
void add_absent(std::span<const Absent> rows);
/// Of the table, in the order in which they were added.
const std::vector<std::span<const Absent>>& absent();
/// What to do instead of `name`, where a class or a field is called `where` (see Absent); "" for
/// what is simply unknown.
std::string_view instead_of(std::string_view where, std::string_view name);

}  // namespace hookpoint::language
