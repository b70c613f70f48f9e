// The hash that names a run's folder.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::studies {

/// FNV-1a, 64 bits, of texts one after the other.
class Hash {
 public:
  void add(std::string_view text) {
    for (const char c : text) {
      state_ ^= static_cast<unsigned char>(c);
      state_ *= 1099511628211ull;
    }
    state_ ^= text.size();
  }
  /// The bytes of files: what the plugins of a scene are, not only where. A controller built anew is
  /// another experiment.
  void add_files(const std::vector<std::string>& files) {
    for (const std::string& file : files) {
      std::ostringstream bytes;
      bytes << std::ifstream(file, std::ios::binary).rdbuf();
      add(bytes.str());
    }
  }
  /// 10 hexadecimal digits.
  std::string text() const { return fmt::format("{:010x}", state_ >> 24); }

 private:
  std::uint64_t state_ = 14695981039346656037ull;
};

}  // namespace hookpoint::studies
