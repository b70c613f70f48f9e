// A solid by its surface: flat faces, the ridges between faces that meet at a convex edge, and its
// corners. Terrain and the polyhedra among the shapes are surfaces; contacts ask them for what lies
// near a place. Positions are in the surface's own frame, SI.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>

#include "math/vector3.h"

namespace hookpoint::contact {

/// How a face meets the one beyond an edge of it.
enum class Fold : std::uint8_t {
  open,     ///< there is none: the face's plane continues
  flat,     ///< in one plane
  concave,  ///< as at the foot of a riser
  convex    ///< as at the nosing of a tread
};

struct FaceEdge {
  Vector3d point;    ///< of the edge's line [m]
  Vector3d outward;  ///< unit, in the face's plane, across the edge out of the face
  Fold fold = Fold::open;
  std::int64_t beyond = -1;  ///< face there; -1: none
};

/// A convex polygon of at most four edges; one without edges is a whole plane.
struct Face {
  static constexpr std::size_t most_edges = 4;
  std::int64_t id = 0;
  Vector3d normal;  ///< unit, out of the solid
  Vector3d point;   ///< of its plane [m]
  int material = 0;
  std::array<FaceEdge, most_edges> edges;
  std::size_t edge_count = 0;

  std::span<const FaceEdge> all_edges() const& { return std::span(edges).first(edge_count); }
  std::span<const FaceEdge> all_edges() const&& = delete;  // it would outlive what it shows
  /// Height of a place over the face's plane, < 0 inside [m].
  double height(const Vector3d& place) const { return dot(place - point, normal); }
};

/// A convex edge, with the two faces that meet there.
struct Ridge {
  std::int64_t id = 0;
  Vector3d point;                                          ///< of its line [m]
  Vector3d along;                                          ///< unit
  double from = -std::numeric_limits<double>::infinity();  ///< its ends, from `point` [m]
  double to = std::numeric_limits<double>::infinity();
  std::array<Vector3d, 2> normals;   ///< of the faces
  std::array<Vector3d, 2> outwards;  ///< out of each face across the ridge, as FaceEdge::outward
  int material = 0;
};

struct Corner {
  static constexpr std::size_t most_edges = 12;
  std::int64_t id = 0;
  Vector3d position;  ///< [m]
  /// Along each edge that leaves the corner; any length.
  std::array<Vector3d, most_edges> edges;
  std::size_t edge_count = 0;
  int material = 0;

  std::span<const Vector3d> all_edges() const& { return std::span(edges).first(edge_count); }
  std::span<const Vector3d> all_edges() const&& = delete;  // it would outlive what it shows
};

/// A box along the frame's axes [m].
struct Region {
  Vector3d low, high;
};
inline Region region_about(const Vector3d& center, double reach) {
  const Vector3d r{reach, reach, reach};
  return {center - r, center + r};
}
/// The least that holds all of them. Of at least one; linear.
inline Region region_about(std::span<const Vector3d> places) {
  Region region{places[0], places[0]};
  auto& [low, high] = region;
  for (const Vector3d& p : places) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return region;
}
inline bool overlap(const Region& a, const Region& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// What a surface shows of a kind of feature: a callable, referred to, not owned.
template <class Feature>
class Visit {
 public:
  template <class Visitor>
  requires(!std::is_same_v<Visitor, Visit>)
      Visit(const Visitor& visitor)  // NOLINT(google-explicit-constructor): a view, like std::span
      : visitor_(&visitor), call_([](const void* self, const Feature& feature) {
          (*static_cast<const Visitor*>(self))(feature);
        }) {}
  void operator()(const Feature& feature) const { call_(visitor_, feature); }

 private:
  const void* visitor_;
  void (*call_)(const void*, const Feature&);
};

class Surface {
 public:
  Surface() = default;
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
  virtual ~Surface() = default;

  /// Whether a place is inside the solid, or on its border to rounding.
  virtual bool contains(const Vector3d& place) const = 0;
  virtual Face face(std::int64_t id) const = 0;
  /// Whether its faces meet at any angle, as those of a grid of heights do.
  virtual bool is_rough() const { return false; }
  /// The face through which a place inside is nearest to the outside.
  virtual Face nearest_face(const Vector3d& inside) const = 0;
  /// The face that a place is under which is found inside and came through none; -1 where it only
  /// touches the border. `outward`: of the corner that is there (border.h), zero of another place.
  virtual std::int64_t face_over(const Vector3d& inside, const Vector3d& /*outward*/) const {
    return nearest_face(inside).id;
  }
  /// Whether nothing of the solid is in the region; false where that would take long to find out.
  virtual bool is_clear_of(const Region& /*region*/) const { return false; }
  /// Those that may meet the region, and perhaps more, each once, in an order that depends on the
  /// region alone. O(features there).
  virtual void faces(const Region& region, Visit<Face> visit) const = 0;
  virtual void ridges(const Region& region, Visit<Ridge> visit) const = 0;
  virtual void corners(const Region& region, Visit<Corner> visit) const = 0;
};

}  // namespace hookpoint::contact
