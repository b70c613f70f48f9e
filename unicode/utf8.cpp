#include "unicode/utf8.h"

#include <utf8proc.h>

#include <algorithm>

namespace hookpoint::output {

std::u32string code_points(std::string_view utf8) {
  constexpr char32_t replacement = 0xfffd;
  std::u32string points;
  const auto continues = [&](std::size_t i) {
    return i < utf8.size() && (static_cast<unsigned char>(utf8[i]) & 0xc0U) == 0x80U;
  };
  for (std::size_t i = 0; i < utf8.size();) {
    utf8proc_int32_t point = 0;
    const auto length = utf8proc_iterate(reinterpret_cast<const utf8proc_uint8_t*>(utf8.data() + i),
                                         static_cast<utf8proc_ssize_t>(utf8.size() - i), &point);
    points += length > 0 ? static_cast<char32_t>(point) : replacement;
    i += static_cast<std::size_t>(std::max<utf8proc_ssize_t>(length, 1));
    while (length <= 0 && continues(i)) ++i;
  }
  return points;
}

std::string repaired(std::string_view utf8) {
  std::string text;
  for (const char32_t point : code_points(utf8)) {
    utf8proc_uint8_t bytes[4];
    const utf8proc_ssize_t length =
        utf8proc_encode_char(static_cast<utf8proc_int32_t>(point), bytes);
    text.append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(length));
  }
  return text;
}

std::u16string utf16(std::string_view utf8) {
  std::u16string units;
  for (const char32_t point : code_points(utf8)) {
    if (point < 0x10000) {
      units += static_cast<char16_t>(point);
      continue;
    }
    units += static_cast<char16_t>(0xd800 + ((point - 0x10000) >> 10U));
    units += static_cast<char16_t>(0xdc00 + ((point - 0x10000) & 0x3ffU));
  }
  return units;
}

}  // namespace hookpoint::output
