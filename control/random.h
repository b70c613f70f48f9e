// Noise that can be repeated: a stream is a key, and its n-th number a function of key and n alone.
// Nothing is stored and no stream can disturb another.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hookpoint::control {

/// Philox4x32-10: ten rounds of a keyed bijection of 128 bits.
/// Source: Salmon, Moraes, Dror & Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011,
/// section 3.3.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

/// The key of the stream at `place`, a trail of the file ("bot.leg1.link1.angle -> pd1.current"),
/// in an experiment of seed `seed`: FNV-1a of the text, mixed with the seed. Other objects do not
/// enter.
std::uint64_t stream_key(std::uint64_t seed, std::string_view place);

class RandomStream {
 public:
  RandomStream() = default;
  /// `channel` tells apart the streams of one owner (the three axes of an accelerometer).
  explicit RandomStream(std::uint64_t key, std::uint32_t channel = 0)
      : key_(key), channel_(channel) {}

  /// The n-th number of the stream, uniform in (0, 1].
  double uniform(std::uint64_t n) const;
  /// The n-th number of the stream, normal with mean 0 and variance 1 (Box & Muller 1958; |.|
  /// < 8.6).
  double gaussian(std::uint64_t n) const;

 private:
  std::uint64_t key_ = 0;
  std::uint32_t channel_ = 0;
};

}  // namespace hookpoint::control
