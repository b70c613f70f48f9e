// What a robot of the DTS engine shows of itself after a step: copies, but for the orientations of
// its links, which go on without a jump.
#include "math/pack_structures.h"
#include "simulation/engine/dts_robot.h"

namespace hookpoint::simulation {

void DtsRobot::publish(std::span<BodyState> bodies, std::span<JointState> joints) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const dts::BodyMotion<double>& body = workspace_.bodies[i];
    bodies[i].position = body.p_WB;
    bodies[i].velocity = body.v_WB;
    bodies[i].angular_velocity = body.w_WB;
    bodies[i].contact_force = (1. / experiment_->deltat) * ground_impulses_[i];
    bodies[i].contacts = 0;
  }
  publish_orientations(bodies);
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (passed_[body] > 0) continue;
    for (std::size_t i = first_points_[body]; i < first_points_[body + 1]; ++i) {
      if (dot(points_[i].force, points_[i].normal) > 0.) ++bodies[body].contacts;
    }
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i] = {state_.joint_positions[i], state_.joint_rates[i],
                 workspace_.joint_accelerations[i], joint_torques_[i]};
  }
}

// The links of a group of chains side by side, as forward kinematics left them.
void DtsRobot::publish_orientations(std::span<BodyState> bodies) const {
  bodies[0].orientation = state_.base_orientation;
  for (const dts::ChainGroup<double>& group : model_.groups()) {
    for (std::size_t n = 0; n < group.link_count(); ++n) {
      const std::array<BodyState*, dts::lane_count> links = at_body(group, n, bodies);
      std::array<Quaterniond*, dts::lane_count> published;
      std::array<const Quaterniond*, dts::lane_count> last;
      for (std::size_t i = 0; i < links.size(); ++i)
        last[i] = published[i] = &links[i]->orientation;
      scatter(continued(quaternion_from(workspace_.links[group.first_pass + n].R_WB), gather(last)),
              published);
    }
  }
}

PointState DtsRobot::point_state(int body, int point) const {
  const auto at = static_cast<std::size_t>(body);
  const std::size_t index = first_points_[at] + static_cast<std::size_t>(point);
  // The points of a fixed base, and all where there is no ground, are left out.
  if (index >= first_points_[at + 1]) return {};
  const ContactPoint& found = points_[index];
  const contact::Memory<double>& memory = found.pending;
  return {found.position, found.force, memory.attached ? memory.hook : found.position, found.depth,
          memory.sliding ? 1. : 0.};
}

void DtsRobot::publish_hips(std::span<ChainState> chains) const {
  for (std::size_t i = 0; i < chains.size(); ++i)
    chains[i] = {workspace_.hip_wrenches[i].force, workspace_.hip_wrenches[i].moment};
}

}  // namespace hookpoint::simulation
