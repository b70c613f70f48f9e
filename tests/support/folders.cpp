#include "tests/support/folders.h"

namespace hookpoint::testing {

std::string source_folder() { return HOOKPOINT_SOURCE_DIR; }

std::string build_folder() { return HOOKPOINT_BINARY_DIR; }

}  // namespace hookpoint::testing
