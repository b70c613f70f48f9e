// Numbers and strings in Wolfram Language syntax, the same on reading as they were.
#pragma once

#include <string>
#include <string_view>

namespace hookpoint::output {

/// `value` as a machine real: 1.5*^-9, 3., 0.30000000000000004`; Infinity, -Infinity,
/// Indeterminate. The backquote keeps a literal of more than 15 digits a machine number, where it
/// would become one of arbitrary precision. Appends without a temporary.
void append_wolfram_real(std::string& text, double value);

/// In quotes, escaped; what is not ASCII as \:hhhh or \|hhhhhh, which every version reads whatever
/// its encoding.
std::string wolfram_string(std::string_view utf8);

}  // namespace hookpoint::output
