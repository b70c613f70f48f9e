// Shapes and ground as DART shapes.
#pragma once

#include <Eigen/Geometry>
#include <dart/dynamics/Shape.hpp>

#include "reference/ground.h"

// AVX would make Eigen align to 32 bytes what the library, built for any x86-64, aligns to 16.
static_assert(EIGEN_MAX_ALIGN_BYTES == 16, "the library lays its Eigen members out at 16 bytes");

namespace hookpoint::reference {

inline Eigen::Vector3d eigen(const Vector3d& a) { return {a.x, a.y, a.z}; }
inline Vector3d vector(const Eigen::Vector3d& a) { return {a.x(), a.y(), a.z()}; }
Eigen::Isometry3d transform(const Vector3d& position, const Quaterniond& orientation);

/// Throws std::logic_error for a Legcone: DART has no truncated cone, and experiments with one are
/// refused before any shape is made (describe_dart).
dart::dynamics::ShapePtr make_dart_shape(const simulation::ShapeGeometry& geometry);

struct DartGround {
  dart::dynamics::ShapePtr shape;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< X_WS
};
/// Without a shape of stairs, whose steps stand by themselves. A plane is a box of `width` [m] with its top face there: FCL gives two boxes all their contacts,
/// and anything on its half-space one. A mesh has vertices in single precision: aiScene has no
/// other.
DartGround make_dart_ground(const Ground& ground, double width);

}  // namespace hookpoint::reference
