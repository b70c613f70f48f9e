#include "control/components/legged_gait.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hookpoint::control {

namespace {

Vector3d vector_of(const State& state, std::size_t leg) {
  return {state.get(3 * leg), state.get(3 * leg + 1), state.get(3 * leg + 2)};
}

void put(State& state, std::size_t leg, const Vector3d& v) {
  state.set(3 * leg, v.x);
  state.set(3 * leg + 1, v.y);
  state.set(3 * leg + 2, v.z);
}

}  // namespace

void LeggedGait::start(double) {
  legs_ = legs_at_start();
  if (joints != 2. && joints != 3.) throw std::runtime_error("joints is neither 2 nor 3");
  is_mammal_ = leg.value() == "mammal";
  kind_ = joints == 2. ? LegKind::planar : is_mammal_ ? LegKind::mammal : LegKind::insect;
  for (std::size_t leg = 0; leg < legs(); ++leg) {
    feet_[leg] = {.position = neutral(leg), .origin = {}, .origin_velocity = {}};
    if (!solve(leg).reachable) {
      const std::string i = "[" + std::to_string(leg) + "]";
      throw std::runtime_error("the neutral foot position foot_x" + i + ", foot_y" + i +
                               " is out of reach of the hip at hip_x" + i + ", hip_y" + i +
                               "; check these, body_height and the leg's lengths");
    }
  }
  followed_forward = followed_sideways = followed_turn = 0.;
  elapsed = 0.;
  begin();
  save_feet();
  write_outputs();
}

void LeggedGait::update(const Tick& tick) {
  const double dt = tick.count == 0 ? 0. : tick.period;
  elapsed = elapsed + dt;
  load_feet();
  if (const double walked = std::min(dt, elapsed - stand); walked > 0.) step(walked);
  save_feet();
  write_outputs();
}

void LeggedGait::load_feet() {
  for (std::size_t leg = 0; leg < legs(); ++leg) {
    feet_[leg] = {vector_of(foot_position, leg), vector_of(lift_off_position, leg),
                  vector_of(lift_off_velocity, leg), swing_progress.get(leg)};
  }
}

void LeggedGait::save_feet() {
  for (std::size_t leg = 0; leg < legs(); ++leg) {
    put(foot_position, leg, feet_[leg].position);
    put(lift_off_position, leg, feet_[leg].origin);
    put(lift_off_velocity, leg, feet_[leg].origin_velocity);
    swing_progress.set(leg, feet_[leg].progress);
  }
}

PlanarTwist LeggedGait::follow_command(double dt) {
  const double share = command_lag > 0. ? -std::expm1(-dt / command_lag) : 1.;
  followed_forward = followed_forward + share * (forward - followed_forward);
  followed_sideways = followed_sideways + share * (sideways - followed_sideways);
  followed_turn = followed_turn + share * (turn - followed_turn);
  return {followed_forward, followed_sideways, followed_turn};
}

GroundSearch LeggedGait::search(std::size_t leg) const {
  return {contact.driven(leg), contact[leg] > 0., search_depth, search_speed};
}

bool LeggedGait::meets_ground(std::size_t leg) const {
  return contact.driven(leg) && contact[leg] > 0. && feet_[leg].progress > 0.5;
}

Leg LeggedGait::leg_of(std::size_t leg) const {
  // A mammal's shank angle is positive where the knee is forward.
  const bool up = is_mammal_ ? knee_forward[leg] <= 0.5 : knee_up > 0.5;
  return {kind_,
          {coxa_length[leg], femur_length[leg], tibia_length[leg]},
          hip_offset[leg],
          up ? Knee::up : Knee::down};
}

LegGoal LeggedGait::solve(std::size_t leg) const {
  const Vector3d& foot = feet_[leg].position;
  const double x = foot.x - hip_x[leg], y = foot.y - hip_y[leg];
  const double cosine = std::cos(hip_heading[leg]), sine = std::sin(hip_heading[leg]);
  const double ahead = cosine * x + sine * y, left = cosine * y - sine * x;
  const double up = foot.z - body_height - height_offset[leg];
  // A mammal's hip has x down, and z forward, or backwards of a planar leg.
  Vector3d p_HF{ahead, left, up};
  if (is_mammal_ && kind_ == LegKind::planar) p_HF = {-up, -left, -ahead};
  if (is_mammal_ && kind_ != LegKind::planar) p_HF = {-up, left, ahead};
  return joint_angles(leg_of(leg), p_HF);
}

void LeggedGait::write_outputs() {
  int out_of_reach = 0;
  for (std::size_t leg = 0; leg < legs(); ++leg) {
    const LegGoal solution = solve(leg);
    for (std::size_t joint = 0; joint < leg_joints; ++joint)
      goal.set(leg_joints * leg + joint, solution.angles[joint]);
    phase.set(leg, phase_of(leg));
    stance.set(leg, feet_[leg].swinging() ? 0. : 1.);
    out_of_reach += solution.reachable ? 0 : 1;
  }
  unreachable = out_of_reach;
}

}  // namespace hookpoint::control
