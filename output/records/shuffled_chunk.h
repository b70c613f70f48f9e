// A chunk of an HDF5 dataset as the library's filters `shuffle` and `deflate` make it of 8-byte
// numbers, made here: without the library's copies, and once only where nothing changes.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <span>
#include <vector>

namespace hookpoint::output {

class ShuffledChunk {
 public:
  /// Of `count` numbers; `level` of deflate, 1 (fast) to 9 (small). Throws FileError.
  ShuffledChunk(std::size_t count, int level);
  ~ShuffledChunk();
  ShuffledChunk(const ShuffledChunk&) = delete;
  ShuffledChunk& operator=(const ShuffledChunk&) = delete;

  /// `values`: the bits of the numbers. The bytes are valid until the next call. O(count).
  std::span<const unsigned char> encode(std::span<const std::uint64_t> values);
  /// No chunk is longer [bytes].
  std::size_t longest() const { return encoded_.size(); }

 private:
  z_stream deflate_{};
  std::vector<unsigned char> planes_, encoded_;
};

}  // namespace hookpoint::output
