// Several surfaces that press on one ball, or on one point: what part of the way out each gives.
#pragma once

#include <cstddef>
#include <span>

#include "math/vector3.h"

namespace hookpoint::contact {

/// A surface that a ball's centre is to be moved out of.
struct Obstruction {
  Vector3d normal;    ///< n, unit, out of the surface
  double depth = 0.;  ///< d > 0, how far the centre has to go along n [m]
  double part = 0.;   ///< lambda / d: result, from 0 to 1
};

/// Of more, those that are deepest count.
inline constexpr std::size_t most_obstructions = 6;

/// The shortest way out, u = argmin |u|^2 with n_i . u >= d_i, is a sum of lambda_i n_i with
/// lambda_i >= 0. The springs k |u|^2/2 of the ball then push with k lambda_i along each n_i: one
/// plane gives k d, two that are nearly one share it, planes at right angles give k d_i each, and
/// since |u| is a distance to the space that is free, no closed path gains energy. Puts the parts
/// lambda_i/d_i into `obstructions`; where no u fulfils all (the space is closed above) the best for
/// as many as can be. At most most_obstructions of them. O(1), allocates nothing.
void share_out(std::span<Obstruction> obstructions);

}  // namespace hookpoint::contact
