#include "control/random.h"

#include <cmath>
#include <numbers>

namespace hookpoint::control {
namespace {

/// Uniform in (0, 1]: the upper 53 bits, never zero so that its logarithm is finite.
double unit(std::uint32_t high, std::uint32_t low) {
  const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 11;
  return (static_cast<double>(bits) + 1.) * 0x1p-53;
}

std::array<std::uint32_t, 4> draw(std::uint64_t key, std::uint32_t channel, std::uint64_t n) {
  return philox({static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(n >> 32), channel, 0},
                {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)});
}

/// Stafford's mix 13, a bijection of 64 bits (Steele, Lea & Flood, OOPSLA 2014, "Fast splittable
/// pseudorandom number generators").
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xd2511f53u} * counter[0];
    const std::uint64_t b = std::uint64_t{0xcd9e8d57u} * counter[2];
    counter = {
        static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
        static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9e3779b9u;
    key[1] += 0xbb67ae85u;
  }
  return counter;
}

std::uint64_t stream_key(std::uint64_t seed, std::string_view place) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char letter : place) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3u;
  }
  return mix(hash ^ mix(seed + 0x9e3779b97f4a7c15u));
}

double RandomStream::uniform(std::uint64_t n) const {
  const auto bits = draw(key_, channel_, n);
  return unit(bits[0], bits[1]);
}

double RandomStream::gaussian(std::uint64_t n) const {
  const auto bits = draw(key_, channel_, n);
  const double radius = std::sqrt(-2. * std::log(unit(bits[0], bits[1])));
  return radius * std::cos(2. * std::numbers::pi * unit(bits[2], bits[3]));
}

}  // namespace hookpoint::control
