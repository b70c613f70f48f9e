// Structures of numbers, such as a vector or a wrench, to and from structures of packs that hold
// one of them a lane. `Structure<Real>` is any template that has `Real`s, or such structures of
// them, for members and nothing else.
#pragma once

#include <cstring>

#include "math/pack.h"

namespace hookpoint {

/// How many numbers a structure has.
template <template <class> class Structure>
constexpr std::size_t number_count = sizeof(Structure<double>) / sizeof(double);

/// A structure's numbers in order.
template <template <class> class Structure, class Real>
[[gnu::always_inline]] inline Real* numbers_of(Structure<Real>& x) {
  return reinterpret_cast<Real*>(&x);
}
template <template <class> class Structure, class Real>
[[gnu::always_inline]] inline const Real* numbers_of(const Structure<Real>& x) {
  return reinterpret_cast<const Real*>(&x);
}

/// Lanes of two vectors by their numbers, those of `b` counted on from those of `a`.
template <int... lanes, class Vector>
[[gnu::always_inline]] inline Vector picked(const Vector& a, const Vector& b) {
#if __has_builtin(__builtin_shufflevector)
  return __builtin_shufflevector(a, b, lanes...);
#else  // GCC 11
  return __builtin_shuffle(a, b, decltype(a < b){lanes...});
#endif
}

/// Four packs as the rows of a matrix, turned into its columns.
template <class Scalar>
[[gnu::always_inline]] inline std::array<Pack<Scalar, 4>, 4> transposed(
    const std::array<Pack<Scalar, 4>, 4>& rows) {
  using P = Pack<Scalar, 4>;
  const auto& [a, b, c, d] = rows;
  const auto ab_even = picked<0, 4, 2, 6>(a.lanes, b.lanes);
  const auto ab_odd = picked<1, 5, 3, 7>(a.lanes, b.lanes);
  const auto cd_even = picked<0, 4, 2, 6>(c.lanes, d.lanes);
  const auto cd_odd = picked<1, 5, 3, 7>(c.lanes, d.lanes);
  return {P(picked<0, 1, 4, 5>(ab_even, cd_even)), P(picked<0, 1, 4, 5>(ab_odd, cd_odd)),
          P(picked<2, 3, 6, 7>(ab_even, cd_even)), P(picked<2, 3, 6, 7>(ab_odd, cd_odd))};
}

/// Calls `block(n)` with the first of every four of `count` numbers; where four do not divide them,
/// the last block overlaps the one before.
template <std::size_t count, class Block>
[[gnu::always_inline]] inline void in_blocks_of_four(const Block& block) {
  static_assert(count >= 4);
  for (std::size_t n = 0; n < count; n += 4) block(n + 4 <= count ? n : count - 4);
}

/// Lane i from the number `*lanes[i]`.
template <class Scalar>
[[gnu::always_inline]] inline Pack<Scalar, 4> gather(const std::array<const Scalar*, 4>& lanes) {
  return Pack<Scalar, 4>(
      typename Pack<Scalar, 4>::Vector{*lanes[0], *lanes[1], *lanes[2], *lanes[3]});
}
/// Lane i to the number `*lanes[i]`.
template <class Scalar>
[[gnu::always_inline]] inline void scatter(const Pack<Scalar, 4>& pack,
                                           const std::array<Scalar*, 4>& lanes) {
  for (std::size_t i = 0; i < 4; ++i) *lanes[i] = pack[i];
}

/// Lane i from `*lanes[i]`.
template <template <class> class Structure, class Scalar>
[[gnu::always_inline]] inline Structure<Pack<Scalar, 4>> gather(
    const std::array<const Structure<Scalar>*, 4>& lanes) {
  Structure<Pack<Scalar, 4>> packs;
  in_blocks_of_four<number_count<Structure>>([&](std::size_t n) {
    std::array<Pack<Scalar, 4>, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) {
      std::memcpy(&rows[i].lanes, numbers_of(*lanes[i]) + n, sizeof rows[i].lanes);
    }
    const auto columns = transposed(rows);
    for (std::size_t i = 0; i < 4; ++i) numbers_of(packs)[n + i] = columns[i];
  });
  return packs;
}
/// Lane i to `*lanes[i]`.
template <template <class> class Structure, class Scalar>
[[gnu::always_inline]] inline void scatter(const Structure<Pack<Scalar, 4>>& packs,
                                           const std::array<Structure<Scalar>*, 4>& lanes) {
  const Pack<Scalar, 4>* const columns = numbers_of(packs);
  in_blocks_of_four<number_count<Structure>>([&](std::size_t n) {
    const auto rows =
        transposed<Scalar>({columns[n], columns[n + 1], columns[n + 2], columns[n + 3]});
    for (std::size_t i = 0; i < 4; ++i) {
      std::memcpy(numbers_of(*lanes[i]) + n, &rows[i].lanes, sizeof rows[i].lanes);
    }
  });
}

/// `x` in every lane.
template <class Lanes, template <class> class Structure, class Scalar>
[[gnu::always_inline]] inline Structure<Lanes> in_all_lanes(const Structure<Scalar>& x) {
  Structure<Lanes> packs;
  for (std::size_t n = 0; n < number_count<Structure>; ++n) {
    numbers_of(packs)[n] = numbers_of(x)[n];
  }
  return packs;
}

/// The structure in lane `lane`.
template <template <class> class Structure, class Scalar, std::size_t width>
inline Structure<Scalar> lane_of(const Structure<Pack<Scalar, width>>& packs, std::size_t lane) {
  Structure<Scalar> result;
  for (std::size_t n = 0; n < number_count<Structure>; ++n) {
    numbers_of(result)[n] = numbers_of(packs)[n][lane];
  }
  return result;
}
/// Puts `x` into lane `lane`.
template <template <class> class Structure, class Scalar, std::size_t width>
inline void set_lane(Structure<Pack<Scalar, width>>& packs, std::size_t lane,
                     const Structure<Scalar>& x) {
  for (std::size_t n = 0; n < number_count<Structure>; ++n) {
    numbers_of(packs)[n].lanes[lane] = numbers_of(x)[n];
  }
}

/// `packs` in the lanes where `mask` holds, zero elsewhere.
template <template <class> class Structure, class Lanes>
[[gnu::always_inline]] inline Structure<Lanes> only(const Mask<Lanes>& mask,
                                                    Structure<Lanes> packs) {
  for (std::size_t n = 0; n < number_count<Structure>; ++n) {
    Lanes& number = numbers_of(packs)[n];
    number = select(mask, number, Lanes(0.));
  }
  return packs;
}
/// The sum of the structures in all lanes, pairwise.
template <template <class> class Structure, class Scalar>
[[gnu::always_inline]] inline Structure<Scalar> lane_sum(const Structure<Pack<Scalar, 4>>& packs) {
  const Pack<Scalar, 4>* const columns = numbers_of(packs);
  Structure<Scalar> sums;
  in_blocks_of_four<number_count<Structure>>([&](std::size_t n) {
    const auto rows =
        transposed<Scalar>({columns[n], columns[n + 1], columns[n + 2], columns[n + 3]});
    const Pack<Scalar, 4> sum = (rows[0] + rows[1]) + (rows[2] + rows[3]);
    std::memcpy(numbers_of(sums) + n, &sum.lanes, sizeof sum.lanes);
  });
  return sums;
}

}  // namespace hookpoint
