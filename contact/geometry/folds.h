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

/// Directions of edges that differ by less are the same, or cancel [rad].
inline constexpr double least_angle = 1e-6;

/// Out of the solid at a corner: against the mean direction of its edges, unit; zero where that has no direction.
inline Vector3d outward_of(const Corner& corner) {
  Vector3d sum;
  for (const Vector3d& edge : corner.all_edges()) sum += unit(edge);
  const double length = norm(sum);
  return length < least_angle ? Vector3d{} : (-1. / length) * sum;
}

/// Whether a corner stands out: all its edges fall away from `outward_of`.
inline bool is_peak(const Corner& corner) {
  const Vector3d outward = outward_of(corner);
  return outward != Vector3d{} &&
         std::ranges::all_of(corner.all_edges(), [&](const Vector3d& edge) {
           return dot(unit(edge), outward) <= -least_angle;
         });
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
