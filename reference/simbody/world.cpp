#include "reference/simbody/world.h"

#include <algorithm>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/experiment_checks.h"
#include "reference/external_forces.h"
#include "reference/extremes.h"
#include "reference/ground.h"
#include "reference/pair_materials.h"
#include "reference/robot_tree.h"
#include "reference/simbody/model.h"
#include "reference/simbody/settings.h"
#include "reference/touching_points.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::JointState;

simbody::Vec plain(const Vector3d& a) { return {a.x, a.y, a.z}; }
Vector3d vector(const simbody::Vec& a) { return {a[0], a[1], a[2]}; }
simbody::Frame frame(const Vector3d& position, const Quaterniond& q) {
  return {plain(position), {q.w, q.x, q.y, q.z}};
}

simbody::Body::Mobility mobility(const TreeBody& body) {
  using enum simbody::Body::Mobility;
  if (body.link != nullptr) return body.turns() ? turning : sliding;
  if (body.plane_normal) return planar;
  return body.mobile ? free : fixed;
}

simbody::Body describe(const TreeBody& tree) {
  const simulation::MassSpec& mass = tree.body->mass;
  const Symmetric3d& I = mass.inertia;
  simbody::Body body;
  body.mobility = mobility(tree);
  body.parent = tree.parent;
  body.X_PL0 = tree.link != nullptr ? frame(tree.X_PL0.position, tree.X_PL0.orientation)
                                    : frame(tree.initial.position, tree.initial.orientation);
  if (tree.plane_normal)
    body.X_WF = frame(tree.initial.position, plane_axes(*tree.plane_normal).turn);
  body.mass = mass.mass;
  body.center_of_mass = plain(mass.center_of_mass);
  body.inertia = {I.xx, I.yy, I.zz, I.xy, I.xz, I.yz};
  body.velocity = plain(tree.initial.velocity);
  body.angular_velocity = plain(tree.initial.angular_velocity);
  if (tree.link != nullptr) {
    body.angle = tree.link->angle;
    body.rate = tree.link->rate;
  }
  return body;
}

/// Of a foot on the ground, or of the ground alone.
simbody::Material describe(const contact::MaterialConstants<double>& material,
                           const SimbodySettings& settings) {
  return {settings.stiffness,        settings.dissipation,         material.static_friction,
          material.kinetic_friction, settings.transition_velocity, settings.penalty,
          material.normal_stiffness, material.normal_damping,      material.tangential_damping};
}

/// Simbody makes 2 a b/(a + b) of the coefficients a and b of two surfaces: a ground far rougher than
/// all feet leaves what these say, twice.
constexpr double rough = 1e6;
double beside_rough(double friction) { return friction * rough / (2. * rough - friction); }

/// The materials of the ground and of what touches it, as Simbody is to have them.
class SimbodyMaterials {
 public:
  SimbodyMaterials(const simulation::Experiment& experiment, const SimbodySettings& settings)
      : pairs_(experiment),
        settings_(settings),
        ground_(experiment.terrain ? experiment.terrain->material : simulation::no_material) {
    if (settings.penalty) return;
    for (const simulation::RobotSpec& robot : experiment.robots)
      simulation::for_each_body(robot, [&](const simulation::BodySpec& body) {
        by_feet_ = by_feet_ || has_material(body);
      });
  }

  simbody::Material ground() const {
    simbody::Material material = describe(pairs_.of(simulation::no_material, ground_), settings_);
    if (by_feet_) material.static_friction = material.kinetic_friction = rough;
    return material;
  }
  simbody::Material of(int foot) const {
    simbody::Material material = describe(pairs_.of(foot, ground_), settings_);
    if (!by_feet_) return material;
    material.static_friction = beside_rough(material.static_friction);
    material.kinetic_friction = beside_rough(material.kinetic_friction);
    return material;
  }

 private:
  PairMaterials pairs_;
  const SimbodySettings& settings_;
  int ground_;
  bool by_feet_ = false;  ///< feet have materials of their own
};

simbody::Surface describe(const TouchingPoint& point, int index) {
  using Kind = simbody::Surface::Kind;
  simbody::Surface surface;
  surface.kind = point.radius == 0. ? Kind::point : Kind::ball;
  surface.X_BS.position = plain(point.p_BP);
  surface.radius = point.radius == 0. ? point_ball_radius : point.radius;
  surface.point = index;
  return surface;
}

/// A box or a sphere: others are gaps of the row (engine.cpp).
simbody::Surface describe(const simulation::ShapeSpec& shape) {
  simbody::Surface surface;
  surface.X_BS = frame(shape.location, shape.orientation);
  if (const auto* sphere = std::get_if<simulation::Sphere>(&shape.geometry)) {
    surface.kind = simbody::Surface::Kind::ball;
    surface.radius = sphere->radius;
  } else {
    surface.half_lengths = plain(0.5 * std::get<simulation::Box>(shape.geometry).dimensions);
  }
  return surface;
}

simbody::Description describe(const simulation::Experiment& experiment, const RobotTree& tree,
                              const SimbodySettings& settings) {
  const SimbodyMaterials materials(experiment, settings);
  simbody::Description result;
  result.gravity = plain(experiment.gravity);
  result.accuracy = settings.accuracy;
  result.material = materials.ground();
  const auto add = [&](simbody::Surface surface, int foot, simbody::Body& body) {
    surface.material = materials.of(foot);
    body.surfaces.push_back(surface);
  };
  if (experiment.terrain) {
    const auto plane = std::get<GroundPlane>(ground_of(*experiment.terrain));
    result.ground = {plain(plane.normal), plane.offset, point_ball_radius};
  }
  for (const TreeBody& body : tree.bodies) {
    result.bodies.push_back(describe(body));
    if (!body.mobile) continue;
    for (const simulation::ShapeSpec* shape : touching_shapes(experiment, *body.body))
      add(describe(*shape), shape->material, result.bodies.back());
  }
  const auto points = touching_points(experiment, tree);
  for (std::size_t i = 0; i < points.size(); ++i)
    add(describe(points[i], static_cast<int>(i)), points[i].material,
        result.bodies[points[i].body]);
  return result;
}

class SimbodyWorld final : public PeerWorld {
 public:
  SimbodyWorld(const simulation::Experiment& experiment, const SimbodySettings& settings)
      : deltat_(experiment.deltat) {
    const RobotTree tree = robot_tree(experiment);
    forced_ = forced_bodies(experiment, tree);
    for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
      const TreeBody& body = tree.bodies[i];
      bodies_.push_back({body.mobile, body.link == nullptr ? -1 : body.joint});
      if (!moderate(body.initial.velocity) || !moderate(body.initial.angular_velocity))
        beyond_range_ = i;
    }
    on_bodies_.resize(bodies_.size());
    on_joints_.resize(bodies_.size());
    if (!beyond_range_) model_.emplace(describe(experiment, tree, settings));
  }

  std::string advance(const simulation::WorldInputs& inputs) override {
    if (!take(inputs)) return {};
    try {
      model_->apply(on_bodies_, on_joints_);
      model_->step_to(static_cast<double>(++steps_) * deltat_);
      return {};
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      lost_ = true;
      return std::string("Simbody gave up: ") + error.what() + smaller_step_helps;
    }
  }

  std::optional<std::size_t> beyond_range() const override { return beyond_range_; }

  void read(std::span<BodyState> bodies, std::span<JointState> joints) const override {
    if (!model_ || lost_) return;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies[i].contacts = 0;
      if (!bodies_[i].mobile) continue;
      bodies[i].contact_force =
          (1. / deltat_) * vector(model_->ground_impulse(static_cast<int>(i)));
      const simbody::Motion motion = model_->motion(static_cast<int>(i));
      const auto& q = motion.frame.orientation;
      bodies[i].position = vector(motion.frame.position);
      bodies[i].orientation = {q[0], q[1], q[2], q[3]};
      bodies[i].velocity = vector(motion.velocity);
      bodies[i].angular_velocity = vector(motion.angular_velocity);
      if (bodies_[i].joint < 0) continue;
      joints[static_cast<std::size_t>(bodies_[i].joint)].angle = motion.angle;
      joints[static_cast<std::size_t>(bodies_[i].joint)].rate = motion.rate;
    }
    for (const simbody::Touch& touch : model_->touches()) {
      BodyState& state = bodies[static_cast<std::size_t>(touch.body)];
      if (norm(vector(touch.force)) > 0.) state.contacts += touch.count;
    }
  }

  void read_points(std::span<Vector3d> forces) const override {
    std::ranges::fill(forces, Vector3d{});
    if (!model_) return;
    for (const simbody::Touch& touch : model_->touches())
      if (touch.point >= 0) forces[static_cast<std::size_t>(touch.point)] += vector(touch.force);
  }

  void read_shapes(std::vector<ShapeForce>& forces) const override {
    if (!model_) return;
    for (const simbody::Touch& touch : model_->touches())
      if (touch.point < 0)
        forces.push_back(
            {static_cast<std::size_t>(touch.body), vector(touch.position), vector(touch.force)});
  }
  simulation::GroundForceTime force_time() const override {
    return simulation::GroundForceTime::now;
  }

 private:
  struct Body {
    bool mobile;
    int joint;  ///< as published; -1: a base
  };

  /// What acts over the step; false where it is extreme, and `beyond_range_` then says on whom.
  bool take(const simulation::WorldInputs& inputs) {
    std::ranges::fill(on_bodies_, simbody::Load{});
    for_each_force(forced_, inputs, [&](std::size_t body, const simulation::ForceInput& input) {
      if (beyond_range_) return;
      if (!moderate(input.force) || !moderate(input.torque)) beyond_range_ = body;
      const auto q = model_->motion(static_cast<int>(body)).frame.orientation;
      const Vector3d arm = rotate(Quaterniond{q[0], q[1], q[2], q[3]}, input.point);
      simbody::Load& load = on_bodies_[body];
      load.force = plain(vector(load.force) + input.force);
      load.torque = plain(vector(load.torque) + input.torque + cross(arm, input.force));
    });
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (bodies_[i].joint < 0) continue;
      on_joints_[i] = inputs.joint_torques[static_cast<std::size_t>(bodies_[i].joint)];
      if (!moderate({on_joints_[i], 0., 0.})) beyond_range_ = i;
    }
    return !beyond_range_;
  }

  double deltat_;
  std::vector<Body> bodies_;
  std::vector<std::size_t> forced_;  ///< the body of each force
  std::vector<simbody::Load> on_bodies_;
  std::vector<double> on_joints_;  ///< one a body
  std::optional<std::size_t> beyond_range_;
  bool lost_ = false;  ///< the integrator gave up, and its state is not to be asked for
  std::optional<simbody::Model> model_;  ///< none where the experiment starts beyond its range
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<PeerWorld> make_simbody_world(const simulation::Experiment& experiment,
                                              Settings settings) {
  return std::make_unique<SimbodyWorld>(experiment, simbody_settings(settings));
}

}  // namespace hookpoint::reference
