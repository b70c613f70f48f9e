#include "output/records/shuffled_chunk.h"

#include <new>

#include "output/files/file.h"

namespace hookpoint::output {
namespace {

constexpr std::size_t bytes = sizeof(std::uint64_t);

}  // namespace

ShuffledChunk::ShuffledChunk(std::size_t count, int level) : planes_(count * bytes) {
  if (deflateInit2(&deflate_, level, Z_DEFLATED, MAX_WBITS, 8, Z_RLE) != Z_OK)
    throw std::bad_alloc();  // all else that it checks is constant
  encoded_.resize(deflateBound(&deflate_, static_cast<uLong>(planes_.size())));
}

ShuffledChunk::~ShuffledChunk() { deflateEnd(&deflate_); }

// Byte b of all numbers beside one another, the lowest first: what changes little compresses well.
std::span<const unsigned char> ShuffledChunk::encode(std::span<const std::uint64_t> values) {
  const std::size_t count = planes_.size() / bytes;
  for (std::size_t b = 0; b < bytes; ++b) {
    unsigned char* plane = planes_.data() + b * count;
    for (std::size_t i = 0; i < count; ++i)
      plane[i] = static_cast<unsigned char>(values[i] >> (8 * b));
  }
  deflateReset(&deflate_);
  deflate_.next_in = planes_.data();
  deflate_.avail_in = static_cast<uInt>(planes_.size());
  deflate_.next_out = encoded_.data();
  deflate_.avail_out = static_cast<uInt>(encoded_.size());
  if (deflate(&deflate_, Z_FINISH) != Z_STREAM_END) throw FileError("a movie was not compressed");
  return {encoded_.data(), encoded_.size() - deflate_.avail_out};
}

}  // namespace hookpoint::output
