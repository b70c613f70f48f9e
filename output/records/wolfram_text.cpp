#include "output/records/wolfram_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "text/utf8.h"

namespace hookpoint::output {
namespace {

void append_hexadecimal(std::string& text, std::uint32_t value, int digits) {
  for (int i = digits - 1; i >= 0; --i) text += "0123456789abcdef"[value >> (4 * i) & 0xfU];
}

}  // namespace

void append_wolfram_real(std::string& text, double value) {
  if (std::isnan(value)) {
    text += "Indeterminate";
    return;
  }
  if (std::isinf(value)) {
    text += value > 0. ? "Infinity" : "-Infinity";
    return;
  }
  std::array<char, 64> buffer;
  const char* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                        std::chars_format::scientific)
                              .ptr;
  // d.ddde-09: the mantissa up to the e, then the exponent without its plus and leading zeros.
  const std::string_view all(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
  const std::size_t split = all.find('e');
  const std::string_view mantissa = all.substr(0, split);
  text += mantissa;
  const bool fraction = mantissa.find('.') != std::string_view::npos;
  if (!fraction) text += '.';
  const std::size_t digits = mantissa.size() - (mantissa[0] == '-') - (fraction ? 1 : 0);
  if (digits > 15) text += '`';
  int exponent = 0;
  const std::size_t sign = all[split + 1] == '+' ? 1 : 0;
  std::from_chars(buffer.data() + split + 1 + sign, end, exponent);
  if (exponent == 0) return;
  text += "*^";
  const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), exponent);
  text.append(buffer.data(), written.ptr);
}

std::string wolfram_string(std::string_view utf8) {
  std::string text = "\"";
  for (const char32_t point : text::code_points(utf8)) {
    if (point == '"' || point == '\\') {
      text += '\\';
      text += static_cast<char>(point);
    } else if (point == '\n') {
      text += "\\n";
    } else if (point == '\t') {
      text += "\\t";
    } else if (point >= 0x20 && point < 0x7f) {
      text += static_cast<char>(point);
    } else if (point < 0x10000) {
      text += "\\:";
      append_hexadecimal(text, point, 4);
    } else {
      text += "\\|";
      append_hexadecimal(text, point, 6);
    }
  }
  return text + '"';
}

}  // namespace hookpoint::output
