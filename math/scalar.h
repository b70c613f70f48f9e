// What a kernel asks of its scalar: a comparison mask, select, and the elementary functions. A
// kernel written with these runs on double and, unchanged, on a pack that holds one simulation a
// lane.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace hookpoint {

/// The type of a comparison of two `Real`s: bool for double; a pack specialises this with its lane
/// mask.
template <class Real>
struct MaskOf {
  using type = bool;
};
template <class Real>
using Mask = typename MaskOf<Real>::type;

/// `a` where `mask` holds, else `b`. Both are evaluated: that is what makes a law run in lanes.
inline double select(bool mask, double a, double b) { return mask ? a : b; }
inline bool select(bool mask, bool a, bool b) { return mask ? a : b; }

/// Whether a comparison holds in every lane.
inline bool all(bool mask) { return mask; }

/// The greater (lesser) of two scalars, found by argument-dependent lookup for packs.
inline double max(double a, double b) { return std::max(a, b); }
inline double min(double a, double b) { return std::min(a, b); }

/// Sine and cosine of one angle [rad].
template <class Real>
struct SineCosine {
  Real sine, cosine;
};
inline SineCosine<double> sine_cosine(double angle) { return {std::sin(angle), std::cos(angle)}; }

using std::abs;
using std::sqrt;

}  // namespace hookpoint
