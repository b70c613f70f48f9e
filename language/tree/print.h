// The tree as a file.
#pragma once

#include <string>

#include "language/tree/object.h"

namespace hookpoint::language {

/// The tree as a file: what was given, as SI values in the shortest form that reads back to the
/// same double; references as trails from the top. What stands in files of its own is included.
std::string print(const Object& root);
/// The value of one of `object`'s fields, as that file has it.
std::string print_value(const Object& root, const Object& object, const Field& field);
/// The text in quotes, as the language reads it back.
std::string quote(const std::string& text);

}  // namespace hookpoint::language
