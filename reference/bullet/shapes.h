// Shapes and ground as Bullet collision shapes, and the body's frame that Bullet wants.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "reference/ground.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

inline btVector3 bullet(const Vector3d& a) { return {a.x, a.y, a.z}; }
inline btQuaternion bullet(const Quaterniond& q) { return {q.x, q.y, q.z, q.w}; }
inline Vector3d vector(const btVector3& a) { return {a.x(), a.y(), a.z()}; }
inline Quaterniond quaternion(const btQuaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// Where Bullet has a body's frame: at the centre of mass, along principal axes of inertia.
struct BulletFrame {
  btTransform X_BP;   ///< pose of the principal frame in the body's
  btVector3 inertia;  ///< principal moments [kg m^2]
};
BulletFrame principal_frame(const simulation::MassSpec& mass);

/// A collision shape with the parts it refers to.
struct BulletShape {
  btTransform X_WG = btTransform::getIdentity();  ///< of a ground: its pose in the world
  std::vector<std::unique_ptr<btCollisionShape>> parts;
  std::unique_ptr<btTriangleIndexVertexArray> mesh;
  std::vector<double> vertices;
  std::vector<int> indices;
  std::unique_ptr<btCollisionShape> shape;
};
/// The shapes of a body in its principal frame. One shape on that frame stays itself, so that
/// Bullet uses the pair algorithm of its kind; anything else is a compound.
std::unique_ptr<BulletShape> make_bullet_shape(
    const std::vector<const simulation::ShapeSpec*>& shapes, const btTransform& X_BP);
/// What stands by itself, about its own origin.
std::unique_ptr<BulletShape> make_bullet_shape(const simulation::ShapeGeometry& geometry);
/// Of stairs nothing: their steps stand by themselves.
std::unique_ptr<BulletShape> make_bullet_ground(const Ground& ground);

}  // namespace hookpoint::reference
