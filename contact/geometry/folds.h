// How the faces of a surface meet.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/geometry/surface.h"

namespace hookpoint::contact {

inline Vector3d unit(const Vector3d& a) { return (1. / norm(a)) * a; }

/// Of a face with `outward` across an edge (FaceEdge), and the normal of the face beyond. Their
/// product is the sine of the angle between the faces' normals, > 0 at a convex edge.
inline Fold fold(const Vector3d& outward, const Vector3d& normal_beyond) {
  constexpr double level = 1e-9;  // sine of the angle: rounding of heights
  const double sine = dot(outward, normal_beyond);
  return std::abs(sine) <= level ? Fold::flat : sine > 0. ? Fold::convex : Fold::concave;
}

/// 1 for a normal that lies between those of the two faces, down to 0 where it has left them by the
/// sine `fade`.
inline double between(const Vector3d& normal, const std::array<Vector3d, 2>& outwards,
                      double fade = 0.02) {
  double weight = 1.;
  for (const Vector3d& outward : outwards)
    weight = std::min(weight, std::clamp(1. + dot(normal, outward) / fade, 0., 1.));
  return weight;
}

/// Whether a corner stands out: all its edges fall away from the mean of their directions.
inline bool is_peak(const Corner& corner) {
  Vector3d mean;
  for (const Vector3d& edge : corner.all_edges()) mean += unit(edge);
  const double length = norm(mean);
  constexpr double least = 1e-6;
  if (length < least) return false;
  for (const Vector3d& edge : corner.all_edges())
    if (dot(unit(edge), mean) < least * length) return false;
  return true;
}

/// Two faces that meet both have their edge [m].
inline constexpr double edge_width = 1e-9;

/// Whether a place over or under a face's plane lies within the face; a concave edge and an open one
/// are no end of it if `continued`.
inline bool is_over(const Face& face, const Vector3d& place, bool continued) {
  return std::ranges::all_of(face.all_edges(), [&](const FaceEdge& edge) {
    const bool ends = edge.fold == Fold::flat || edge.fold == Fold::convex ||
                      (edge.fold == Fold::concave && !continued);
    return !ends || dot(place - edge.point, edge.outward) <= edge_width;
  });
}

}  // namespace hookpoint::contact
