// UTF-8 taken apart, for formats that have their own idea of text.
#pragma once

#include <string>
#include <string_view>

namespace hookpoint::output {

/// The code points of `utf8`; a byte that belongs to none is U+FFFD.
std::u32string code_points(std::string_view utf8);

/// UTF-16, with surrogate pairs above U+FFFF.
std::u16string utf16(std::string_view utf8);

}  // namespace hookpoint::output
