// The rim of a disc across a ridge: a wheel on a nosing, a tin that stands over an edge.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "contact/geometry/rim.h"
#include "contact/geometry/surface.h"

namespace hookpoint::contact {

/// Where a rim and a ridge are nearest to each other: the line between the two places is across both.
struct RimCrossing {
  Vector3d place;     ///< x, on the rim [m]
  Vector3d normal;    ///< unit, out of the ridge's solid
  Vector3d radial;    ///< unit, from the rim's centre to x
  double depth = 0.;  ///< > 0 where they overlap [m]
};

struct RimCrossings {
  static constexpr std::size_t most = 3;
  std::array<RimCrossing, most> crossings;
  std::size_t count = 0;

  std::span<const RimCrossing> all() const& { return std::span(crossings).first(count); }
  std::span<const RimCrossing> all() const&& = delete;  // it would outlive what it shows
};

/// All of them within the ridge's ends and with a depth above -`reach` [m]. The normal n is along
/// tangent x ridge, so that a rim that rolls from a face onto the ridge, and from there onto the next
/// face, has the same place, normal and depth on either side.
RimCrossings rim_on_ridge(const Ridge& ridge, const Rim& rim, double reach);

}  // namespace hookpoint::contact
