// The evaluated experiment: a tree of objects whose fields hold checked SI values. Includes, loops,
// variables and expressions are gone; `print` writes it back as a valid file.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "language/dimension.h"
#include "language/schema/schema.h"
#include "language/source.h"

namespace hookpoint::language {

class Object;
struct Formula;

/// A reference to a port or object by its trail, resolved where possible.
struct Reference {
  std::string trail;               ///< as written
  const Object* object = nullptr;  ///< the object reached
  std::string port;  ///< what follows it: "location.x"; "" when the object itself is meant
  Position position;
};

/// A field as assigned (or defaulted). Exactly the member that the schema's type names is filled.
struct Field {
  const FieldSchema* schema = nullptr;
  bool given = false;              ///< written in the file (or set from outside), not a default
  bool from_outside = false;       ///< set from outside the file, or worked out of Params that were
  std::vector<double> numbers;     ///< number, integer, numbers (SI); orientation: w, x, y, z,
                                   ///< normalised; boolean: 0 or 1
  std::vector<std::string> words;  ///< text, choice, words; of numbers the words in their place
  std::vector<bool> quoted;        ///< of numbers: which of the words in their place are strings
  std::vector<Position> places;    ///< of each of several `words`
  Reference reference;             ///< object, port
  std::shared_ptr<const Formula> formula;  ///< formula
  Dimension dimension;  ///< of `numbers` where the schema's unit is "?" (else the schema's)
  /// Of the first number in that dimension, as it is written ("deg"), where the schema's unit is
  /// "?"; "" when none is written.
  std::string unit;
  Position position;  ///< of the value
};

/// A Param that is one number.
struct ParameterValue {
  std::string name;
  double value = 0.;  ///< SI
  Dimension dimension;
};

struct Wire {
  std::optional<Reference> from, to;
  std::vector<Field> fields;  ///< rate, delay, noise
  Position position;
};

class Object {
 public:
  const ClassSchema* schema = nullptr;
  std::string type;    ///< "Base.mobile"
  std::string name;    ///< "leg[2]"; the class's default name when unnamed; may be ""
  bool named = false;  ///< the name was written
  Position position;   ///< of the type
  const Object* parent = nullptr;
  bool implicit = false;  ///< not written: stands at the top of every file (ClassSchema::implicit)
  std::vector<Field>
      fields;  ///< the given ones, in the schema's order; defaults are shared and found by find()
  const std::vector<Field>* defaults =
      nullptr;  ///< of the fields that have one; the Library owns them
  std::vector<std::unique_ptr<Object>> children;
  std::vector<Wire> wires;
  /// Of the root: the libraries that its files name, as absolute paths, each once.
  std::vector<std::string> plugins;
  /// Of the root: the Params of its file that are one number.
  std::vector<ParameterValue> parameters;

  /// The field if it is given or has a default, else null.
  const Field* find(std::string_view field) const;
  /// Given in the file, not a default.
  bool given(std::string_view field) const;
  /// The value; the schema guarantees that it exists (given, required or defaulted): asking for
  /// another is misuse (assertion).
  double number(std::string_view field) const;
  const std::vector<double>& numbers(std::string_view field) const;
  const std::string& word(std::string_view field) const;
  const Object* object(std::string_view field) const;
  bool boolean(std::string_view field) const;
  /// Whether the field is in its other unit, since the choice that requires it has been made.
  bool in_other_unit(const FieldSchema& field) const;
  /// The unit of one of the class's fields in this object.
  const std::string& unit_of(const FieldSchema& field) const;
  /// Children whose type is `type` or, when it ends in '.', begins with it, in file order. What
  /// stands in a Group (a named Include) counts as standing in the Group's parent.
  std::vector<const Object*> children_of(std::string_view type) const;
  /// Names of the objects from the top down to this one joined by '.', objects without a name left
  /// out.
  std::string trail() const;
};

}  // namespace hookpoint::language
