#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>

#include "tests/support/native_contacts/native_contact.h"

namespace hookpoint::native {
namespace {

using dart::constraint::ContactConstraint;

class DartContact final : public Contact {
 public:
  DartContact(const Ball& ball, double slip, double friction) : ball_(ball) {
    world_->setTimeStep(ball.deltat);
    const auto surface = [&](dart::dynamics::ShapeNode* node) {
      node->getDynamicsAspect()->setFrictionCoeff(friction);
    };
    auto ground = dart::dynamics::Skeleton::create("ground");
    auto* fixed = ground->createJointAndBodyNodePair<dart::dynamics::WeldJoint>().second;
    auto* floor =
        fixed->createShapeNodeWith<dart::dynamics::CollisionAspect, dart::dynamics::DynamicsAspect>(
            std::make_shared<dart::dynamics::BoxShape>(Eigen::Vector3d(100, 100, 1)));
    floor->setRelativeTranslation({0, 0, -0.5});
    surface(floor);
    floor->getDynamicsAspect()->setPrimarySlipCompliance(slip);
    floor->getDynamicsAspect()->setSecondarySlipCompliance(slip);
    world_->addSkeleton(ground);
    auto body = dart::dynamics::Skeleton::create("ball");
    auto [joint, node] = body->createJointAndBodyNodePair<dart::dynamics::FreeJoint>();
    joint_ = joint;
    node_ = node;
    node->setInertia(dart::dynamics::Inertia(ball.mass, Eigen::Vector3d::Zero(),
                                             great_inertia * Eigen::Matrix3d::Identity()));
    surface(
        node->createShapeNodeWith<dart::dynamics::CollisionAspect, dart::dynamics::DynamicsAspect>(
            std::make_shared<dart::dynamics::SphereShape>(ball.radius)));
    world_->addSkeleton(body);
    world_->getConstraintSolver()->setCollisionDetector(
        dart::collision::DARTCollisionDetector::create());
  }

  void start(double depth, double approach, std::array<double, 3> gravity) override {
    world_->setGravity(Eigen::Vector3d(gravity[0], gravity[1], gravity[2]));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().z() = ball_.radius - depth;
    joint_->setTransform(pose);
    joint_->setVelocities(Eigen::VectorXd::Zero(6));
    joint_->setLinearVelocity({0, 0, -approach});
  }
  void step() override { world_->step(); }
  std::array<double, 3> position() const override {
    const Eigen::Vector3d p = node_->getWorldTransform().translation();
    return {p.x(), p.y(), p.z()};
  }
  std::array<double, 3> velocity() const override {
    const Eigen::Vector3d v = node_->getLinearVelocity();
    return {v.x(), v.y(), v.z()};
  }

 private:
  Ball ball_;
  dart::simulation::WorldPtr world_ = dart::simulation::World::create();
  dart::dynamics::FreeJoint* joint_ = nullptr;
  dart::dynamics::BodyNode* node_ = nullptr;
};

}  // namespace

std::unique_ptr<Contact> dart_contact(const Ball& ball, double error_reduction,
                                      double correction_speed, double mixing, double slip,
                                      double friction) {
  ContactConstraint::setErrorReductionParameter(error_reduction);
  ContactConstraint::setMaxErrorReductionVelocity(correction_speed);
  ContactConstraint::setConstraintForceMixing(mixing);
  return std::make_unique<DartContact>(ball, slip, friction);
}

}  // namespace hookpoint::native
