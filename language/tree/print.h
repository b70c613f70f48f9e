// The tree as a file.
#pragma once

#include <string>

#include "language/tree/object.h"

namespace hookpoint::language {

/// The tree as a file: what was given, as SI values in the shortest form that reads back to the
/// same double; references as trails from the top.
std::string print(const Object& root);

}  // namespace hookpoint::language
