// Where objects that no force moves lie flush side by side, they are one floor: an edge or a corner of one of them
// with level faces all around is none of the floor.
#pragma once

#include <span>

#include "contact/geometry/surface.h"
#include "simulation/dts_engine/object_motion.h"
#include "simulation/dts_engine/shape_object.h"

namespace hookpoint::simulation {

/// What two surfaces may differ in height and be one floor [m].
inline constexpr double flush = 1e-6;

/// Whether an object may be a part of a floor: it has faces, and no force moves it.
inline bool may_be_of_floor(const ShapeObject& object) {
  return !object.movable && (object.ground || !object.polyhedra.empty());
}

/// All objects of a World as they stand.
struct StandingObjects {
  std::span<const ShapeObject> objects;
  std::span<const ObjectMotion> motions;
  /// About each, along the world's axes; of the terrain unused.
  std::span<const contact::Region> boxes;
};

/// Where an object that no force moves is touched, world axes.
struct TouchedPlace {
  std::size_t of = 0;    ///< that object
  std::size_t by = 0;    ///< the one that touches it
  Vector3d place;        ///< on its surface [m]
  Vector3d out;          ///< unit, against which it is pressed
  bool on_face = false;  ///< by a place, and not along an edge
};

/// How what objects that no force moves make up together is touched there.
enum class FloorPart {
  own,     ///< as the object alone
  hidden,  ///< not: there is no edge, no corner that stands out, or it is behind a face that continues
  shared,  ///< on a face, at its end, where another object has a level face, too
  inside   ///< likewise, where no corner stands out
};
/// O(objects), allocates nothing.
FloorPart part_touched(const StandingObjects& world, const TouchedPlace& at);

/// Whether a face of object `of` continues beyond an edge of it, where `place` is nearest to that edge. Face, edge and
/// place in the object's frame. O(objects), allocates nothing.
bool continues_beyond(const StandingObjects& world, std::size_t of, const contact::Face& face,
                      const contact::FaceEdge& edge, const Vector3d& place);

}  // namespace hookpoint::simulation
