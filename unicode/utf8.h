// UTF-8 taken apart, for formats that have their own idea of text.
#pragma once

#include <string>
#include <string_view>

namespace hookpoint::output {

/// The code points of `utf8`; bytes that make none are U+FFFD.
std::u32string code_points(std::string_view utf8);

/// The same as UTF-8: `utf8` itself where it is good.
std::string repaired(std::string_view utf8);

/// UTF-16, with surrogate pairs above U+FFFF.
std::u16string utf16(std::string_view utf8);

}  // namespace hookpoint::output
