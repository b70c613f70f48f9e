// What a start with slack springs leaves in a motion that is measured from `settle` on. A body that
// `rest_on` starts level begins to give along the ground, and to lean; closed forms of steady motion
// hold once that is over.
#pragma once

#include <string>

#include "studies/measure/body_on_plane.h"
#include "studies/measure/metric.h"

namespace hookpoint::studies {

/// What is measured of a displacement over [settle, duration].
enum class Fitted {
  speed,         ///< the slope of the best line
  acceleration,  ///< the curvature of the best parabola
};

/// Why the closed form `predicted` [m/s or m/s^2] of a body that does not start in balance is not yet
/// what is measured: more than 1 % of it is still the start's. "" where it is, and where `predicted`
/// is 0.
///
/// Two things last. A slide keeps the speed that it gains while its springs stretch up to friction's
/// limit: of an undamped spring k under the pull P, x = P/k (1 - cos(w t)), w^2 = k/m, the limit F is
/// reached at w t = acos(1 - F/P) with the speed P/(m w) sin(w t), from where it gains (P - F)/m.
/// Dampers take some of it, so that this is a bound. And the body swings: the slowest mode of its
/// heave, pitch and sway on the linearised contacts decays by exp(-s t). Its amplitude is the lean h
/// that friction's moment makes, and a swing of amplitude A changes the slope over a time T by less
/// than 3 A/T, the curvature by less than 30 A/T^2.
std::string why_start_counts(const RunContext& context, const BodyOnPlane& body, Fitted fitted,
                             double predicted);

}  // namespace hookpoint::studies
