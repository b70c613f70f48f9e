// An edge of one body across a ridge of another: a sole over a tread's nosing, a beam on two edges, a
// capsule or a cylinder that lies across an edge.
#pragma once

#include <array>
#include <optional>

#include "contact/geometry/surface.h"

namespace hookpoint::contact {

/// A straight edge from `from` to `to`, rounded with `radius`: 0 of a polyhedron's, r of a capsule's
/// axis.
struct BodyEdge {
  BodyEdge(const Vector3d& begin, const Vector3d& end, double rounding,
           const std::array<Vector3d, 2>& face_normals,
           const std::array<Vector3d, 2>& face_outwards, double widening = 0.)
      : from(begin),
        to(end),
        length(norm(end - begin)),
        along(length > 0. ? (1. / length) * (end - begin) : Vector3d{}),
        radius(rounding),
        normals(face_normals),
        outwards(face_outwards),
        taper(widening) {}

  Vector3d from, to;  ///< [m]
  double length;      ///< [m]
  Vector3d along;     ///< unit, from `from` to `to`; 0 without length
  double radius;      ///< [m]
  /// Of the two faces that meet there, as Ridge has them; of a round one none.
  std::array<Vector3d, 2> normals, outwards;
  double taper;  ///< of a round one, how its radius grows along it: a cone's
};

struct EdgeContact {
  Vector3d place;      ///< on the edge's surface [m]
  Vector3d normal;     ///< unit, across both, out of the ridge's solid
  double depth = 0.;   ///< > 0 where they overlap [m]
  double weight = 1.;  ///< of its stiffness, from 0 to 1
  /// The end of the edge, and of the ridge, that lies at the crossing, 0 or 1; -1: neither.
  int at_end = -1, at_ridge_end = -1;
  double along = 0.;                          ///< of the edge's length, from `from`: 0 to 1
  std::array<double, 2> end_weights{1., 1.};  ///< that the weight has to reach at either end
};

/// Where they cross with a depth above -`reach` and below `most_depth` [m]; none where they do not,
/// or are parallel: then their ends touch. The depth is along n = e x t / |e x t|, that of the two
/// directions, which keeps the springs' energy a function of the pose; of a cone along the normal of its
/// side that is across t.
///
/// Where an end of the edge comes over the ridge, it is the end that touches a face from then on: at
/// the end the contact's weight has come to cos^2 of the face it leaves less that of the face it
/// comes to, so that the energy k w d^2/2 goes over without a jump. Elsewhere the weight is 1.
std::optional<EdgeContact> edge_on_ridge(const Ridge& ridge, const BodyEdge& edge, double reach,
                                         double most_depth);

/// The weight with what the ends ask of it. `shares`: at each end, which part of it is this edge's,
/// beside another edge that leaves the same end across the same ridge.
double end_weighted(const EdgeContact& contact, const std::array<double, 2>& shares);

}  // namespace hookpoint::contact
