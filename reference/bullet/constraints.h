// Loops and coupled joints of the robots as constraints of Bullet's multibodies.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "reference/bullet/robot.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

class BulletConstraints {
 public:
  /// `robots`: those with chains, in any order.
  BulletConstraints(const simulation::Experiment& experiment, const RobotTree& tree,
                    const std::vector<std::unique_ptr<BulletRobot>>& robots,
                    btMultiBodyDynamicsWorld& world);
  ~BulletConstraints();
  BulletConstraints(const BulletConstraints&) = delete;
  BulletConstraints& operator=(const BulletConstraints&) = delete;

  /// Forces and moments of the last step, on body a at its place.
  void read(std::span<simulation::LoopState> loops) const;

 private:
  /// A place of a loop.
  struct Place {
    std::size_t loop = 0;
    btMultiBodyConstraint* constraint = nullptr;  ///< of constraints_
    const btCollisionObject* body = nullptr;      ///< a
    btVector3 lever;  ///< from the loop's place to this one, axes of `body` as Bullet has them [m]
  };

  void add(std::unique_ptr<btMultiBodyConstraint> constraint);

  btMultiBodyDynamicsWorld& world_;
  double deltat_;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> constraints_;
  std::vector<Place> places_;
};

}  // namespace hookpoint::reference
