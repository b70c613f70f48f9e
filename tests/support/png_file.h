// PNG images written by hand, without the library that reads them: stored (uncompressed) blocks of
// RFC 1950 and 1951.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace hookpoint::test_support {

struct PngImage {
  std::uint32_t columns = 2, rows = 2;
  std::uint8_t depth = 8, colour = 0, interlace = 0;  ///< as in the header; colour 0 is gray
  std::string bytes;                                  ///< of the rows, the top one first
};

inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  std::uint32_t crc = 0xffffffffu;
  for (const char letter : checked) {
    crc ^= static_cast<unsigned char>(letter);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
  }
  return big_endian(static_cast<std::uint32_t>(data.size())) + checked + big_endian(~crc);
}

inline std::string zlib_stored(const std::string& data) {
  std::string result = "\x78\x01";
  std::size_t begin = 0;
  do {
    const std::size_t length = std::min<std::size_t>(data.size() - begin, 0xffff);
    const std::size_t inverse = ~length;
    result += begin + length == data.size() ? '\x01' : '\0';
    for (const std::size_t word : {length, inverse}) {
      result += static_cast<char>(word & 0xff);
      result += static_cast<char>(word >> 8 & 0xff);
    }
    result += data.substr(begin, length);
    begin += length;
  } while (begin < data.size());
  std::uint32_t a = 1, b = 0;
  for (const char letter : data) {
    a = (a + static_cast<unsigned char>(letter)) % 65521;
    b = (b + a) % 65521;
  }
  return result + big_endian(b << 16 | a);
}

/// The file's bytes. Every row is preceded by filter 0.
inline std::string png_bytes(const PngImage& image) {
  const std::string header = big_endian(image.columns) + big_endian(image.rows) +
                             static_cast<char>(image.depth) + static_cast<char>(image.colour) +
                             std::string(2, '\0') + static_cast<char>(image.interlace);
  std::string filtered;
  const std::size_t length = image.rows == 0 ? 0 : image.bytes.size() / image.rows;
  for (std::uint32_t row = 0; row < image.rows && length > 0; ++row) {
    filtered += '\0' + image.bytes.substr(row * length, length);
  }
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) +
         png_chunk("IDAT", zlib_stored(filtered)) + png_chunk("IEND", "");
}

inline void write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace hookpoint::test_support
