// UTF-8 as it is shown on a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hookpoint::text {

/// Where the first control character of `text` stands, npos without any.
std::size_t find_control(std::string_view text);

/// The text fit for a terminal: what cannot be shown or would command it becomes one '?' a byte. A
/// tab stays where `tabs`.
std::string printable(std::string_view text, bool tabs = false);

/// The first characters of `text`, whole, in at most `most` bytes.
std::string_view first_characters(std::string_view text, std::size_t most);

/// The columns that `printable` text takes, a tab as one.
std::size_t display_width(std::string_view text);

}  // namespace hookpoint::text
