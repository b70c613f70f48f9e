// Constants of a shared library, read from its file: nothing is mapped for execution, nothing runs.
#pragma once

#include <string>
#include <string_view>

namespace hookpoint::control {

struct ElfConstant {
  std::string bytes;    ///< of the constant, as they stand in the file
  std::string problem;  ///< "" or why there are none, as a predicate to the file
};

/// The object that the library in `file` (all of its bytes) exports as `symbol`. Any bytes are
/// safe: every offset is checked against the file. Format: System V ABI, "Object Files"; 64 bit,
/// byte order and processor of this program.
ElfConstant read_constant(std::string_view file, std::string_view symbol);

}  // namespace hookpoint::control
