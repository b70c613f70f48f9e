// How far a place is from the features of a surface round about it, and which way out.
#pragma once

#include <algorithm>

#include "contact/geometry/folds.h"
#include "contact/geometry/surface.h"

namespace hookpoint::contact {

/// Calls `visit(normal, distance, material, at_corner)` for each place of the surface that is nearest to `c`,
/// outside, of all places round about it and nearer than `reach` [m]: under a face, on a ridge, in a
/// corner; with `faces_only` the first of these. O(features within reach).
template <class Visitor>
void places_near(const Surface& surface, const Vector3d& c, double reach, bool faces_only,
                 const Visitor& visit) {
  const Region near = region_about(c, reach);
  const auto add = [&](const Vector3d& away, int material, bool at_corner) {
    const double distance = norm(away);
    if (distance > 0. && distance < reach)
      visit((1. / distance) * away, distance, material, at_corner);
  };
  surface.faces(near, [&](const Face& face) {
    const double height = face.height(c);
    if (height >= -edge_width && height < reach && is_over(face, c, false))
      visit(face.normal, height, face.material, false);
  });
  if (faces_only) return;
  surface.ridges(near, [&](const Ridge& ridge) {
    const Vector3d from_line = c - ridge.point;
    const double s = dot(from_line, ridge.along);
    const bool beside = dot(from_line, ridge.outwards[0]) > edge_width &&
                        dot(from_line, ridge.outwards[1]) > edge_width;
    if (beside && s > ridge.from && s < ridge.to)
      add(from_line - s * ridge.along, ridge.material, false);
  });
  surface.corners(near, [&](const Corner& corner) {
    const Vector3d away = c - corner.position;
    const auto falls_away = [&](const Vector3d& edge) { return dot(away, edge) <= 0.; };
    if (std::ranges::all_of(corner.all_edges(), falls_away)) add(away, corner.material, true);
  });
}

}  // namespace hookpoint::contact
