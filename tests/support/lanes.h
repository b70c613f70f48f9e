// A pack of two scalars with lane masks, the least that a kernel may ask of its `Real`
// (math/scalar.h): a kernel that branches on state does not compile with it, or gives one lane the
// other's answer.
#pragma once

#include <array>
#include <cmath>

#include "math/scalar.h"

namespace hookpoint::test_support {

struct LaneMask {
  std::array<bool, 2> lane{};
};
inline LaneMask operator&&(LaneMask a, LaneMask b) {
  return {{a.lane[0] && b.lane[0], a.lane[1] && b.lane[1]}};
}
inline LaneMask select(LaneMask mask, LaneMask a, LaneMask b) {
  return {{mask.lane[0] ? a.lane[0] : b.lane[0], mask.lane[1] ? a.lane[1] : b.lane[1]}};
}

struct Lanes {
  std::array<double, 2> lane{};
  constexpr Lanes() = default;
  constexpr Lanes(double both) : lane{both, both} {}
  constexpr Lanes(double first, double second) : lane{first, second} {}
  constexpr Lanes& operator+=(const Lanes& b) {
    return *this = {lane[0] + b.lane[0], lane[1] + b.lane[1]};
  }
  constexpr Lanes& operator-=(const Lanes& b) {
    return *this = {lane[0] - b.lane[0], lane[1] - b.lane[1]};
  }
  friend constexpr Lanes operator+(Lanes a, const Lanes& b) { return a += b; }
  friend constexpr Lanes operator-(Lanes a, const Lanes& b) { return a -= b; }
  friend constexpr Lanes operator-(const Lanes& a) { return {-a.lane[0], -a.lane[1]}; }
  friend constexpr Lanes operator*(const Lanes& a, const Lanes& b) {
    return {a.lane[0] * b.lane[0], a.lane[1] * b.lane[1]};
  }
  friend constexpr Lanes operator/(const Lanes& a, const Lanes& b) {
    return {a.lane[0] / b.lane[0], a.lane[1] / b.lane[1]};
  }
  friend LaneMask operator>(const Lanes& a, const Lanes& b) {
    return {{a.lane[0] > b.lane[0], a.lane[1] > b.lane[1]}};
  }
};
inline Lanes select(LaneMask mask, const Lanes& a, const Lanes& b) {
  return {mask.lane[0] ? a.lane[0] : b.lane[0], mask.lane[1] ? a.lane[1] : b.lane[1]};
}
template <class Function>
Lanes each(Function f, const Lanes& a, const Lanes& b = {}) {
  return {f(a.lane[0], b.lane[0]), f(a.lane[1], b.lane[1])};
}
inline Lanes max(const Lanes& a, const Lanes& b) {
  return each([](double x, double y) { return x > y ? x : y; }, a, b);
}
inline Lanes min(const Lanes& a, const Lanes& b) {
  return each([](double x, double y) { return x < y ? x : y; }, a, b);
}
inline Lanes pow(const Lanes& a, const Lanes& b) {
  return each([](double x, double y) { return std::pow(x, y); }, a, b);
}
inline Lanes sqrt(const Lanes& a) {
  return each([](double x, double) { return std::sqrt(x); }, a);
}
inline SineCosine<Lanes> sine_cosine(const Lanes& angle) {
  return {each([](double x, double) { return std::sin(x); }, angle),
          each([](double x, double) { return std::cos(x); }, angle)};
}
inline Lanes exp(const Lanes& a) {
  return each([](double x, double) { return std::exp(x); }, a);
}

}  // namespace hookpoint::test_support

template <>
struct hookpoint::MaskOf<hookpoint::test_support::Lanes> {
  using type = hookpoint::test_support::LaneMask;
};
