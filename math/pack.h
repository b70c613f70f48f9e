// Several scalars side by side, one a lane: every operation acts on all lanes at once. A kernel
// written for math/scalar.h runs on a pack unchanged. Built on the compiler's vector types: one AVX
// register for four doubles where there is AVX, else as many of what the machine has.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "math/scalar.h"

namespace hookpoint {

/// The compiler's vector type. GCC 12 loses the attribute of a typedef inside a class template that
/// uses it, so it has a template of its own.
template <class Scalar, std::size_t width>
struct VectorOf {
  typedef Scalar type __attribute__((vector_size(width * sizeof(Scalar))));
};

/// What a comparison of two packs gives: all bits of a lane set where it holds.
template <class Scalar, std::size_t width>
struct PackMask {
  using Vector = typename VectorOf<Scalar, width>::type;
  using Bits = decltype(Vector{} < Vector{});
  Bits bits{};

  PackMask() = default;
  [[gnu::always_inline]] explicit PackMask(const Bits& lanes) : bits(lanes) {}

  [[gnu::always_inline]] friend PackMask operator&&(const PackMask& a, const PackMask& b) {
    return PackMask(a.bits & b.bits);
  }
  [[gnu::always_inline]] friend PackMask operator||(const PackMask& a, const PackMask& b) {
    return PackMask(a.bits | b.bits);
  }
  [[gnu::always_inline]] friend PackMask operator!(const PackMask& a) { return PackMask(~a.bits); }
  [[gnu::always_inline]] friend PackMask select(const PackMask& mask, const PackMask& a,
                                                const PackMask& b) {
    return PackMask(mask.bits ? a.bits : b.bits);
  }
  /// Whether the comparison holds in every lane.
  friend bool all(const PackMask& mask) {
    bool result = true;
    for (std::size_t i = 0; i < width; ++i) result = result && mask.bits[i] != 0;
    return result;
  }
};

template <class Scalar, std::size_t width>
struct Pack {
  using Vector = typename VectorOf<Scalar, width>::type;
  using LaneMask = PackMask<Scalar, width>;
  Vector lanes{};

  Pack() = default;
  /// The same number in every lane (x - 0 is x, also for x = -0).
  [[gnu::always_inline]] Pack(Scalar same) : lanes(same - Vector{}) {}
  [[gnu::always_inline]] explicit Pack(const Vector& each) : lanes(each) {}

  [[gnu::always_inline]] Scalar operator[](std::size_t lane) const { return lanes[lane]; }

  [[gnu::always_inline]] Pack& operator+=(const Pack& b) {
    lanes += b.lanes;
    return *this;
  }
  [[gnu::always_inline]] Pack& operator-=(const Pack& b) {
    lanes -= b.lanes;
    return *this;
  }
  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) {
    return Pack(a.lanes + b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) {
    return Pack(a.lanes - b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) {
    return Pack(a.lanes * b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) {
    return Pack(a.lanes / b.lanes);
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) { return Pack(-a.lanes); }

  [[gnu::always_inline]] friend LaneMask operator<(const Pack& a, const Pack& b) {
    return LaneMask(a.lanes < b.lanes);
  }
  [[gnu::always_inline]] friend LaneMask operator<=(const Pack& a, const Pack& b) {
    return LaneMask(a.lanes <= b.lanes);
  }
  [[gnu::always_inline]] friend LaneMask operator>(const Pack& a, const Pack& b) { return b < a; }
  [[gnu::always_inline]] friend LaneMask operator>=(const Pack& a, const Pack& b) { return b <= a; }
  // Nominally constexpr: clang 14 asks it of what a defaulted constexpr comparison calls.
  [[gnu::always_inline]] friend constexpr LaneMask operator==(const Pack& a, const Pack& b) {
    return LaneMask(a.lanes == b.lanes);
  }

  [[gnu::always_inline]] friend Pack select(const LaneMask& mask, const Pack& a, const Pack& b) {
    return Pack(mask.bits ? a.lanes : b.lanes);
  }
  // As std::max and std::min: of two equal numbers, or beside one that is not a number, the first.
  [[gnu::always_inline]] friend Pack max(const Pack& a, const Pack& b) {
    return select(a < b, b, a);
  }
  [[gnu::always_inline]] friend Pack min(const Pack& a, const Pack& b) {
    return select(b < a, b, a);
  }
  [[gnu::always_inline]] friend Pack abs(const Pack& a) {
    using Bits = typename LaneMask::Bits;
    const Bits sign = Bits(-Vector{});
    return Pack(Vector(Bits(a.lanes) & ~sign));
  }

  friend Pack sqrt(const Pack& a) {
#if defined(__AVX__) && !defined(__clang__)  // clang makes one instruction of the loop
    if constexpr (width == 4 && std::is_same_v<Scalar, double>)
      return Pack(__builtin_ia32_sqrtpd256(a.lanes));
#endif
    Pack result;
    for (std::size_t i = 0; i < width; ++i) result.lanes[i] = std::sqrt(a.lanes[i]);
    return result;
  }
  friend SineCosine<Pack> sine_cosine(const Pack& angle) {
    SineCosine<Pack> result;
    for (std::size_t i = 0; i < width; ++i) {
      const SineCosine<Scalar> lane = sine_cosine(angle.lanes[i]);
      result.sine.lanes[i] = lane.sine;
      result.cosine.lanes[i] = lane.cosine;
    }
    return result;
  }
};

template <class Scalar, std::size_t width>
struct MaskOf<Pack<Scalar, width>> {
  using type = PackMask<Scalar, width>;
};

}  // namespace hookpoint
