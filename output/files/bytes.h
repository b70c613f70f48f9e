// Binary fields as files have them: little-endian whatever the machine.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace hookpoint::output {

/// Appends the `sizeof(Integer)` bytes of `value`, lowest first.
template <std::unsigned_integral Integer>
void append_integer(std::string& bytes, Integer value) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i)
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xffU);
}

inline void append_double(std::string& bytes, double value) {
  append_integer(bytes, std::bit_cast<std::uint64_t>(value));
}

/// A length of 32 bits, then the bytes.
inline void append_string(std::string& bytes, std::string_view text) {
  append_integer(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

/// Reads back what the functions above wrote. Past the end everything is zero or empty, and `good`
/// is false.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <std::unsigned_integral Integer>
  Integer integer() {
    const std::string_view field = take(sizeof(Integer));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < field.size(); ++i)
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(field[i])) << (8 * i);
    return static_cast<Integer>(value);
  }
  double real() { return std::bit_cast<double>(integer<std::uint64_t>()); }
  std::string_view string() { return take(integer<std::uint32_t>()); }
  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) {
      good_ = false;
      bytes_ = {};
      return {};
    }
    const std::string_view field = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return field;
  }
  std::string_view rest() const { return bytes_; }
  bool good() const { return good_; }

 private:
  std::string_view bytes_;
  bool good_ = true;
};

}  // namespace hookpoint::output
