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
#include <set>
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
#include "reference/pair_materials.h"
#include "reference/robot_tree.h"
#include "reference/solids.h"
#include "reference/touching_points.h"
#include "simulation/experiment/names.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::reference {
namespace {

using dart::dynamics::BodyNode;
using simulation::BodyState;
using simulation::JointState;

/// Contacts at once whose rows take DART's solver some 10 ms a step.
constexpr std::size_t slow_contacts = 100;
/// Of a ball that is never collided [m].
constexpr double marker_size = 1e-3;

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
        materials_(experiment),
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
    if (experiment.terrain) add_ground(experiment);
    for (const Solid& solid : solids_of(experiment)) add_solid(experiment, solid);
    add_touching(experiment, tree);
    for (const auto& skeleton : skeletons_) world_->addSkeleton(skeleton);
    for (const TreeBody& body : tree.bodies) now_.push_back(body.initial);
    joints_now_.resize(tree.joints);
    read_motion();
  }

  std::string advance(const simulation::WorldInputs& inputs) override {
    if (near_ground_) keep_below(*near_ground_);
    move_surfaces(inputs);
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
    return std::string("an assertion of DART's failed, whose words are on standard error") +
           smaller_step_helps;
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
    const Ground plan = ground_of(*experiment.terrain);
    detector_->terrain.emplace(*experiment.terrain);
    BodyNode* node = nullptr;
    dart::dynamics::WeldJoint* weld = nullptr;
    if (simulation::ground_moves(experiment)) {
      belt_ = add_standing_body<dart::dynamics::FreeJoint>("ground", node);
    } else {
      weld = add_standing_body<dart::dynamics::WeldJoint>("ground", node);
    }
    const auto* plane = std::get_if<GroundPlane>(&plan);
    constexpr double far_width = 2e3;
    const double near_width = 20. * reach(experiment);
    // Two triangles meet in single precision in DART (tri_tri_intersection_test.hpp): on a ground
    // of 2 km a block has no contacts while it is less than some 30 um deep.
    if (settings_.tessellated && plane != nullptr && weld != nullptr && near_width > 0.)
      near_ground_ = NearGround{weld, eigen(plane->normal), near_width};
    DartGround ground = make_dart_ground(plan, near_ground_ ? near_width : far_width);
    const bool seen = ground.shape != nullptr;
    // What stands for stairs under boundary points has no shape of its own.
    if (!seen) ground.shape = std::make_shared<dart::dynamics::SphereShape>(marker_size);
    DartStanding standing;
    const std::size_t materials = std::max<std::size_t>(experiment.materials.size(), 1);
    for (std::size_t i = 0; i < materials; ++i)
      add_surfaces(experiment, *node, ground, static_cast<int>(i), standing);
    const int own = std::min(experiment.terrain->material, static_cast<int>(materials) - 1);
    if (seen)
      filter_->ground = standing.shape = standing.surfaces.at({simulation::no_material, own});
    detector_->standing.push_back(std::move(standing));
  }

  /// A step of stairs belongs to the ground, an obstacle is a body of its own that is moved.
  void add_solid(const simulation::Experiment& experiment, const Solid& solid) {
    BodyNode* node = nullptr;
    const Eigen::Isometry3d X_WS = transform(solid.pose.position, solid.pose.orientation);
    DartGround shape{make_dart_shape(solid.geometry)};
    DartStanding standing;
    const std::string name = "solid " + std::to_string(detector_->standing.size());
    auto* joint = add_standing_body<dart::dynamics::FreeJoint>(name, node);
    dart::dynamics::FreeJoint::setTransformOf(joint, X_WS);
    if (solid.obstacle) {
      obstacles_.push_back({joint, *solid.obstacle});
      standing.material = solid.material;
      add_surfaces(experiment, *node, shape, solid.material, standing);
    } else {
      for (std::size_t i = 0; i < experiment.materials.size(); ++i)
        add_surfaces(experiment, *node, shape, static_cast<int>(i), standing);
    }
    standing.shape = standing.surfaces.at({simulation::no_material, solid.material});
    filter_->solids.push_back(standing.shape);
    detector_->standing.push_back(std::move(standing));
  }

  /// A body that nothing but move_surfaces() moves.
  template <class Joint>
  Joint* add_standing_body(const std::string& name, BodyNode*& node) {
    const auto skeleton = dart::dynamics::Skeleton::create(name);
    const auto [joint, created] = skeleton->createJointAndBodyNodePair<Joint>();
    skeleton->setMobile(false);
    skeletons_.push_back(skeleton);
    node = created;
    return joint;
  }

  /// A node for each material of a foot on `material`.
  void add_surfaces(const simulation::Experiment& experiment, BodyNode& node,
                    const DartGround& ground, int material, DartStanding& standing) {
    std::set<int> feet{simulation::no_material};
    for (const simulation::RobotSpec& robot : experiment.robots)
      simulation::for_each_body(robot, [&](const simulation::BodySpec& body) {
        feet.insert(body.boundary_materials.begin(), body.boundary_materials.end());
        for (const simulation::ShapeSpec& shape : body.shapes) feet.insert(shape.material);
      });
    for (const int foot : feet) {
      const auto& made = materials_.of(foot, material);
      standing.surfaces[{foot, material}] =
          add_shape(&node, ground.shape, ground.pose, single_friction(made),
                    settings_.restitution ? made.restitution : 0., {});
    }
  }

  void move_surfaces(const simulation::WorldInputs& inputs) {
    if (belt_ != nullptr) belt_->setLinearVelocity(eigen(inputs.ground.belt_velocity));
    for (const auto& [joint, index] : obstacles_) {
      const simulation::SurfaceMotion& motion = inputs.obstacles[index];
      dart::dynamics::FreeJoint::setTransformOf(joint,
                                                transform(motion.position, motion.orientation));
      joint->setAngularVelocity(eigen(motion.angular_velocity));
      joint->setLinearVelocity(eigen(motion.velocity));
    }
  }

  /// Of the shapes of the experiment's one body about its origin [m]; 0 where there are others.
  static double reach(const simulation::Experiment& experiment) {
    if (experiment.robots.size() != 1 || !experiment.robots[0].chains.empty()) return 0.;
    const simulation::BodySpec& base = experiment.robots[0].base;
    if (!touching_points(experiment, base, 0).empty()) return 0.;
    double largest = 0.;
    for (const simulation::ShapeSpec* shape : touching_shapes(experiment, base)) {
      const auto box = make_dart_shape(shape->geometry)->getBoundingBox();
      largest = std::max(largest, norm(shape->location) + box.computeHalfExtents().norm());
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
    if (experiment.terrain)
      for (std::size_t i = 0; i < points.size(); ++i) add_ball(points[i], static_cast<int>(i));
    for (const Body& body : bodies_)
      if (body.mobile)
        for (const auto* shape : touching_shapes(experiment, *tree.bodies[body.index].body))
          add_robot_shape(experiment, body, *shape);
  }

  void add_robot_shape(const simulation::Experiment& experiment, const Body& body,
                       const simulation::ShapeSpec& shape) {
    const auto* sphere = std::get_if<simulation::Sphere>(&shape.geometry);
    const bool stairs = experiment.terrain && filter_->ground == nullptr;
    const bool round = sphere != nullptr && !settings_.tessellated && !stairs;
    if (round && experiment.terrain)
      add_ball({body.index, -1, shape.location, sphere->radius, shape.material}, -1);
    if (round && filter_->solids.empty()) return;
    const auto* node = add_robot_node(body.node, make_dart_shape(shape.geometry),
                                      transform(shape.location, shape.orientation),
                                      {static_cast<int>(body.index), -1});
    detector_->foot_materials.emplace(node, shape.material);
    (round ? filter_->balls : filter_->shapes).push_back(node);
  }

  void add_ball(const TouchingPoint& place, int point) {
    // Of a shape that nothing but its node is used of.
    const auto* node = add_robot_node(
        bodies_[place.body].node, std::make_shared<dart::dynamics::SphereShape>(marker_size),
        transform(place.p_BP, {}), {static_cast<int>(place.body), point});
    detector_->balls.push_back({node, place});
  }

  /// The smaller coefficient of friction counts, and the product of those of restitution: the
  /// ground has the material's, the robot others that leave it so.
  const dart::dynamics::ShapeNode* add_robot_node(BodyNode* node,
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
  PairMaterials materials_;
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
  dart::dynamics::FreeJoint* belt_ = nullptr;  ///< of ground whose material moves
  std::vector<std::pair<dart::dynamics::FreeJoint*, std::size_t>> obstacles_;
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
