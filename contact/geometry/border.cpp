#include "contact/geometry/border.h"

namespace hookpoint::contact {

std::optional<Face> touched_face(const Surface& surface, const Vector3d& place,
                                 const Vector3d& outward) {
  std::optional<Face> touched;
  surface.faces(region_about(place, edge_width), [&](const Face& face) {
    if (!points_against(outward, face.normal) || !on_border(face, place) ||
        !is_over(face, place, false))
      return;
    if (!touched || dot(outward, face.normal) < dot(outward, touched->normal)) touched = face;
  });
  return touched;
}

double share_with_corner(const Surface& surface, const Vector3d& place, const Vector3d& normal,
                         double depth) {
  bool shared = false;
  surface.corners(region_about(place, std::abs(depth) + edge_width), [&](const Corner& corner) {
    shared |= norm(tangential(corner.position - place, normal)) <= edge_width;
  });
  return shared ? 0.5 : 1.;
}

}  // namespace hookpoint::contact
