#include "reference/dart/world.h"

#include <algorithm>
#include <cmath>
#include <dart/collision/CollisionObject.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlanarJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>
#include <limits>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "reference/contact_limit.h"
#include "reference/dart/contact.h"
#include "reference/dart/shapes.h"
#include "reference/experiment_checks.h"
#include "reference/external_forces.h"
#include "reference/extremes.h"
#include "reference/library_abort.h"
#include "reference/robot_tree.h"
#include "reference/touching_points.h"
#include "simulation/names.h"

namespace hookpoint::reference {
namespace {

using dart::dynamics::BodyNode;
using simulation::BodyState;
using simulation::JointState;

/// Contacts at once whose rows take DART's solver some 10 ms a step.
constexpr std::size_t slow_contacts = 100;

/// What a collision shape belongs to.
struct ShapeUse {
  int body = -1;   ///< as published; -1: the ground
  int point = -1;  ///< index among the touching points; -1: a shape
};
using ShapeUses = std::unordered_map<const dart::dynamics::ShapeFrame*, ShapeUse>;

class DartWorld final : public PeerWorld {
 public:
  DartWorld(const simulation::Experiment& experiment, const DartSettings& settings)
      : settings_(settings),
        detector_(std::make_shared<DartGroundDetector>(settings.tessellated)),
        filter_(std::make_shared<DartShapesFilter>()),
        world_(dart::simulation::World::create()),
        trails_(simulation::body_trails(experiment)),
        limit_("DART", dart::collision::CollisionOption().maxNumContacts),
        slow_("DART", slow_contacts,
              "and its solver's cost grows with the cube of their number: steps are slow") {
    world_->setTimeStep(experiment.deltat);
    world_->setGravity(eigen(experiment.gravity));
    auto solver = make_dart_solver(settings_, experiment.deltat);
    solver->setCollisionDetector(detector_);
    solver->getCollisionOption().collisionFilter = filter_;
    world_->setConstraintSolver(std::move(solver));
    const RobotTree tree = robot_tree(experiment);
    forced_ = forced_bodies(experiment, tree);
    for (const TreeBody& body : tree.bodies) add_body(body);
    if (experiment.terrain) {
      add_ground(experiment);
      add_touching(experiment, tree);
    }
    for (const auto& skeleton : skeletons_) world_->addSkeleton(skeleton);
    for (const TreeBody& body : tree.bodies) now_.push_back(body.initial);
    joints_now_.resize(tree.joints);
    read_motion();
  }

  std::string advance(const simulation::WorldInputs& inputs) override {
    if (near_ground_) keep_below(*near_ground_);
    if (!apply(inputs)) return {};
    const DartConstantsTurn turn(settings_);
    const auto step = [this] {
      world_->step();
      read_motion();
    };
    if (survives_abort(step)) return {};
    // Neither its destructor nor anything else of it can be called any more.
    static auto* const lost = new std::vector<dart::simulation::WorldPtr>;
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    lost->push_back(std::move(world_));
    return "an assertion of DART's failed, whose words are on standard error";
  }

  std::optional<std::size_t> beyond_range() const override { return beyond_range_; }

  std::string notice() override {
    if (world_ && detector_->shape_contacts >= slow_contacts) {
      const Touch touch = touch_of(world_->getLastCollisionResult().getContact(0));
      const std::string& trail = trails_[static_cast<std::size_t>(touch.use.body)];
      limit_.check(detector_->shape_contacts, trail);
      slow_.check(detector_->shape_contacts, trail);
    }
    std::string notice = limit_.take_notice();
    return notice.empty() ? slow_.take_notice() : notice;
  }

  void read(std::span<BodyState> bodies, std::span<JointState> joints) const override {
    if (!world_) return;
    std::ranges::copy(now_, bodies.begin());
    for (std::size_t i = 0; i < joints.size(); ++i) {
      joints[i].angle = joints_now_[i].angle;
      joints[i].rate = joints_now_[i].rate;
    }
    for (const auto& contact : world_->getLastCollisionResult().getContacts())
      if (const Touch touch = touch_of(contact); touch.use.body >= 0) {
        BodyState& body = bodies[static_cast<std::size_t>(touch.use.body)];
        body.contact_force += touch.force;
        if (dot(touch.force, touch.normal) > 0.) ++body.contacts;
      }
  }

  void read_points(std::span<Vector3d> forces) const override {
    std::ranges::fill(forces, Vector3d{});
    for (const auto& contact : world_->getLastCollisionResult().getContacts())
      if (const Touch touch = touch_of(contact); touch.use.point >= 0)
        forces[static_cast<std::size_t>(touch.use.point)] += touch.force;
  }

  void read_shapes(std::vector<ShapeForce>& forces) const override {
    for (const auto& contact : world_->getLastCollisionResult().getContacts())
      if (const Touch touch = touch_of(contact); touch.use.point < 0)
        forces.push_back(
            {static_cast<std::size_t>(touch.use.body), vector(contact.point), touch.force});
  }

 private:
  struct Body {
    std::size_t index;  ///< as published
    bool mobile;
    int joint;  ///< as published; -1: a base
    BodyNode* node;
  };
  /// A box of ground that goes with the robot over its plane.
  struct NearGround {
    dart::dynamics::WeldJoint* joint;
    Eigen::Vector3d normal;
    double width;  ///< [m]
  };
  struct Touch {
    ShapeUse use;
    Vector3d force, normal;  ///< on the body, out of the ground
  };

  /// Reads the motion: the library works it out when it is asked, assertions included.
  void read_motion() {
    for (const Body& body : bodies_) {
      if (!body.mobile) continue;
      BodyState& state = now_[body.index];
      state = pose_of(body.node->getWorldTransform());
      state.velocity = vector(body.node->getLinearVelocity());
      state.angular_velocity = vector(body.node->getAngularVelocity());
      if (body.joint < 0) continue;
      const auto* joint = body.node->getParentJoint();
      joints_now_[static_cast<std::size_t>(body.joint)].angle = joint->getPosition(0);
      joints_now_[static_cast<std::size_t>(body.joint)].rate = joint->getVelocity(0);
    }
  }

  void add_body(const TreeBody& body) {
    if (body.link == nullptr)
      skeletons_.push_back(dart::dynamics::Skeleton::create(std::to_string(body.robot)));
    BodyNode* node = body.link == nullptr ? add_base(body) : add_link(body);
    const simulation::MassSpec& mass = body.body->mass;
    const Symmetric3d& I = mass.inertia;
    const Vector3d& com = mass.center_of_mass;
    if (mass.mass > 0.)
      node->setInertia(dart::dynamics::Inertia(mass.mass, com.x, com.y, com.z, I.xx, I.yy, I.zz,
                                               I.xy, I.xz, I.yz));
    const int joint = body.link == nullptr ? -1 : body.joint;
    bodies_.push_back({bodies_.size(), body.mobile, joint, node});
  }

  BodyNode* add_base(const TreeBody& body) {
    using namespace dart::dynamics;
    const Eigen::Isometry3d X_WB = transform(body.initial.position, body.initial.orientation);
    if (!body.mobile) {
      const auto [joint, node] = add_node<WeldJoint>(nullptr);
      joint->setTransformFromParentBodyNode(X_WB);
      return node;
    }
    if (body.plane_normal) return add_planar_base(body);
    const auto [joint, node] = add_node<FreeJoint>(nullptr);
    // DART steps the velocity of the joint's frame: at the centre of mass it is exact in free
    // flight.
    joint->setTransformFromChildBodyNode(transform(body.body->mass.center_of_mass, {}));
    FreeJoint::setTransformOf(joint, X_WB);
    joint->setAngularVelocity(eigen(body.initial.angular_velocity));
    joint->setLinearVelocity(eigen(body.initial.velocity));
    return node;
  }

  /// At the centre of mass, as a free base; the joint's frame has the world's axes at the start.
  BodyNode* add_planar_base(const TreeBody& body) {
    const PlaneAxes axes = plane_axes(*body.plane_normal);
    const auto [joint, node] = add_node<dart::dynamics::PlanarJoint>(nullptr);
    const Vector3d& center = body.body->mass.center_of_mass;
    const Vector3d arm = rotate(body.initial.orientation, center);
    joint->setArbitraryPlane(eigen(axes.first), eigen(axes.second));
    joint->setTransformFromParentBodyNode(transform(body.initial.position + arm, {}));
    joint->setTransformFromChildBodyNode(transform(center, conjugate(body.initial.orientation)));
    const Vector3d& w = body.initial.angular_velocity;
    const Vector3d v = body.initial.velocity + cross(w, arm);
    joint->setVelocities(
        Eigen::Vector3d(dot(v, axes.first), dot(v, axes.second), dot(w, axes.normal)));
    return node;
  }

  BodyNode* add_link(const TreeBody& body) {
    BodyNode* parent = bodies_[static_cast<std::size_t>(body.parent)].node;
    return body.turns() ? add_link<dart::dynamics::RevoluteJoint>(body, parent)
                        : add_link<dart::dynamics::PrismaticJoint>(body, parent);
  }

  template <class Joint>
  BodyNode* add_link(const TreeBody& body, BodyNode* parent) {
    const auto [joint, node] = add_node<Joint>(parent);
    joint->setAxis(Eigen::Vector3d::UnitZ());
    joint->setTransformFromParentBodyNode(transform(body.X_PL0.position, body.X_PL0.orientation));
    joint->setPosition(0, body.link->angle);
    joint->setVelocity(0, body.link->rate);
    return node;
  }

  /// Under names of their own: DART prints a message where it must find one.
  template <class Joint>
  std::pair<Joint*, BodyNode*> add_node(BodyNode* parent) {
    const std::string name = std::to_string(bodies_.size());
    typename Joint::Properties joint;
    joint.mName = name;
    return skeletons_.back()->createJointAndBodyNodePair<Joint>(parent, joint,
                                                                BodyNode::AspectProperties(name));
  }

  void add_ground(const simulation::Experiment& experiment) {
    const auto skeleton = dart::dynamics::Skeleton::create("ground");
    const auto [joint, node] = skeleton->createJointAndBodyNodePair<dart::dynamics::WeldJoint>();
    skeleton->setMobile(false);
    const Ground plan = ground_of(*experiment.terrain);
    const auto* plane = std::get_if<GroundPlane>(&plan);
    constexpr double far_width = 2e3;
    const double near_width = 20. * reach(experiment);
    // Two triangles meet in single precision in DART (tri_tri_intersection_test.hpp): on a ground
    // of 2 km a block has no contacts while it is less than some 30 um deep.
    if (settings_.tessellated && plane != nullptr && near_width > 0.)
      near_ground_ = NearGround{joint, eigen(plane->normal), near_width};
    const DartGround ground = make_dart_ground(plan, near_ground_ ? near_width : far_width);
    detector_->ground.emplace(DartGroundParts{contact::Terrain(*experiment.terrain), {}});
    const std::size_t materials = std::max<std::size_t>(experiment.materials.size(), 1);
    for (std::size_t i = 0; i < materials; ++i) {
      const auto material = material_at(experiment, static_cast<int>(i));
      detector_->ground->materials.push_back(
          add_shape(node, ground.shape, ground.pose, single_friction(material),
                    settings_.restitution ? material.restitution : 0., {}));
    }
    const auto own = static_cast<std::size_t>(experiment.terrain->material);
    filter_->ground = detector_->ground->materials[std::min(own, materials - 1)];
    skeletons_.push_back(skeleton);
  }

  /// Of the shapes of the experiment's one body about its origin [m]; 0 where there are others.
  static double reach(const simulation::Experiment& experiment) {
    if (experiment.robots.size() != 1 || touches_by_points(experiment, 0)) return 0.;
    double largest = 0.;
    for (const simulation::ShapeSpec& shape : experiment.robots[0].base.shapes) {
      const auto box = make_dart_shape(shape.geometry)->getBoundingBox();
      largest = std::max(largest, norm(shape.location) + box.computeHalfExtents().norm());
    }
    return largest;
  }

  void keep_below(const NearGround& ground) {
    const Eigen::Vector3d at = bodies_.front().node->getWorldTransform().translation();
    const Eigen::Vector3d below = at - at.dot(ground.normal) * ground.normal;
    Eigen::Isometry3d pose = ground.joint->getTransformFromParentBodyNode();
    if ((below - pose.translation()).norm() < ground.width / 8.) return;
    pose.translation() = below;
    ground.joint->setTransformFromParentBodyNode(pose);
  }

  void add_touching(const simulation::Experiment& experiment, const RobotTree& tree) {
    const auto points = touching_points(experiment, tree);
    for (std::size_t i = 0; i < points.size(); ++i) add_ball(points[i], static_cast<int>(i));
    for (const Body& body : bodies_) {
      const TreeBody& spec = tree.bodies[body.index];
      if (!body.mobile || touches_by_points(experiment, spec.robot)) continue;
      for (const simulation::ShapeSpec& shape : spec.body->shapes) {
        const auto* sphere = std::get_if<simulation::Sphere>(&shape.geometry);
        if (sphere != nullptr && !settings_.tessellated)
          add_ball({body.index, -1, shape.location, sphere->radius}, -1);
        else
          filter_->shapes.push_back(add_robot_shape(body.node, make_dart_shape(shape.geometry),
                                                    transform(shape.location, shape.orientation),
                                                    {static_cast<int>(body.index), -1}));
      }
    }
  }

  void add_ball(const TouchingPoint& place, int point) {
    constexpr double size = 1e-3;  // of a shape that nothing but its node is used of
    const auto* node = add_robot_shape(
        bodies_[place.body].node, std::make_shared<dart::dynamics::SphereShape>(size),
        transform(place.p_BP, {}), {static_cast<int>(place.body), point});
    detector_->balls.push_back({node, place});
  }

  /// The smaller coefficient of friction counts, and the product of those of restitution: the
  /// ground has the material's, the robot others that leave it so.
  const dart::dynamics::ShapeNode* add_robot_shape(BodyNode* node,
                                                   const dart::dynamics::ShapePtr& shape,
                                                   const Eigen::Isometry3d& X_BS,
                                                   const ShapeUse& use) {
    return add_shape(node, shape, X_BS, std::numeric_limits<double>::max(), 1., use);
  }

  const dart::dynamics::ShapeNode* add_shape(BodyNode* node, const dart::dynamics::ShapePtr& shape,
                                             const Eigen::Isometry3d& X_BS, double friction,
                                             double restitution, const ShapeUse& use) {
    using namespace dart::dynamics;
    auto* result = node->createShapeNodeWith<CollisionAspect, DynamicsAspect>(shape);
    result->setRelativeTransform(X_BS);
    result->getDynamicsAspect()->setFrictionCoeff(friction);
    result->getDynamicsAspect()->setRestitutionCoeff(restitution);
    uses_.emplace(result, use);
    return result;
  }

  /// False where an assertion of the library would end the process: its equations of motion would
  /// not be finite. `beyond_range_` then says whose.
  bool apply(const simulation::WorldInputs& inputs) {
    for_each_force(forced_, inputs, [&](std::size_t body, const simulation::ForceInput& force) {
      if (!moderate(force.force) || !moderate(force.torque)) beyond_range_ = body;
      BodyNode* node = bodies_[body].node;
      node->addExtForce(eigen(force.force), eigen(force.point));
      node->addExtTorque(eigen(force.torque));
    });
    for (const Body& body : bodies_) {
      if (!moderate(now_[body.index].velocity) || !moderate(now_[body.index].angular_velocity))
        beyond_range_ = body.index;
      if (body.joint < 0) continue;
      const double torque = inputs.joint_torques[static_cast<std::size_t>(body.joint)];
      if (!moderate({torque, 0., 0.})) beyond_range_ = body.index;
      body.node->getParentJoint()->setForce(0, torque);
    }
    return !beyond_range_;
  }

  Touch touch_of(const dart::collision::Contact& contact) const {
    const ShapeUse& first = uses_.at(contact.collisionObject1->getShapeFrame());
    if (first.body >= 0) return {first, vector(contact.force), vector(contact.normal)};
    return {uses_.at(contact.collisionObject2->getShapeFrame()), -vector(contact.force),
            -vector(contact.normal)};
  }

  DartSettings settings_;
  ShapeUses uses_;
  std::shared_ptr<DartGroundDetector> detector_;
  std::shared_ptr<DartShapesFilter> filter_;
  dart::simulation::WorldPtr world_;
  std::vector<std::string> trails_;  ///< of the bodies, as published
  ContactLimit limit_, slow_;
  std::vector<dart::dynamics::SkeletonPtr> skeletons_;
  std::vector<Body> bodies_;
  std::vector<std::size_t> forced_;  ///< the body of each force
  std::optional<std::size_t> beyond_range_;
  std::optional<NearGround> near_ground_;
  std::vector<BodyState> now_;  ///< after the last step
  std::vector<JointState> joints_now_;
};

}  // namespace

std::unique_ptr<PeerWorld> make_dart_world(const simulation::Experiment& experiment,
                                           Settings settings) {
  std::unique_ptr<PeerWorld> world;
  if (!survives_abort([&] {
        world = std::make_unique<DartWorld>(
            experiment, dart_settings(settings, experiment.deltat, ground_material(experiment)));
      }))
    throw simulation::ExperimentError(
        "engine dart: an assertion of DART's, whose words are on standard error, fails for this "
        "experiment; look for an extreme mass, length, speed or place");
  return world;
}

}  // namespace hookpoint::reference
