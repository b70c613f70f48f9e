#include "reference/peer_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <new>
#include <optional>
#include <utility>
#include <variant>

#include "reference/experiment_checks.h"
#include "reference/ground.h"
#include "reference/held_back_torques.h"
#include "reference/touching_points.h"
#include "simulation/engine_interface/drive_watch.h"
#include "simulation/engine_interface/restartable.h"
#include "simulation/experiment/joint_forces.h"
#include "simulation/experiment/names.h"

namespace hookpoint::reference {
namespace {

using simulation::BodyState;
using simulation::JointState;
using simulation::StepStatus;

bool finite(const Vector3d& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
bool finite(const BodyState& body) {
  const Quaterniond& q = body.orientation;
  return finite(body.position) && finite(body.velocity) && finite(body.angular_velocity) &&
         finite(body.contact_force) && finite(Vector3d{q.x, q.y, q.z}) && std::isfinite(q.w);
}

/// The world of an experiment. Throws ExperimentError.
std::unique_ptr<PeerWorld> library_world(const simulation::Experiment& experiment,
                                         const WorldSource& source) {
  try {
    return source.make_world(experiment);
  } catch (const simulation::ExperimentError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw simulation::ExperimentError(
        fmt::format("engine {} refuses this experiment: {}", source.engine.name, error.what()));
  }
}

class PeerEngine final : public simulation::Engine,
                         public simulation::Restartable,
                         public simulation::Saveable {
 public:
  PeerEngine(const simulation::Experiment& experiment, WorldSource source,
             std::vector<std::string> notices)
      : experiment_(with_samples(experiment, source.engine)),
        source_(std::move(source)),
        world_(library_world(experiment_, source_)),
        tree_(robot_tree(experiment_)),
        trails_(simulation::body_trails(experiment_)),
        inputs_(simulation::initial_inputs(experiment_)),
        drives_(experiment_),
        acting_(inputs_),
        touching_(touching_points(experiment_, tree_)),
        point_forces_(touching_.size()) {
    if (experiment_.terrain) ground_.emplace(*experiment_.terrain);
    for (const TreeBody& body : tree_.bodies) {
      if (body.link != nullptr) passive_joints_.push_back(simulation::joint_properties(*body.link));
    }
    for (const simulation::RobotSpec& robot : experiment_.robots)
      held_back_.emplace_back(robot, experiment_.deltat);
    drive_torques_.resize(passive_joints_.size());
    state_.bodies.resize(tree_.bodies.size());
    state_.joints.resize(passive_joints_.size());
    hooks_.resize(passive_joints_.size());
    state_.points.resize(experiment_.points.size());
    state_.loops.resize(experiment_.loops.size());
    state_.notices = std::move(notices);
    take_start(tree_);
  }

  /// The library's world is made again: its own state can be neither read nor set.
  void restart(const simulation::Experiment& start) override {
    world_ = library_world(with_samples(start, source_.engine), source_);
    failure_ = {};
    simulation::restart_inputs(start, inputs_);
    acting_.joint_torques = inputs_.joint_torques;
    state_.step = 0;
    state_.time = 0.;
    state_.ground_forces.clear();
    std::ranges::fill(state_.points, simulation::PointState{});
    take_start(robot_tree(start));
    if (has_details_) publish_points();
  }

  simulation::Saveable* saveable() override { return this; }
  std::size_t state_size() const override { return simulation::count_of(*this); }
  std::string state_layout() const override { return simulation::layout_of(*this); }
  void save(std::span<double> numbers) const override { simulation::save_to(numbers, *this); }
  /// What it publishes, in the order in which a movie has it.
  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    archive.each("body", self.state_.bodies, [](auto& body, auto& each) {
      each("position", body.position);
      each("orientation", body.orientation);
      each("velocity", body.velocity);
      each("angular_velocity", body.angular_velocity);
      each("contact_force", body.contact_force);
    });
    archive.each("joint", self.state_.joints, [](auto& joint, auto& each) {
      each("angle", joint.angle);
      each("rate", joint.rate);
      each("torque", joint.torque);
    });
  }

  StepStatus step() override {
    if (!failure_.ok()) return failure_;
    drives_.look(inputs_, state_.joints, state_.time, state_.notices);
    take_inputs();
    const std::string trouble = world_->advance(acting_);
    world_->read(next_bodies_, next_joints_);
    const std::optional<std::size_t> beyond_range = world_->beyond_range();
    for (std::size_t i = 0; i < next_bodies_.size(); ++i)
      if (!finite(next_bodies_[i]) || !joint_finite(tree_.bodies[i]) || beyond_range == i)
        return fail(StepStatus::Kind::not_finite, i,
                    "the state is not finite; look for an extreme force, mass or speed, or reduce "
                    "deltat");
    if (!trouble.empty())
      return fail(world_->lost() ? StepStatus::Kind::engine_lost : StepStatus::Kind::solver_failed,
                  0, trouble);
    publish();
    for (simulation::SurfaceMotion& obstacle : inputs_.obstacles)
      simulation::advance(obstacle, experiment_.deltat);
    if (std::string notice = world_->notice(); !notice.empty()) notify(std::move(notice));
    look_for_open_loop();
    return {};
  }

  /// A joint's own torque follows its motion, so that inputs are others in each step.
  void announce(std::int64_t steps) override {
    if (tree_.joints == 0) world_->announce(steps);
  }
  const simulation::WorldState& state() const override { return state_; }
  simulation::WorldInputs& inputs() override { return inputs_; }
  void publish_details() override {
    has_details_ = true;
    publish_points();
  }
  void tell_contacts(std::vector<simulation::ContactView>& contacts) const override {
    contacts.clear();
    if (!ground_ || state_.step == 0) return;
    std::vector<Vector3d> forces(touching_.size());
    world_->read_points(forces);
    const auto add = [&](std::size_t body, const Vector3d& point, const Vector3d& force) {
      if (dot(force, force) == 0.) return;
      contacts.push_back({body, point, force, point, ground_->query(point).depth, -1.});
    };
    for (std::size_t i = 0; i < touching_.size(); ++i) {
      const std::size_t body = touching_[i].body;
      add(body, meet(*ground_, touching_[i], state_.bodies[body]).position, forces[i]);
    }
    // Where the step began, which is at most a step's motion away.
    std::vector<ShapeForce> shapes;
    world_->read_shapes(shapes);
    for (const ShapeForce& shape : shapes) add(shape.body, shape.position, shape.force);
  }
  void publish_ground_forces() override { state_.ground_force_time = tells_ground_forces(); }
  simulation::GroundForceTime tells_ground_forces() const override { return world_->force_time(); }

 private:
  void notify(std::string notice) {
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%g s: ", state_.time);
    state_.notices.push_back(time.data() + std::move(notice));
  }

  /// Notices the first loop that the library does not keep closed: bodies then do what they like.
  void look_for_open_loop() {
    if (loop_opened_) return;
    for (std::size_t i = 0; i < experiment_.loops.size(); ++i) {
      const double error = state_.loops[i].error;
      if (!(error > open_part * loop_sizes_[i])) continue;
      loop_opened_ = true;
      const simulation::LoopSpec& loop = experiment_.loops[i];
      return notify(fmt::format(
          "engine {}: Loop {}.{} has opened by {:.2g} m, more than {:g} of the distance of its places from "
          "the base: the engine does not keep it closed; make deltat smaller, give links masses that are "
          "not so different, or choose engine dts",
          source_.engine.name, experiment_.robots[loop.robot].name, loop.name, error, open_part));
    }
  }

  /// Of each loop the greatest distance of its two places from the robot's base [m].
  void measure_loops() {
    loop_sizes_.clear();
    for (const simulation::LoopSpec& loop : experiment_.loops) {
      const Vector3d& base = state_.bodies[tree_.index(loop.robot, 0)].position;
      const auto distance = [&](int number, const Vector3d& point) {
        const BodyState& body = state_.bodies[tree_.index(loop.robot, number)];
        return norm(body.position + rotate(body.orientation, point) - base);
      };
      loop_sizes_.push_back(
          std::max(distance(loop.body_a, loop.point_a), distance(loop.body_b, loop.point_b)));
    }
    loop_opened_ = false;
  }

  /// Publishes the initial state of the robots.
  void take_start(const RobotTree& tree) {
    for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
      const TreeBody& body = tree.bodies[i];
      state_.bodies[i] = body.initial;
      if (body.link == nullptr) continue;
      const auto joint = static_cast<std::size_t>(body.joint);
      state_.joints[joint] = {body.link->angle, body.link->rate};
      hooks_[joint] = {body.link->angle};
    }
    std::ranges::fill(state_.loops, simulation::LoopState{});
    next_bodies_ = state_.bodies;
    next_joints_ = state_.joints;
    measure_loops();
  }

  /// What the joints exert by themselves (docs/joints.md) and what their drives may give every peer
  /// has as an explicit torque, from the state at the step's start; what drives hold back at their
  /// velocity_limit also from the step before.
  void take_inputs() {
    acting_.forces = inputs_.forces;
    acting_.pull = inputs_.pull;
    acting_.ground = inputs_.ground;
    if (inputs_.ground.belt_velocity != Vector3d{})
      acting_.ground.belt_velocity =
          along_ground(*experiment_.terrain, inputs_.ground.belt_velocity);
    acting_.obstacles = inputs_.obstacles;
    for (const TreeBody& body : tree_.bodies) {
      if (body.link == nullptr) continue;
      const auto joint = static_cast<std::size_t>(body.joint);
      const JointState& now = state_.joints[joint];
      const simulation::JointProperties& passive = passive_joints_[joint];
      hooks_[joint] = simulation::dragged(passive, now.angle, now.rate, hooks_[joint]);
      drive_torques_[joint] = simulation::drive_torque(passive, inputs_.joint_torques[joint]);
      acting_.joint_torques[joint] =
          drive_torques_[joint] +
          simulation::passive_joint_torque(passive, now.angle, now.rate, hooks_[joint]);
    }
    for (std::size_t i = 0; i < held_back_.size(); ++i) {
      const std::size_t body = tree_.bases[i], joint = inputs_.first_joints[i];
      const std::size_t count = simulation::joint_count(experiment_.robots[i]);
      held_back_[i].take(std::span(drive_torques_).subspan(joint, count),
                         std::span(state_.bodies).subspan(body, count + 1),
                         std::span(state_.joints).subspan(joint, count),
                         std::span(acting_.joint_torques).subspan(joint, count));
    }
  }

  bool joint_finite(const TreeBody& body) const {
    if (body.link == nullptr) return true;
    const JointState& joint = next_joints_[static_cast<std::size_t>(body.joint)];
    return std::isfinite(joint.angle) && std::isfinite(joint.rate);
  }

  /// Copied, not swapped: whoever reads a value keeps its address.
  void publish() {
    for (std::size_t i = 0; i < next_joints_.size(); ++i) {
      next_joints_[i].acceleration =
          (next_joints_[i].rate - state_.joints[i].rate) / experiment_.deltat;
      next_joints_[i].torque = acting_.joint_torques[i];
    }
    for (std::size_t i = 0; i < next_bodies_.size(); ++i)
      next_bodies_[i].orientation =
          continued(next_bodies_[i].orientation, state_.bodies[i].orientation);
    const auto told = state_.ground_force_time;
    if (told == simulation::GroundForceTime::last_step) read_ground_forces(state_.bodies);
    if (told == simulation::GroundForceTime::now) read_ground_forces(next_bodies_);
    std::ranges::copy(next_bodies_, state_.bodies.begin());
    std::ranges::copy(next_joints_, state_.joints.begin());
    publish_loops();
    ++state_.step;
    state_.time = static_cast<double>(state_.step) * experiment_.deltat;
    if (has_details_) publish_points();
  }

  void publish_loops() {
    world_->read_loops(state_.loops);
    for (std::size_t i = 0; i < experiment_.loops.size(); ++i) {
      const simulation::LoopSpec& loop = experiment_.loops[i];
      const BodyState& a = state_.bodies[tree_.index(loop.robot, loop.body_a)];
      const BodyState& b = state_.bodies[tree_.index(loop.robot, loop.body_b)];
      state_.loops[i].error = norm(a.position + rotate(a.orientation, loop.point_a) - b.position -
                                   rotate(b.orientation, loop.point_b));
    }
  }

  /// The ground's forces on bodies that stood as `bodies` when these acted.
  void read_ground_forces(std::span<const BodyState> bodies) {
    state_.ground_forces.clear();
    shape_forces_.clear();
    world_->read_points(point_forces_);
    for (std::size_t i = 0; i < touching_.size() && ground_; ++i)
      if (dot(point_forces_[i], point_forces_[i]) > 0.)
        shape_forces_.push_back({touching_[i].body,
                                 meet(*ground_, touching_[i], bodies[touching_[i].body]).position,
                                 point_forces_[i]});
    world_->read_shapes(shape_forces_);
    for (const ShapeForce& force : shape_forces_) {
      const BodyState& body = bodies[force.body];
      const Vector3d arm = rotate(conjugate(body.orientation), force.position - body.position);
      state_.ground_forces.push_back({force.body, arm, force.force});
    }
  }

  /// Where the named points are now, and the force of the step that led there.
  void publish_points() {
    world_->read_points(point_forces_);
    for (std::size_t i = 0; i < experiment_.points.size(); ++i) {
      const simulation::PointSpec& spec = experiment_.points[i];
      const std::size_t body = tree_.index(spec.robot, spec.body);
      const auto at = std::ranges::find_if(touching_, [&](const TouchingPoint& point) {
        return point.body == body && point.point == spec.point;
      });
      // As in our engine, the points of a fixed base, and all where there is no ground, are left
      // out.
      if (at == touching_.end() || !ground_) continue;
      const Meeting meeting = meet(*ground_, *at, state_.bodies[body]);
      const Vector3d& force = point_forces_[static_cast<std::size_t>(at - touching_.begin())];
      state_.points[i] = point_state(meeting, state_.bodies[body], force);
    }
  }

  /// The library's own state is lost with the failure, so every later step repeats it.
  StepStatus fail(StepStatus::Kind kind, std::size_t body, std::string advice) {
    failure_ = {kind, state_.time, trails_[body], std::move(advice)};
    return failure_;
  }

  const simulation::Experiment experiment_;
  const WorldSource source_;
  std::unique_ptr<PeerWorld> world_;
  const RobotTree tree_;
  const std::vector<std::string> trails_;
  simulation::WorldInputs inputs_;
  simulation::DriveWatch drives_;
  simulation::WorldInputs acting_;  ///< with what the joints exert by themselves
  std::optional<contact::Terrain> ground_;
  const std::vector<TouchingPoint> touching_;
  std::vector<Vector3d> point_forces_;
  std::vector<ShapeForce> shape_forces_;
  simulation::WorldState state_;
  std::vector<BodyState> next_bodies_;
  std::vector<JointState> next_joints_;
  std::vector<simulation::JointProperties> passive_joints_;
  std::vector<simulation::FrictionHook> hooks_;  ///< of the joints' dry friction
  std::vector<double> drive_torques_;            ///< within effort_limit
  std::vector<HeldBackTorques> held_back_;       ///< one a robot
  /// Of the distance of a loop's places from the base: a loop that is so far open is lost.
  static constexpr double open_part = 0.1;
  std::vector<double> loop_sizes_;  ///< [m]
  bool loop_opened_ = false;        ///< said once
  bool has_details_ = false;
  StepStatus failure_;
};

/// Refuses a grid that the library cannot take, before it allocates anything: some libraries do not
/// check what their allocations return. Throws std::bad_alloc where the memory is not there.
void check_triangles(const simulation::Experiment& experiment, const Peer& peer) {
  if (!experiment.terrain || peer.triangles.most == 0) return;
  const auto* grid = std::get_if<simulation::GridSpec>(&experiment.terrain->surface);
  if (grid == nullptr || grid->stairs) return;
  const auto count = 2 * static_cast<std::size_t>(std::max(grid->rows - 1, 0)) *
                     static_cast<std::size_t>(std::max(grid->columns - 1, 0));
  if (count > peer.triangles.most)
    throw simulation::ExperimentError(
        fmt::format("engine {}: terrain '{}' has {} triangles, and {} takes at most {} here: raise "
                    "its spacing, make it smaller, or choose another engine",
                    peer.name, experiment.terrain->name, count, peer.library, peer.triangles.most));
  const double bytes = peer.triangles.bytes_per_triangle * static_cast<double>(count);
  // Released at once: only whether there is room matters.
  ::operator delete(::operator new(static_cast<std::size_t>(bytes)));
}

}  // namespace

std::unique_ptr<simulation::Engine> make_peer_engine(const simulation::Experiment& experiment,
                                                     WorldSource source,
                                                     std::vector<std::string> notices) {
  return std::make_unique<PeerEngine>(experiment, std::move(source), std::move(notices));
}

std::unique_ptr<simulation::Engine> make_peer_engine(const simulation::Experiment& experiment,
                                                     const Peer& peer) {
  const std::string engine = "engine " + std::string(peer.name) + ": ";
  if (!peer.found())
    throw simulation::ExperimentError(engine + "this build has no " + std::string(peer.library) +
                                      "; install " + std::string(peer.package) +
                                      " and build again");
  const simulation::EngineDescription description = peer.describe();
  auto notices = check_supported(experiment, description);
  std::ranges::move(notices_of_unread_constants(experiment, description),
                    std::back_inserter(notices));
  check_triangles(experiment, peer);
  return make_peer_engine(experiment,
                          {peer.describe(),
                           [&peer](const simulation::Experiment& of) {
                             return peer.make_world(of, settings_of(of, peer));
                           }},
                          std::move(notices));
}

}  // namespace hookpoint::reference
