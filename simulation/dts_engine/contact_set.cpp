#include "simulation/dts_engine/contact_set.h"

#include <cmath>

#include "contact/bristle_step.h"
#include "contact/laws/surface_forces.h"
#include "dts/external_forces.h"
#include "simulation/dts_engine/methods.h"
#include "simulation/experiment/kinematics.h"

namespace hookpoint::simulation {
namespace {

std::vector<ContactPoint> contact_points(const RobotSpec& robot) {
  std::vector<ContactPoint> points;
  for (const BoundaryPoint& boundary : boundary_points(robot))
    static_cast<BoundaryPoint&>(points.emplace_back()) = boundary;
  return points;
}

}  // namespace

ContactSet::ContactSet(const Experiment& experiment, std::size_t index, std::size_t bodies,
                       const contact::Terrain* ground,
                       const integrators::StepperDescription& stepper)
    : experiment_(&experiment),
      index_(index),
      ground_(ground),
      adaptive_(stepper.adaptive()),
      new_velocity_(stepper.moves_with_new_velocity),
      law_(ground != nullptr ? &force_law_of(experiment, adaptive_) : nullptr),
      materials_(experiment),
      bristle_states_(law_ != nullptr ? law_->bristle_states : 0),
      points_(ground ? contact_points(experiment.robots[index]) : std::vector<ContactPoint>{}),
      ground_forces_(bodies),
      ground_impulses_(bodies),
      culling_(bodies) {
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (points_[i].radius > 0.) balls_.push_back(i);
  for (std::size_t body = 0; body <= bodies; ++body) {
    const auto first = std::ranges::lower_bound(points_, body, {}, &ContactPoint::body);
    first_points_.push_back(static_cast<std::size_t>(first - points_.begin()));
  }
  for (std::vector<double>* bristles : {&bristles_, &next_bristles_, &bristle_rates_})
    bristles->resize(bristle_states_ * points_.size());
  materials_.for_each([&](const contact::MaterialConstants<double>& constants) {
    surfaces_act_ = surfaces_act_ || contact::acts_beside_the_law(constants);
  });
  if (ground != nullptr) stretch_springs();
}

void ContactSet::stretch_springs() {
  const RobotSpec& robot = experiment_->robots[index_];
  if (!robot.settled || robot.settled->stretch.empty()) return;
  const std::vector<Vector3d>& start = robot.settled->stretch;
  const std::vector<Pose> X_BL = body_poses(robot);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (start[i] == Vector3d{}) continue;
    ContactPoint& point = points_[i];
    const Pose X_WL = Pose{robot.location, robot.orientation} * X_BL[point.body];
    const dts::BodyMotion<double> body{rotation_matrix(X_WL.orientation), X_WL.position, {}, {}};
    const ContactKinematics touching = contact_kinematics(point, body, *ground_);
    const Vector3d surface = touching.position + touching.tile.depth * touching.tile.normal;
    point.committed = {surface - start[i], start[i], true, false};
    point.committed_frame = ball_frame(point, body, touching.tile);
    put_bristle({start[i]}, i, bristles_);
  }
}

// Forces.

void ContactSet::apply_forces(dts::Workspace<double>& workspace, Evaluation evaluation, double dt) {
  if (points_.empty()) return;
  const bool accepted = evaluation == Evaluation::accepted;
  std::visit(
      [&](const auto& law) {
        for (std::size_t body = 0; body < body_count(); ++body) {
          const dts::BodyMotion<double>& motion = workspace.bodies[body];
          ground_forces_[body] = {};
          const bool above = culling_.is_above(body, motion, *ground_);
          if (accepted && culling_.accept(body, above)) {
            for (std::size_t i = first_points_[body]; i < first_points_[body + 1]; ++i)
              points_[i].leave_ground();
          }
          if (above) continue;
          for (std::size_t i = first_points_[body]; i < first_points_[body + 1]; ++i)
            apply_force(law, i, workspace, evaluation, dt);
        }
      },
      law_->variant);
}

template <class Law>
void ContactSet::apply_force(const Law& law, std::size_t i, dts::Workspace<double>& workspace,
                             Evaluation evaluation, double dt) {
  const bool accepted = evaluation == Evaluation::accepted;
  const std::size_t body = points_[i].body;
  const Place place = place_of(law, points_[i], workspace.bodies[body], evaluation);
  if (accepted) store(i, place);
  if (!place.reached) {
    leave_alone(i, evaluation);
    return;
  }
  contact::Reaction<double> reaction =
      surfaces_act_ ? evaluate_directed(law, i, place, workspace.bodies[body], evaluation, dt)
                    : evaluate_point(law, i, place, evaluation, dt);
  if (surfaces_act_) {
    const Vector3d moment = add_surface_forces(i, place, workspace, reaction);
    if (accepted) points_[i].moment = moment;
  }
  if (reaction.next.attached) {
    dts::add_external_force(workspace, body, reaction.force, place.touching.position);
    ground_forces_[body] += reaction.force;
  }
  put_bristle(reaction.bristle_rate, i, bristle_rates_);
  if (accepted) store(i, reaction);
}

template <class Law>
ContactSet::Place ContactSet::place_of(const Law& law, const ContactPoint& point,
                                       const dts::BodyMotion<double>& body,
                                       Evaluation evaluation) const {
  Place place(point, body, *ground_);
  const contact::TilePoint& tile = place.touching.tile;
  const double reach = law.reach(constants(point, tile.material));
  place.inside = evaluation == Evaluation::accepted ? tile.depth > -reach : point.inside;
  place.depth = adaptive_ ? depth_on_side(place.inside, tile.depth, reach) : tile.depth;
  place.reached = place.depth > -reach;
  return place;
}

template <class Law>
contact::Reaction<double> ContactSet::evaluate_point(const Law& law, std::size_t i,
                                                     const Place& place, Evaluation evaluation,
                                                     double dt) const {
  if (adaptive_) dt = contact::differential_equation;
  const contact::TilePoint& tile = place.touching.tile;
  const auto& material = constants(points_[i], tile.material);
  const contact::Memory<double> memory = points_[i].carried(place.frame);
  contact::PointKinematics<double> kinematics{place.touching.position, place.touching.velocity,
                                              tile.normal, place.depth, bristle_at(bristles_, i)};
  if (evaluation == Evaluation::accepted)
    kinematics = contact::held_point(law, kinematics, memory, material, dt);
  return new_velocity_ ? contact::reaction_with_moved_bristle(law, kinematics, memory, material, dt)
                       : law.evaluate(kinematics, memory, material, dt);
}

template <class Law>
contact::Reaction<double> ContactSet::evaluate_directed(const Law& law, std::size_t i,
                                                        const Place& place,
                                                        const dts::BodyMotion<double>& body,
                                                        Evaluation evaluation, double dt) const {
  const auto& material = constants(points_[i], place.touching.tile.material);
  if (!contact::differs_with_direction(material))
    return evaluate_point(law, i, place, evaluation, dt);
  if (adaptive_) dt = contact::differential_equation;
  const contact::TilePoint& tile = place.touching.tile;
  return contact::directed_reaction(
      {place.touching.position, place.touching.velocity, tile.normal, place.depth,
       bristle_at(bristles_, i)},
      points_[i].carried(place.frame), {x_axis(body), tile.normal, material},
      [&](contact::PointKinematics<double> point, const contact::Memory<double>& memory,
          const contact::MaterialConstants<double>& constants) {
        if (evaluation == Evaluation::accepted)
          point = contact::held_point(law, point, memory, constants, dt);
        return new_velocity_
                   ? contact::reaction_with_moved_bristle(law, point, memory, constants, dt)
                   : law.evaluate(point, memory, constants, dt);
      });
}

Vector3d ContactSet::add_surface_forces(std::size_t i, const Place& place,
                                        dts::Workspace<double>& workspace,
                                        contact::Reaction<double>& reaction) const {
  if (!reaction.next.attached) return {};
  const ContactPoint& point = points_[i];
  const dts::BodyMotion<double>& body = workspace.bodies[point.body];
  const contact::TilePoint& tile = place.touching.tile;
  const contact::SurfaceForces forces =
      contact::surface_forces(reaction.force, tile.normal, {x_axis(body), body.w_WB, point.radius},
                              constants(point, tile.material));
  reaction.force += forces.force;
  dts::add_external_torque(workspace, point.body, forces.moment);
  return forces.moment;
}

void ContactSet::store(std::size_t i, const Place& place) {
  ContactPoint& point = points_[i];
  const contact::TilePoint& tile = place.touching.tile;
  if (tile.outside && notice_.empty())
    notice_ =
        experiment_->robots[index_].name + ": " + ground_->outside_message(place.touching.position);
  point.inside = place.inside;
  if (point.radius > 0.) point.pending_frame = place.frame;
  point.position = place.touching.position;
  point.normal = tile.normal;
  point.depth = tile.depth;
  point.material = tile.material;
}

void ContactSet::store(std::size_t i, const contact::Reaction<double>& reaction) {
  put_bristle(reaction.bristle, i, next_bristles_);
  points_[i].pending = reaction.next;
  points_[i].force = reaction.force;
}

// Beyond its reach the law gives and remembers nothing.
void ContactSet::leave_alone(std::size_t i, Evaluation evaluation) {
  put_bristle({}, i, bristle_rates_);
  if (evaluation == Evaluation::trial) return;
  put_bristle({}, i, next_bristles_);
  points_[i].pending = {};
  points_[i].force = {};
}

void ContactSet::apply_forces_again(dts::Workspace<double>& workspace) const {
  for (const ContactPoint& point : points_) {
    if (point.pending.attached)
      dts::add_external_force(workspace, point.body, point.force, point.position);
    if (point.pending.attached && surfaces_act_)
      dts::add_external_torque(workspace, point.body, point.moment);
  }
}

void ContactSet::apply_nothing() { std::ranges::fill(bristle_rates_, 0.); }

// Memory.

void ContactSet::commit() {
  for (std::size_t body = 0; body < body_count(); ++body) {
    if (!culling_.commits(body)) continue;
    for (std::size_t i = first_points_[body]; i < first_points_[body + 1]; ++i) {
      ContactPoint& point = points_[i];
      point.before = point.committed;
      if (point.radius > 0.) point.before_frame = point.committed_frame;
      point.commit();
    }
  }
}

void ContactSet::undo() {
  for (ContactPoint& point : points_) {
    point.committed = point.before;
    point.committed_frame = point.before_frame;
  }
  forget_culling();
}

void ContactSet::commit_within_step() {
  for (ContactPoint& point : points_) point.commit();
}

std::span<const ContactPoint> ContactSet::points_of(std::size_t body) const {
  return std::span(points_).subspan(first_points_[body],
                                    first_points_[body + 1] - first_points_[body]);
}

// Bristles, and points with events, continue in the air.
void ContactSet::begin_culling() {
  if (points_.empty() || adaptive_ || bristle_states_ > 0) return;
  double reach = 0.;
  materials_.for_each([&](const contact::MaterialConstants<double>& constants) {
    reach = std::max(reach, law_->reach(constants));
  });
  for (std::size_t body = 0; body < body_count(); ++body) {
    if (may_be_culled(*experiment_, index_, body, points_of(body)))
      culling_.allow(body, points_of(body), reach);
  }
}

// Bristles.

contact::Bristle<double> ContactSet::bristle_at(std::span<const double> numbers,
                                                std::size_t point) const {
  if (bristle_states_ == 0) return {};
  const double* z = &numbers[bristle_states_ * point];
  return {{z[0], z[1], z[2]}, bristle_states_ > 3 ? z[3] : 0.};
}

void ContactSet::put_bristle(const contact::Bristle<double>& bristle, std::size_t point,
                             std::span<double> numbers) const {
  if (bristle_states_ == 0) return;
  double* z = &numbers[bristle_states_ * point];
  z[0] = bristle.deflection.x;
  z[1] = bristle.deflection.y;
  z[2] = bristle.deflection.z;
  if (bristle_states_ > 3) z[3] = bristle.sliding;
}

// Impulses.

void ContactSet::add_impulses(double weight) {
  for (std::size_t body = 0; body < ground_forces_.size(); ++body)
    ground_impulses_[body] += weight * ground_forces_[body];
}

// Events.

void ContactSet::event_values(const dts::Workspace<double>& workspace,
                              std::span<double> values) const {
  auto value = values.begin();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ContactPoint& point = points_[i];
    const ContactKinematics touching =
        contact_kinematics(point, workspace.bodies[point.body], *ground_);
    const auto& material = constants(point, touching.tile.material);
    const double reach = law_->reach(material);
    *value++ = point.side_event(touching.tile.depth, reach);
    const contact::PointKinematics<double> kinematics{
        touching.position, touching.velocity, touching.tile.normal,
        depth_on_side(point.inside, touching.tile.depth, reach), bristle_at(bristles_, i)};
    *value++ = point.committed.attached
                   ? law_->switching_value(kinematics, point.committed, material)
                   : 1.;
  }
}

void ContactSet::cross_events(std::span<const int> directions) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    ContactPoint& point = points_[i];
    const int direction = directions[2 * i + 1];
    if (direction == 0 || !point.committed.attached) continue;
    const auto& material = constants(point, point.material);
    point.committed.sliding = law_->slides_after(direction < 0, point.committed, material);
  }
}

}  // namespace hookpoint::simulation
