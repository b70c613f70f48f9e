#include "text/number.h"

#include <array>
#include <charconv>
#include <cmath>

namespace hookpoint::text {
namespace {

using Buffer = std::array<char, 64>;

/// std::to_chars prints a sign on a NaN whose sign bit is set; which NaN it was is noise.
double without_nan_sign(double value) { return std::isnan(value) ? std::abs(value) : value; }

std::string general(double value, int digits) {
  Buffer buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                 without_nan_sign(value), std::chars_format::general, digits);
  return {buffer.data(), end.ptr};
}

}  // namespace

void append_shortest(std::string& text, double value) {
  Buffer buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), without_nan_sign(value));
  text.append(buffer.data(), end.ptr);
}

std::string shortest(double value) {
  std::string text;
  append_shortest(text, value);
  return text;
}

std::string shortest(const std::optional<double>& value, std::string_view otherwise) {
  return value ? shortest(*value) : std::string(otherwise);
}

std::string seventeen_digits(double value) { return general(value, 17); }

std::string rounded(double value, int digits) {
  const double magnitude = std::abs(value);
  if (value == 0.) return "0";
  // `general` turns scientific once the exponent reaches the number of digits; a table reads better
  // as 12500 than 1.25e+04.
  if (magnitude >= std::pow(10., digits) && magnitude < 1e6) return general(std::round(value), 7);
  return general(value, digits);
}

std::string rounded(const std::optional<double>& value, std::string_view otherwise, int digits) {
  return value ? rounded(*value, digits) : std::string(otherwise);
}

}  // namespace hookpoint::text
