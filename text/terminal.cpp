#include "text/terminal.h"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace hookpoint::text {
namespace {

/// An unset variable is empty.
std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

bool is_able_terminal(int descriptor) {
  return isatty(descriptor) == 1 && !variable("TERM").empty() && variable("TERM") != "dumb";
}

bool wants_colours(int descriptor) {
  return is_able_terminal(descriptor) && variable("NO_COLOR").empty();
}

}  // namespace hookpoint::text
