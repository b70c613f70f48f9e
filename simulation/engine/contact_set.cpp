#include "simulation/engine/contact_set.h"

#include <cmath>
#include <limits>

#include "contact/bristle_step.h"
#include "dts/external_forces.h"

namespace hookpoint::simulation {
namespace {

constexpr double rounding = 1e-9;      // [m], of a box's depth
constexpr int commits_remembered = 2;  // `committed` and `before`

/// The experiment's law; for an integrator that chooses its own steps as a differential equation.
/// Without a ground none is asked.
contact::AnyForceLaw law_of(const Experiment& experiment, bool has_ground, bool adaptive) {
  if (!has_ground) return {};
  const auto law = contact::find_force_law(experiment.contact);
  if (!law) throw ExperimentError("there is no contact law `" + experiment.contact + "`");
  return adaptive ? contact::rate_form(*law) : *law;
}

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
      law_(law_of(experiment, ground != nullptr, adaptive_)),
      bristle_states_(contact::bristle_states(law_)),
      points_(ground ? contact_points(experiment.robots[index]) : std::vector<ContactPoint>{}),
      ground_forces_(bodies),
      ground_impulses_(bodies),
      culled_(bodies) {
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (points_[i].radius > 0.) balls_.push_back(i);
  for (std::size_t body = 0; body <= bodies; ++body) {
    const auto first = std::ranges::lower_bound(points_, body, {}, &ContactPoint::body);
    first_points_.push_back(static_cast<std::size_t>(first - points_.begin()));
  }
  for (std::vector<double>* bristles : {&bristles_, &next_bristles_, &bristle_rates_})
    bristles->resize(bristle_states_ * points_.size());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  boxes_.resize(bodies, {{}, {infinity, infinity, infinity}});
  stretch(experiment.robots[index].start_stretch);
}

void ContactSet::stretch(std::span<const Vector3d> start) {
  const RobotSpec& robot = experiment_->robots[index_];
  const dts::BodyMotion<double> base{rotation_matrix(robot.orientation), robot.location, {}, {}};
  for (std::size_t i = 0; i < std::min(start.size(), points_.size()); ++i) {
    if (start[i] == Vector3d{}) continue;
    ContactPoint& point = points_[i];
    const ContactKinematics touching = contact_kinematics(point, base, *ground_);
    const Vector3d surface = touching.position + touching.tile.depth * touching.tile.normal;
    point.committed = {surface - start[i], start[i], true, false};
    point.committed_frame = ball_frame(point, base, touching.tile);
    put_bristle({start[i]}, i, bristles_);
  }
}

// Forces.

void ContactSet::apply_forces(dts::Workspace<double>& workspace, Evaluation evaluation) {
  if (points_.empty()) return;
  std::visit(
      [&](const auto& law) {
        for (std::size_t body = 0; body < culled_.size(); ++body) {
          ground_forces_[body] = {};
          if (is_culled(body, workspace, evaluation)) continue;
          for (std::size_t i = first_points_[body]; i < first_points_[body + 1]; ++i)
            apply_force(law, i, workspace, evaluation);
        }
      },
      law_);
}

template <class Law>
void ContactSet::apply_force(const Law& law, std::size_t i, dts::Workspace<double>& workspace,
                             Evaluation evaluation) {
  const bool trial = evaluation == Evaluation::trial;
  // An integrator that chooses its steps gets laws that know none (contact::rate_form).
  const double dt = adaptive_ ? 0. : experiment_->deltat;
  ContactPoint& point = points_[i];
  const dts::BodyMotion<double>& body = workspace.bodies[point.body];
  const ContactKinematics touching = contact_kinematics(point, body, *ground_);
  const contact::TilePoint& tile = touching.tile;
  const Vector3d& position = touching.position;
  const auto& material = experiment_->materials[tile.material].constants;
  const double reach = law.reach(material);
  if (!trial) point.inside = tile.depth > -reach;
  const double depth = adaptive_ ? point.depth_on_side(tile.depth, reach) : tile.depth;
  const contact::BallFrame frame = ball_frame(point, body, tile);
  if (!trial) {
    if (tile.outside && notice_.empty())
      notice_ = experiment_->robots[index_].name + ": " + ground_->outside_message(position);
    if (point.radius > 0.) point.pending_frame = frame;
    point.position = position;
    point.normal = tile.normal;
    point.depth = tile.depth;
    point.material = tile.material;
  }
  if (!(depth > -reach)) {
    leave_alone(i, evaluation);
    return;
  }
  contact::PointKinematics<double> kinematics{position, touching.velocity, tile.normal, depth,
                                              bristle_at(bristles_, i)};
  const contact::Memory<double> memory = point.carried(frame);
  if (!trial) kinematics = contact::held_point(law, kinematics, memory, material, dt);
  const contact::Reaction<double> reaction =
      new_velocity_ ? contact::reaction_with_moved_bristle(law, kinematics, memory, material, dt)
                    : law.evaluate(kinematics, memory, material, dt);
  if (reaction.next.attached) {
    dts::add_external_force(workspace, point.body, reaction.force, position);
    ground_forces_[point.body] += reaction.force;
  }
  put_bristle(reaction.bristle_rate, i, bristle_rates_);
  if (trial) return;
  put_bristle(reaction.bristle, i, next_bristles_);
  point.pending = reaction.next;
  point.force = reaction.force;
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
  }
}

void ContactSet::apply_nothing() { std::ranges::fill(bristle_rates_, 0.); }

// Memory.

// Where a body has been culled for as many steps as are remembered, all memories are the same.
void ContactSet::commit() {
  for (std::size_t body = 0; body < culled_.size(); ++body) {
    if (culled_[body] > commits_remembered) continue;
    if (culled_[body] > 0) ++culled_[body];
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

// Culling: bodies too far above the ground for any of their boundary points to feel it are passed
// over, and nothing that is published differs but by the time that it takes.

std::span<const ContactPoint> ContactSet::points_of(std::size_t body) const {
  return std::span(points_).subspan(first_points_[body],
                                    first_points_[body + 1] - first_points_[body]);
}

ContactSet::PointsBox ContactSet::box_about(std::span<const ContactPoint> points) {
  Vector3d low = points.front().p_BP, high = low;
  for (const ContactPoint& point : points) {
    const Vector3d& p = point.p_BP;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {0.5 * (low + high), 0.5 * (high - low)};
}

// Not of events, bristles and balls, which go on in the air, nor of points that are published.
void ContactSet::begin_culling() {
  if (adaptive_ || bristle_states_ > 0) return;
  for (const MaterialSpec& material : experiment_->materials) {
    const auto reach = [&](const auto& law) { return double(law.reach(material.constants)); };
    reach_ = std::max(reach_, std::visit(reach, law_));
  }
  for (std::size_t body = 0; body < boxes_.size(); ++body) {
    const auto published = [&](const PointSpec& point) {
      return point.robot == static_cast<int>(index_) &&
             static_cast<std::size_t>(point.body) == body;
    };
    const auto is_ball = [](const ContactPoint& point) { return point.radius > 0.; };
    if (points_of(body).empty() || std::ranges::any_of(points_of(body), is_ball) ||
        std::ranges::any_of(experiment_->points, published))
      continue;
    boxes_[body] = box_about(points_of(body));
  }
}

bool ContactSet::is_culled(std::size_t body, const dts::Workspace<double>& workspace,
                           Evaluation evaluation) {
  const PointsBox& box = boxes_[body];
  const dts::BodyMotion<double>& motion = workspace.bodies[body];
  const bool above =
      std::isfinite(box.half.x) && ground_->deepest(motion.p_WB + motion.R_WB * box.center,
                                                    motion.R_WB, box.half) < -reach_ - rounding;
  if (evaluation == Evaluation::trial) return above;
  if (above && culled_[body] == 0) {
    for (std::size_t i = first_points_[body]; i < first_points_[body + 1]; ++i) {
      points_[i].pending = {};
      points_[i].force = {};
      points_[i].inside = false;
    }
  }
  culled_[body] = above ? std::max(culled_[body], 1) : 0;
  return above;
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
    const auto& material = experiment_->materials[touching.tile.material].constants;
    const double reach = contact::reach(law_, material);
    *value++ = point.side_event(touching.tile.depth, reach);
    const contact::PointKinematics<double> kinematics{
        touching.position, touching.velocity, touching.tile.normal,
        point.depth_on_side(touching.tile.depth, reach), bristle_at(bristles_, i)};
    *value++ = point.committed.attached
                   ? contact::switching_value(law_, kinematics, point.committed, material)
                   : 1.;
  }
}

void ContactSet::cross_events(std::span<const int> directions) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    ContactPoint& point = points_[i];
    const int direction = directions[2 * i + 1];
    if (direction == 0 || !point.committed.attached) continue;
    const auto& material = experiment_->materials[point.material].constants;
    point.committed.sliding = contact::slides_after(law_, direction < 0, point.committed, material);
  }
}

// What is published.

void ContactSet::publish(double step, std::span<BodyState> bodies) const {
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    bodies[body].contact_force = (1. / step) * ground_impulses_[body];
    bodies[body].contacts = 0;
    if (culled_[body] > 0) continue;
    for (const ContactPoint& point : points_of(body)) {
      if (dot(point.force, point.normal) > 0.) ++bodies[body].contacts;
    }
  }
}

PointState ContactSet::point_state(std::size_t body, std::size_t point) const {
  // The points of a fixed base, and all where there is no ground, are left out.
  if (point >= points_of(body).size()) return {};
  const ContactPoint& found = points_of(body)[point];
  const contact::Memory<double>& memory = found.pending;
  return {found.position, found.force, memory.attached ? memory.hook : found.position, found.depth,
          memory.sliding ? 1. : 0.};
}

void ContactSet::add_ground_forces(const dts::Workspace<double>& workspace, std::size_t first_body,
                                   std::vector<GroundForce>& forces) const {
  for (const ContactPoint& point : points_) {
    if (culled_[point.body] > 0 || dot(point.force, point.force) == 0.) continue;
    const dts::BodyMotion<double>& body = workspace.bodies[point.body];
    forces.push_back({first_body + point.body,
                      transpose_times(body.R_WB, point.position - body.p_WB), point.force});
  }
}

void ContactSet::add_contacts(std::size_t first_body, std::vector<ContactView>& contacts) const {
  for (const ContactPoint& point : points_) {
    const bool touches = point.depth > 0. || dot(point.force, point.force) > 0.;
    if (culled_[point.body] > 0 || !touches) continue;
    const contact::Memory<double>& memory = point.pending;
    contacts.push_back({first_body + point.body, point.position, point.force,
                        memory.attached ? memory.hook : point.position, point.depth,
                        memory.sliding ? 1. : 0.});
  }
}

double ContactSet::stored_energy() const {
  double sum = 0.;
  for (const ContactPoint& point : points_) {
    if (!point.pending.attached) continue;
    const auto& material = experiment_->materials[static_cast<std::size_t>(point.material)];
    sum += contact::stored_energy(law_, point.depth, point.pending.stretch, material.constants);
  }
  return sum;
}

}  // namespace hookpoint::simulation
