// One value of the language outside of any file.
#pragma once

#include <optional>
#include <string>

namespace hookpoint::language {

/// The value of `text` ("2 * 3 ms") as a field that takes one number in `unit` would have it, in
/// SI; nothing when such a field would refuse it.
std::optional<double> number_of(const std::string& text, const std::string& unit);

}  // namespace hookpoint::language
