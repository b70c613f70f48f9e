// URDF that is written with xacro, the macros of ROS: expanded by its own program, where that is
// installed.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "language/report.h"
#include "language/syntax/files.h"
#include "language/tree/foreign.h"

namespace hookpoint::simulation {

/// A file as it is to be read, and which arguments it has taken.
struct ExpandedUrdf {
  const language::SourceFile* source = nullptr;  ///< null after an error
  std::vector<std::string> arguments;            ///< names
};

/// The file itself; or, if it uses elements of xacro or is called .xacro, what `xacro FILE
/// NAME:=VALUE
/// ...` makes of it, which `files` keeps. Given are those of `arguments` that the file declares as
/// an xacro:arg and that are none of `own`. No shell sees them; the program is stopped after 60 s
/// and beyond 64 MB. Once a store, however often it is called.
ExpandedUrdf expand_xacro(const language::SourceFile& file,
                          const language::ForeignArguments& arguments,
                          std::span<const char* const> own, language::FileStore& files,
                          language::Report& report);

}  // namespace hookpoint::simulation
