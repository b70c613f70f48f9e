// How points and the centre of mass move with the coordinates of mass_matrix.h.
#pragma once

#include "dts/composite_bodies.h"

namespace hookpoint::dts {

/// Six rows of velocity_count numbers, row by row: the angular velocity of `body` [rad/s] and the
/// velocity of the point of it that is at `point` now [m/s], world axes, of a unit rate of each
/// coordinate. `O`: the base's origin [m]. O(links).
std::vector<double> body_jacobian(const Model<double>& model, const CompositeBodies& composite,
                                  const Vector3d& O, std::size_t body, const Vector3d& point);

/// Of all that moves; a fixed base is not in it.
struct CenterOfMass {
  double mass = 0.;              ///< [kg]
  Vector3d position;             ///< world [m]
  std::vector<double> jacobian;  ///< three rows: of its velocity, world axes [m/s]
};

/// c and dc/dv: (m_j / m) S_j at the centre of what joint j carries. `O` as above. A robot without
/// mass has its centre at O, and zeros. O(links).
CenterOfMass center_of_mass(const Model<double>& model, const CompositeBodies& composite,
                            const Vector3d& O);

/// What gravity takes of the coordinates: -m J_c^T g [N m, N]; bias_forces of a robot at rest.
std::vector<double> gravity_forces(const CenterOfMass& center, const Vector3d& gravity_W);

}  // namespace hookpoint::dts
