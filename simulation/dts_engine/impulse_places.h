// Where robots under an impulse law may be struck: places between a body and the ground, an obstacle or
// another body, as they are now. Their numbers hold over a step.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>

#include "contact/terrain/ground_query.h"
#include "simulation/dts_engine/articulated_robot.h"

namespace hookpoint::simulation {

/// A body at a place, world axes.
struct PlaceSide {
  std::size_t robot = 0;  ///< of those that are located
  std::size_t body = 0;   ///< of the robot
  double sign = 1.;       ///< the impulse of the place acts on it times this: 1 of a, -1 of b
  Vector3d arm;           ///< of the place, from the body's origin [m]
  /// Likewise, of what moves with the body and decides where the place is: a ball's centre.
  Vector3d center;
};

/// Body a above body b, or above a surface that forces do not move. World axes.
struct ImpulsePlace {
  std::array<PlaceSide, 2> sides;
  std::size_t side_count = 0;
  contact::GroundPoint ground;  ///< of the place: gap, and the normal out of b
  /// Velocity of the material of a surface at the place, with the sign of its side [m/s].
  Vector3d surface_velocity;
  int surface = -1;  ///< number of that surface: terrain first, then obstacles; -1 between bodies

  std::span<PlaceSide> bodies() { return std::span(sides).first(side_count); }
  std::span<const PlaceSide> bodies() const { return std::span(sides).first(side_count); }
};

class ImpulsePlaces {
 public:
  virtual ~ImpulsePlaces() = default;
  /// How many places there are at most.
  virtual std::size_t room() const = 0;
  /// A step begins: numbers begin again.
  virtual void begin_step() {}
  /// Looks where they are, `elapsed` [s] after the step's start. Allocates nothing.
  virtual void locate(std::span<const ArticulatedRobot> robots, const contact::GroundQuery& ground,
                      double elapsed) = 0;
  /// A place that is not near at present has an infinite gap.
  virtual std::span<const ImpulsePlace> places() const = 0;
  /// By which gaps are smaller than distances [m].
  virtual double margin() const { return 0.; }
  /// Where a world point is beside the terrain's end: that place in the terrain's frame.
  virtual std::optional<Vector3d> beside_ground(const Vector3d& /*p_W*/) const {
    return std::nullopt;
  }
  /// The time in which no surface turns by more than `turn` [rad] or goes farther than `travel` [m].
  virtual double longest_flight(double /*turn*/, double /*travel*/) const {
    return std::numeric_limits<double>::infinity();
  }
};

}  // namespace hookpoint::simulation
