#include "simulation/dts_engine/group_part.h"

#include <fmt/format.h>

#include <algorithm>

#include "simulation/dts_engine/methods.h"
#include "simulation/dts_engine/publish.h"
#include "simulation/dts_engine/step.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

PointState place_state(const ShapeContacts::Place& place) {
  return {place.at.place, place.force, place.memory.attached ? place.memory.hook : place.at.place,
          place.at.depth, place.memory.sliding ? 1. : 0.};
}

}  // namespace

GroupPart::GroupPart(const Experiment& experiment, const contact::Terrain* ground,
                     const WorldInputs& inputs)
    : experiment_(experiment),
      group_(experiment, ground, inputs),
      stepper_(stepper_within_budget(experiment, "the robots", group_)) {
  for (const ArticulatedRobot& robot : group_.robots()) {
    body_count_ += robot.model().body_count();
    joint_count_ += robot.model().link_count();
    reactions_.emplace_back(robot);
  }
  sums_.resize(body_count_);
}

template <class Visit>
void GroupPart::for_each_robot(const Visit& visit) const {
  std::size_t first_body = 0, first_joint = 0;
  for (const ArticulatedRobot& robot : group_.robots()) {
    visit(robot, first_body, first_joint);
    first_body += robot.model().body_count();
    first_joint += robot.model().link_count();
  }
}

const std::string& GroupPart::notice() const {
  for (const ArticulatedRobot& robot : group_.robots())
    if (!robot.constraints().notice().empty()) return robot.constraints().notice();
  return group_.contacts().notice();
}

void GroupPart::forget_notice() {
  for (ArticulatedRobot& robot : group_.robots()) robot.constraints().forget_notice();
  group_.contacts().forget_notice();
}

StepStatus GroupPart::step(double time) {
  stepper_->save(stepper_before_);
  const StepStatus status = simulation::step(group_, *stepper_, time);
  if (!status.ok()) stepper_->restore(stepper_before_);
  return status;
}

void GroupPart::undo() {
  group_.undo();
  stepper_->restore(stepper_before_);
}

void GroupPart::publish(std::span<BodyState> bodies, std::span<JointState> joints) const {
  for_each_robot(
      [&](const ArticulatedRobot& robot, std::size_t first_body, std::size_t first_joint) {
        publish_motion(robot, bodies.subspan(first_body, robot.model().body_count()));
        publish_joints(robot, joints.subspan(first_joint, robot.model().link_count()));
        const std::span<const Vector3d> impulses = group_.contacts().impulses(robot.index());
        for (std::size_t i = 0; i < impulses.size(); ++i)
          bodies[first_body + i].contact_force = (1. / group_.dt()) * impulses[i];
      });
  for (const ShapeContacts::Place& place : group_.contacts().places()) {
    if (!(dot(place.force, place.at.normal) > 0.)) continue;
    for (const std::int64_t object : {place.at.key.a, place.at.key.b}) {
      if (const auto body = group_.contacts().body_of(static_cast<std::size_t>(object)))
        ++bodies[*body].contacts;
    }
  }
}

void GroupPart::add_contacts(std::size_t first_body, std::span<const BodyState> /*bodies*/,
                             std::vector<ContactView>& contacts) const {
  for (const ShapeContacts::Place& place : group_.contacts().places()) {
    if (!(place.at.depth > 0. || dot(place.force, place.force) > 0.)) continue;
    const auto a = group_.contacts().body_of(static_cast<std::size_t>(place.at.key.a));
    const auto b = group_.contacts().body_of(static_cast<std::size_t>(place.at.key.b));
    const PointState shown = place_state(place);
    contacts.push_back({first_body + (a ? *a : *b), shown.position, a ? shown.force : -shown.force,
                        shown.hook, shown.depth, shown.sliding});
  }
}

void GroupPart::add_ground_forces(std::size_t first_body, std::vector<GroundForce>& forces) const {
  for (const ShapeContacts::Place& place : group_.contacts().places()) {
    if (dot(place.force, place.force) == 0.) continue;
    const auto add = [&](std::int64_t object, const Vector3d& force) {
      const ShapeObject& of = group_.contacts().objects()[static_cast<std::size_t>(object)];
      if (of.kind != ShapeObject::Kind::body) return;
      const dts::BodyMotion<double>& body = group_.robots()[of.index].workspace().bodies[of.body];
      forces.push_back({first_body + *group_.contacts().body_of(static_cast<std::size_t>(object)),
                        transpose_times(body.R_WB, place.at.place - body.p_WB), force});
    };
    add(place.at.key.a, place.force);
    add(place.at.key.b, -place.force);
  }
}

// A boundary point that touches several surfaces shows their force together, and the deepest of them.
PointState GroupPart::point_state(std::size_t robot, std::size_t body, std::size_t point) const {
  const BodySpec& spec = *bodies_of(experiment_.robots[robot])[body];
  const dts::BodyMotion<double>& motion = group_.robots()[robot].workspace().bodies[body];
  PointState state;
  state.position = state.hook = motion.p_WB + motion.R_WB * spec.boundary_points[point];
  double deepest = 0.;
  ContactSum sum;
  for (const ShapeContacts::Place& place : group_.contacts().places()) {
    const ShapeObject& of = group_.contacts().objects()[static_cast<std::size_t>(place.at.key.a)];
    if (of.kind != ShapeObject::Kind::body || of.index != robot || of.body != body ||
        group_.contacts().boundary_point(place.at.key) != point)
      continue;
    sum.add(place.at.place, place.at.normal, place.force, place.moment);
    if (place.at.depth > deepest) {
      deepest = place.at.depth;
      state = place_state(place);
    }
  }
  state.force = sum.force();
  const BodyContact loads = sum.about(state.position);
  state.normal_load = loads.normal_load;
  state.tangential_load = loads.tangential_load;
  return state;
}

double GroupPart::ground_energy() const { return group_.contacts().stored_energy(); }

void GroupPart::add_surface_contacts(std::span<SurfaceSum> surfaces) const {
  const ShapeContacts& contacts = group_.contacts();
  for (const ShapeContacts::Place& place : contacts.places()) {
    if (!place.memory.attached) continue;
    const auto add = [&](std::int64_t object, double sign) {
      if (const auto surface = contacts.surface_of(static_cast<std::size_t>(object)))
        surfaces[*surface].contacts.add(place.at.place, sign * place.at.normal, sign * place.force,
                                        sign * place.moment);
    };
    add(place.at.key.a, 1.);
    add(place.at.key.b, -1.);
  }
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    surfaces[i].mean_force -= (1. / group_.dt()) * contacts.surface_impulses()[i];
}

void GroupPart::publish_body_contacts(std::span<BodyContact> bodies) const {
  std::ranges::fill(sums_, ContactSum{});
  for (const ShapeContacts::Place& place : group_.contacts().places()) {
    if (!place.memory.attached) continue;
    const auto add = [&](std::int64_t object, double sign) {
      if (const auto body = group_.contacts().body_of(static_cast<std::size_t>(object)))
        sums_[*body].add(place.at.place, sign * place.at.normal, sign * place.force,
                         sign * place.moment);
    };
    add(place.at.key.a, 1.);
    add(place.at.key.b, -1.);
  }
  for_each_robot([&](const ArticulatedRobot& robot, std::size_t first_body, std::size_t) {
    for (std::size_t i = 0; i < robot.model().body_count(); ++i)
      bodies[first_body + i] = sums_[first_body + i].about(robot.workspace().bodies[i].p_WB);
  });
}

void GroupPart::publish_reactions(std::span<JointReaction> joints) {
  for_each_robot([&](const ArticulatedRobot& robot, std::size_t, std::size_t first_joint) {
    reactions_[robot.index()].publish(joints.subspan(first_joint, robot.model().link_count()));
  });
}

void GroupPart::publish_hips(std::span<ChainState> chains) const {
  std::size_t first = 0;
  for (std::size_t i = 0; i < group_.robots().size(); ++i) {
    const std::size_t count = experiment_.robots[i].chains.size();
    simulation::publish_hips(group_.robots()[i], chains.subspan(first, count));
    first += count;
  }
}

IntegratorState GroupPart::statistics() const {
  const integrators::Statistics& counted = stepper_->statistics();
  return {counted.steps, counted.rejected, counted.evaluations, counted.jacobians, counted.events};
}

std::size_t GroupPart::state_size() const {
  return count_of(group_) + joint_count_ + stepper_->state_size();
}

std::string GroupPart::state_layout() const {
  return fmt::format("{} quaternion_sign[{}] {}[{}]", layout_of(group_), joint_count_,
                     experiment_.integrator, stepper_->state_size());
}

void GroupPart::save(std::span<double> numbers, std::span<const BodyState> bodies) const {
  save_to(numbers, group_);
  const std::span<double> signs = numbers.subspan(count_of(group_), joint_count_);
  for_each_robot(
      [&](const ArticulatedRobot& robot, std::size_t first_body, std::size_t first_joint) {
        save_signs(robot, bodies.subspan(first_body, robot.model().body_count()),
                   signs.subspan(first_joint, robot.model().link_count()));
      });
  stepper_->save(numbers.last(stepper_->state_size()));
}

void GroupPart::restore(std::span<const double> numbers, std::span<BodyState> bodies) {
  restore_from(numbers, group_);
  group_.restored();
  const std::span<const double> signs = numbers.subspan(count_of(group_), joint_count_);
  for_each_robot(
      [&](const ArticulatedRobot& robot, std::size_t first_body, std::size_t first_joint) {
        restore_signs(robot, signs.subspan(first_joint, robot.model().link_count()),
                      bodies.subspan(first_body, robot.model().body_count()));
      });
  stepper_->restore(numbers.last(stepper_->state_size()));
}

}  // namespace hookpoint::simulation
