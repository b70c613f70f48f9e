// The fields of a file that a user may edit while its run continues.
#pragma once

#include <string>
#include <vector>

#include "language/tree/object.h"

namespace hookpoint::view {

struct FileField {
  std::string trail;  ///< from the top: "SimpleWorld.clay.normal_stiffness"
  std::string value;  ///< as `--set` takes it
  std::string unit;
  std::string doc;  ///< one line
};

/// Of every object of the experiment, what was given and what has a default; not of the windows,
/// nor what names another object: a run has its parts for its life. O(fields).
std::vector<FileField> file_fields(const language::Object& root);

}  // namespace hookpoint::view
