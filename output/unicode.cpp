#include "output/unicode.h"

#include <bit>

namespace hookpoint::output {

std::u32string code_points(std::string_view utf8) {
  constexpr char32_t replacement = 0xfffd;
  std::u32string points;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[i++]);
    // The ones in front of the lead byte count the bytes of the sequence: 0 for ASCII, 1 for a byte
    // that continues one.
    const int length = std::countl_one(lead);
    char32_t point = length == 0 ? lead : lead & (0xffU >> (length + 1));
    bool good = length == 0 || (length >= 2 && length <= 4);
    for (int k = 1; good && k < length; ++k) {
      good = i < utf8.size() && (static_cast<unsigned char>(utf8[i]) & 0xc0U) == 0x80U;
      if (good) point = point << 6U | (static_cast<unsigned char>(utf8[i++]) & 0x3fU);
    }
    points += good && point <= 0x10ffff ? point : replacement;
  }
  return points;
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
