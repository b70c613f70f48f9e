// Contacts of boundary points in Bullet: manifolds of one point each, filled where our own terrain
// has a contact. Bullet's solver makes the forces of them.
#pragma once

#include <span>
#include <vector>

#include "reference/bullet/settings.h"
#include "reference/bullet/shapes.h"
#include "reference/pair_materials.h"
#include "reference/touching_points.h"

namespace hookpoint::reference {

/// What Bullet's solver gets of a contact on a tile.
void set_bullet_material(btManifoldPoint& contact,
                         const contact::MaterialConstants<double>& material,
                         const BulletSettings& settings);

class BulletPoints {
 public:
  /// `experiment` has a terrain. `dispatcher` and `ground` outlive this.
  BulletPoints(const simulation::Experiment& experiment, const RobotTree& tree,
               const BulletSettings& settings, btDispatcher& dispatcher, const btRigidBody& ground);
  ~BulletPoints();
  BulletPoints(const BulletPoints&) = delete;
  BulletPoints& operator=(const BulletPoints&) = delete;

  /// `objects`: one a body; those that can move outlive this. To be called once.
  void attach(const std::vector<const btCollisionObject*>& objects);
  /// Adds, moves and removes the contacts of bodies that stand as `bodies`.
  void collide(std::span<const simulation::BodyState> bodies);
  /// Adds the force of each point in the last step to its body, and counts it.
  void read(double deltat, std::span<simulation::BodyState> bodies) const;
  /// Whether it is one of the points' own.
  bool has(const btPersistentManifold& manifold) const;
  void read_forces(double deltat, std::span<Vector3d> forces) const;

 private:
  Vector3d force(std::size_t point, double deltat) const;

  BulletSettings settings_;
  PairMaterials materials_;
  contact::Terrain terrain_;
  std::vector<TouchingPoint> points_;
  btDispatcher& dispatcher_;
  const btRigidBody& ground_;
  std::vector<btPersistentManifold*> manifolds_;  ///< one a point
};

/// The force of a contact on the manifold's first body, with the impulses of the last step.
inline btVector3 bullet_impulse(const btManifoldPoint& contact) {
  return contact.m_appliedImpulse * contact.m_normalWorldOnB +
         contact.m_appliedImpulseLateral1 * contact.m_lateralFrictionDir1 +
         contact.m_appliedImpulseLateral2 * contact.m_lateralFrictionDir2;
}

}  // namespace hookpoint::reference
