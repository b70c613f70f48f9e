#include "simulation/dts_engine/common_floor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "contact/geometry/border.h"

namespace hookpoint::simulation {
namespace {

/// So far around a place the faces have to continue [m]. The place nearest to an edge is at 0.38 of it: gaps up to 0.2 um
/// do not part a floor.
constexpr double around = 1e-6;
constexpr int directions = 8;
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

template <class Visitor>
void surfaces_of(const ShapeObject& object, const Visitor& visit) {
  if (object.ground) visit(*object.ground);
  for (const PolyhedronFeature& polyhedron : object.polyhedra) visit(*polyhedron.solid);
}

/// Whether `holds(surface, own place, motion)` of one of the near objects other than `except`.
template <class Holds>
bool any_near(const NearFloor& floor, std::size_t except, const Vector3d& place,
              const Holds& holds) {
  return std::ranges::any_of(floor.near, [&](std::size_t object) {
    if (object == except) return false;
    const ObjectMotion& motion = floor.motions[object];
    const Vector3d own = motion.to_object(place);
    bool found = false;
    surfaces_of(floor.objects[object], [&](const contact::Surface& surface) {
      found = found || holds(surface, own, motion);
    });
    return found;
  });
}

/// Whether one of them has a face, level with a plane of unit `normal`, over `place` of that plane.
bool is_on_level_face(const NearFloor& floor, std::size_t except, const Vector3d& place,
                      const Vector3d& normal) {
  constexpr double parallel = 1e-6;  // sine
  return any_near(
      floor, except, place,
      [&](const contact::Surface& surface, const Vector3d& own, const ObjectMotion& motion) {
        const Vector3d own_normal = transpose_times(motion.R_WB, normal);
        bool found = false;
        surface.faces(contact::region_about(own, around), [&](const contact::Face& face) {
          found |= dot(face.normal, own_normal) > 0. && std::abs(face.height(own)) <= flush &&
                   norm(cross(face.normal, own_normal)) <= parallel &&
                   contact::is_over(face, own, false);
        });
        return found;
      });
}

/// Whether one of them lies against a face at `place`, whose normal there is `out`, and has no other face nearer to the
/// place than `depth` [m].
bool is_covered(const NearFloor& floor, const Vector3d& place, const Vector3d& out, double depth) {
  constexpr double against = -0.1;  // cosine
  return any_near(
      floor, none, place + around * out,
      [&](const contact::Surface& surface, const Vector3d& own, const ObjectMotion& motion) {
        if (!surface.contains(own)) return false;
        const Vector3d own_out = transpose_times(motion.R_WB, out);
        bool covered = true;
        surface.faces(contact::region_about(own, depth + flush), [&](const contact::Face& face) {
          const double below = -face.height(own);
          const bool lies_against = below <= 2. * around && dot(face.normal, own_out) < against;
          covered = covered && (lies_against || below >= depth - flush);
        });
        return covered;
      });
}

/// The convex edges of a face on which a place of its plane lies: none, an edge, or two in a corner.
struct EdgesAt {
  const contact::FaceEdge* edge = nullptr;
  bool is_corner = false;
};
EdgesAt edges_at(std::span<const contact::FaceEdge> edges, const Vector3d& place) {
  EdgesAt at;
  for (const contact::FaceEdge& edge : edges) {
    if (edge.fold != contact::Fold::convex ||
        std::abs(dot(place - edge.point, edge.outward)) > contact::edge_width)
      continue;
    at.is_corner = at.edge != nullptr;
    at.edge = &edge;
  }
  return at;
}

/// Whether a face continues at a place on its edge or in its corner: level faces are all around, or, in a corner, the
/// edge continues straight in another's. Both in the frame of an object that moves so.
bool continues_at(const NearFloor& floor, const ObjectMotion& motion, const Vector3d& normal,
                  const EdgesAt& at, const Vector3d& place) {
  const Vector3d outward = at.edge->outward, beside = cross(normal, outward);
  int level = 0;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2. * std::numbers::pi / directions * (i + 0.5);  // between those of edges
    const Vector3d step = around * (std::cos(angle) * outward + std::sin(angle) * beside);
    level += is_on_level_face(floor, none, motion.to_world(place + step), motion.R_WB * normal);
  }
  return level == directions || (at.is_corner && level == directions / 2);
}

}  // namespace

FloorPart part_touched(const NearFloor& floor, const TouchedPlace& at) {
  constexpr double tilted = 1e-10;  // sine
  const ObjectMotion& motion = floor.motions[at.of];
  const Vector3d own = motion.to_object(at.place), out = transpose_times(motion.R_WB, at.out);
  FloorPart part = FloorPart::own;
  const auto look_at = [&](const contact::Surface& surface, const contact::Face& face) {
    if (part == FloorPart::hidden || !contact::on_border(face, own) ||
        !contact::is_over(face, own, false))
      return;
    const bool is_touched = at.on_face && norm(tangential(out, face.normal)) <= tilted;
    const auto edges = face.all_edges();
    const EdgesAt here = edges_at(edges, own);
    if (here.edge != nullptr && continues_at(floor, motion, face.normal, here, own))
      part = is_touched ? FloorPart::inside : FloorPart::hidden;
    else if (is_touched && is_on_level_face(floor, at.of, at.place, motion.R_WB * face.normal))
      part = FloorPart::shared;
    // Behind the face beyond an edge, where what touches reaches up to it and another solid covers the place up to
    // there. At the foot of a riser the place is nearer to the tread than to any edge behind which it could be.
    for (const contact::FaceEdge& edge : edges) {
      if (edge.fold != contact::Fold::convex || part == FloorPart::hidden) continue;
      const double inward = -dot(own - edge.point, edge.outward);
      const Vector3d on_edge = own + inward * edge.outward;
      const contact::Region there = contact::region_about(motion.to_world(on_edge), 0.);
      if (!overlap(floor.body, there) || !is_covered(floor, at.place, at.out, inward)) continue;
      const contact::Face beyond = surface.face(edge.beyond);
      const EdgesAt end = edges_at(beyond.all_edges(), on_edge);
      if (end.edge != nullptr && continues_at(floor, motion, beyond.normal, end, on_edge))
        part = FloorPart::hidden;
    }
  };
  surfaces_of(floor.objects[at.of], [&](const contact::Surface& surface) {
    surface.faces(contact::region_about(own, around),
                  [&](const contact::Face& face) { look_at(surface, face); });
  });
  return part;
}

bool continues_beyond(const NearFloor& floor, std::size_t of, const contact::Face& face,
                      const contact::FaceEdge& edge, const Vector3d& place) {
  const Vector3d on_face = place - face.height(place) * face.normal;
  const Vector3d on_edge = on_face - dot(on_face - edge.point, edge.outward) * edge.outward;
  return continues_at(floor, floor.motions[of], face.normal, {&edge, false}, on_edge);
}

}  // namespace hookpoint::simulation
