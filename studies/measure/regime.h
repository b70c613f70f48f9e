// What friction does to a body at rest on its ground, by the closed form tan(slope) <= mu. Metrics
// mean different things on either side, so tables keep the two apart.
#pragma once

#include <string_view>

namespace hookpoint::studies {

enum class Regime {
  none,   ///< does not apply: no plane, a body thrown along the ground
  holds,  ///< tan(slope) <= mu_s: any motion is an error
  slides  ///< tan(slope) > mu_s
};

/// "friction holds", "slides"; "" for none.
constexpr std::string_view word(Regime regime) {
  return regime == Regime::holds ? "friction holds" : regime == Regime::slides ? "slides" : "";
}

/// Over a table: "Where friction holds: tan(slope) <= mu".
constexpr std::string_view heading(Regime regime) {
  switch (regime) {
    case Regime::holds:
      return "Where friction holds: tan(slope) <= mu";
    case Regime::slides:
      return "Where the body slides: tan(slope) > mu";
    case Regime::none:
      break;
  }
  return "Other runs";
}

}  // namespace hookpoint::studies
