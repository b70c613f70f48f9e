// The values of a JSON document by their paths: enough to read back what JsonWriter wrote.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hookpoint::output {

/// Every leaf in the document's order: {"engines.ode.version", "0.16.2"}, {"seeds[0]", "1"}. A
/// text without its quotes and escapes; numbers, true, false and null as written; an empty object
/// or list has no leaf. Nothing when `text` is not JSON, or has objects and lists more than 64
/// within one another or with a path of more than 512 bytes.
std::optional<std::vector<std::pair<std::string, std::string>>> json_leaves(std::string_view text);

}  // namespace hookpoint::output
