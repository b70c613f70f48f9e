// Files in a format that is not the language's own and that an Include may name all the same. Who
// knows the format gives the Schema a reader; what it returns is evaluated as if a .hook file had
// said it, and checked by the same fields.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "language/report.h"
#include "language/values/value.h"

namespace hookpoint::language {

/// A field and its values as an expression would have yielded them: SI, their own places.
struct ForeignField {
  std::string name;
  std::vector<Value> values;
  Position position;
};

/// A wire in an object: trails as a file would write them there.
struct ForeignWire {
  std::string from, to;
};

/// An object; `type` is a class of the Schema, `name` an identifier of the language or "".
struct ForeignObject {
  std::string type, name;
  Position position;
  std::vector<ForeignField> fields;
  std::vector<ForeignObject> children;
  std::vector<ForeignWire> wires = {};
};

/// The arguments of the Include, by name; without values where they were wrong, and said to be.
struct ForeignArguments : std::map<std::string, ForeignField> {};

}  // namespace hookpoint::language
