// A contact in DART: its constants, its rows, where it is found.
#pragma once

#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/ShapeNode.hpp>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "reference/dart/settings.h"
#include "reference/dart/shapes.h"
#include "reference/touching_points.h"

// Debian's library is built with assertions, and without NDEBUG dart::constraint::BoxedLcpSolver
// has one virtual function more: a class derived from it here must have that too.
#ifdef NDEBUG
#error "this file must be compiled without NDEBUG, as the library is"
#endif

namespace hookpoint::reference {

/// The constants of contact, which DART keeps once a process, for one world's step. Worlds with the
/// same constants step at the same time, others wait for their turn.
class DartConstantsTurn {
 public:
  explicit DartConstantsTurn(const DartSettings& settings);
  ~DartConstantsTurn();
  DartConstantsTurn(const DartConstantsTurn&) = delete;
  DartConstantsTurn& operator=(const DartConstantsTurn&) = delete;
};

/// Dantzig's method, and Gauss-Seidel where that fails, with the rows of `settings`.
dart::constraint::UniqueConstraintSolverPtr make_dart_solver(const DartSettings& settings,
                                                             double deltat);

/// A state that stands there; its other values are 0.
simulation::BodyState pose_of(const Eigen::Isometry3d& X_WB);

/// A ball on a body, or a point, which is one of radius 0.
struct DartBall {
  const dart::dynamics::ShapeNode* node;
  TouchingPoint place;
};
/// What robots meet: the ground, a step of stairs, an obstacle.
struct DartStanding {
  const dart::dynamics::ShapeNode* shape = nullptr;  ///< for FCL; null: it sees none
  std::optional<int> material;                       ///< none: the tile's under the contact
  /// Of a foot's material and its own: a node with the friction and restitution of both.
  std::map<std::pair<int, int>, const dart::dynamics::ShapeNode*> surfaces;
};

/// Of a pair of shapes FCL sees those of a robot and what stands: robots do not meet each other. A
/// ball meets the ground by our terrain query, so that FCL does not see these two.
class DartShapesFilter final : public dart::collision::CollisionFilter {
 public:
  const dart::dynamics::ShapeFrame* ground = nullptr;
  std::vector<const dart::dynamics::ShapeFrame*> solids;
  std::vector<const dart::dynamics::ShapeFrame*> shapes, balls;

  bool ignoresCollision(const dart::collision::CollisionObject* a,
                        const dart::collision::CollisionObject* b) const override;

 private:
  bool meets(const dart::dynamics::ShapeFrame* shape,
             const dart::dynamics::ShapeFrame* other) const;
};

/// FCL for shapes; balls meet the ground's tiles exactly, as in our own engine. FCL gives a sphere on
/// a mesh negative depths, of which DART makes no contact, and has no points.
class DartGroundDetector final : public dart::collision::FCLCollisionDetector {
 public:
  // The setter of the same would print a warning.
  explicit DartGroundDetector(bool tessellated) {
    mPrimitiveShapeType = tessellated ? MESH : PRIMITIVE;
  }

  std::optional<contact::Terrain> terrain;
  std::vector<DartStanding> standing;  ///< the ground first, where there is one
  std::map<const dart::dynamics::ShapeFrame*, int> foot_materials;  ///< of robots' shapes
  std::vector<DartBall> balls;
  std::size_t shape_contacts = 0;  ///< that FCL found last

  using FCLCollisionDetector::collide;
  bool collide(dart::collision::CollisionGroup* group,
               const dart::collision::CollisionOption& option,
               dart::collision::CollisionResult* result) override;

 private:
  /// Of a contact that FCL found, puts the node of both materials in the place of what stands.
  void name_surface(dart::collision::Contact& contact);
  dart::collision::CollisionObject* object_of(const DartStanding& standing, int foot, int material);
};

}  // namespace hookpoint::reference
