// Grounds that are computed, not read: both end as a grid of heights, so that every contact law,
// `rest_on` and every peer take them as they take a file.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// A rectangle of square cells about the world's origin.
struct Extent {
  double spacing = 1.;              ///< edge of a cell [m]
  double size_x = 0., size_y = 0.;  ///< made up to an even number of cells, so that a vertex lies
                                    ///< at the world's origin [m]
};

/// Why no grid of that extent can be made, in words for its author; empty when one can.
std::string extent_problem(const Extent& extent);

/// The level grid, all heights 0. The extent must be without problem.
GridSpec level_grid(const Extent& extent);

/// Smooth random ground: a sum of 64 plane waves of equal amplitude, the wave vectors evenly spread
/// over the ring between lengths k/sqrt(2) and sqrt(2) k, k = 2 pi/wavelength, and the phases over
/// the circle. On a large ground heights are nearly normal, their power spectral density flat on
/// the ring and 0 off it, and the rms slope sqrt(5/4) k times the rms height.
struct RoughGround {
  double amplitude = 0.;  ///< largest |height| of a vertex over the ground's plane [m]
  double wavelength =
      1.;  ///< 2 pi/k [m]; waves are from wavelength/sqrt(2) to sqrt(2) wavelength long
  std::uint64_t seed = 1;   ///< of the directions, lengths and phases
  double flat_radius = 0.;  ///< the plane itself up to here from the world's origin, risen to full
                            ///< roughness one wavelength further out [m]
  double slope = 0.;        ///< of the plane, as SlopeSurface::angle [rad]
  double azimuth = 0.;      ///< of the fall [rad]
};

/// Why there is no such ground; empty when there is.
std::string rough_problem(const RoughGround& rough, const Extent& extent);

/// Its heights; their mean over the vertices is that of the plane. Made of sums, products,
/// divisions and roots only, so that they are the same bytes on every machine. Cost 64
/// multiplications and additions a vertex. The ground must be without problem.
GridSpec rough_surface(const RoughGround& rough, const Extent& extent);

/// Stairs that rise along +x turned by `azimuth` about z. A height field has no vertical face: each
/// riser is a ramp one cell wide, at the foot of its tread.
struct StepsGround {
  double height = 0.;  ///< of one step [m]; below 0 the stairs go down
  double run = 1.;     ///< from one riser to the next [m]
  double count = std::numeric_limits<double>::infinity();  ///< of steps; to the ground's edge
  double from = 0.5;    ///< of the first riser's foot from the world's origin, along the stairs [m]
  double azimuth = 0.;  ///< [rad]
};

std::string steps_problem(const StepsGround& steps, const Extent& extent);

/// Its heights, 0 before the first riser. Exact where the risers' feet lie on vertices: `from` and
/// `run` multiples of the spacing and the azimuth one of a quarter turn; elsewhere the vertices
/// sample those ramps. The ground must be without problem.
GridSpec steps_surface(const StepsGround& steps, const Extent& extent);

}  // namespace hookpoint::simulation
