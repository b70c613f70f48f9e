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

/// What may be of a floor near a body, world axes.
struct NearFloor {
  std::span<const ShapeObject> objects;   ///< all of the World
  std::span<const ObjectMotion> motions;  ///< of each
  /// Numbers of those that may be of a floor, and whose box meets the body's with as much again on each side.
  std::span<const std::size_t> near;
  contact::Region body;  ///< the body's box
};

/// Where the body touches an object of a floor, world axes.
struct TouchedPlace {
  std::size_t of = 0;    ///< that object
  Vector3d place;        ///< on its surface [m]
  Vector3d out;          ///< unit, out of the object, along the contact's normal
  bool on_face = false;  ///< touched by a point of the body, not where two edges cross
};

/// What the place is of the floor that the near objects make up together.
enum class FloorPart {
  own,     ///< what it is of the object alone
  hidden,  ///< nothing that can be touched: no edge or corner of the floor, or behind one of its faces
  shared,  ///< a place on a face, where another object has a level face, too
  inside   ///< likewise, at its end, and the floor has no corner there
};
/// O(near objects), allocates nothing.
FloorPart part_touched(const NearFloor& floor, const TouchedPlace& at);

/// Whether a face of object `of` continues beyond an edge of it, where `place` is nearest to that edge. Face, edge and
/// place in the object's frame. O(near objects), allocates nothing.
bool continues_beyond(const NearFloor& floor, std::size_t of, const contact::Face& face,
                      const contact::FaceEdge& edge, const Vector3d& place);

}  // namespace hookpoint::simulation
