// Trails to objects and ports: looked up from the innermost enclosing object outwards, then down
// the trail.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "language/diagnostics.h"
#include "language/report.h"
#include "language/tree/object.h"

namespace hookpoint::language {

/// What a trail reaches. `field` and `part` are set when it ends in a port: part is -1 for the
/// whole, else the component.
struct Target {
  const Object* object = nullptr;
  const FieldSchema* field = nullptr;
  int part = -1;
  std::string port;  ///< "location.x"
};

/// Why a trail reaches nothing, and objects to point at.
struct Unresolved {
  std::string message;
  std::vector<const Object*> candidates;
};

class Names {
 public:
  /// Looks `trail` up from `from`. `want_field`: the trail may end in a field or port. Nothing,
  /// with `why`, when it leads nowhere. Cost: the depth of `from`; the first look-up in an object
  /// lists what can be seen there.
  std::optional<Target> resolve(const Object& from, std::string_view trail, bool want_field,
                                Unresolved& why);

 private:
  /// An object that is seen by a name: a child, or a child of children without a name. The
  /// shallowest counts.
  struct Seen {
    const Object* object = nullptr;
    const Object* rival = nullptr;  ///< another one at the same depth
    int depth = 0;
  };
  using Table = std::unordered_map<std::string_view, Seen>;

  const Table& table(const Object& scope);
  void list(const Object& scope, int depth, Table& table) const;
  /// The rest of the trail, down from `object`.
  std::optional<Target> descend(const Object& object, const std::vector<std::string_view>& parts,
                                std::size_t next, bool want_field, Unresolved& why);
  std::optional<Target> field_of(const Object& object, const std::vector<std::string_view>& parts,
                                 std::size_t next) const;
  /// The child of that name; null, with `why` when there are two.
  const Object* child(const Object& scope, std::string_view name, Unresolved& why);
  std::vector<std::string> names_in(const Object& scope, bool want_field);

  std::unordered_map<const Object*, Table> tables_;
};

/// The object or port that `trail` means at the top of the file; errors in `diagnostics`, without a
/// place. `want_port`: must end in a port that can be wired or recorded (an object alone then means
/// its default output).
std::optional<Reference> resolve(const Object& root, const std::string& trail, bool want_port,
                                 Diagnostics& diagnostics);

/// What stands between the dots of a trail.
std::vector<std::string_view> parts_of_trail(std::string_view trail);
/// The letters by which a field's parts are reached: "xyz", "wxyz", or "".
std::string_view part_letters(const FieldSchema& field);
/// How a trail names part `index` after the field's name: ".x", "[17]".
std::string part_name(const FieldSchema& field, int index);

}  // namespace hookpoint::language
