// What couples joints, drives them and says where they start.
#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "simulation/scene/mjcf/reader.h"
#include "simulation/scene/urdf/joint_rules.h"

namespace hookpoint::simulation {

void MjcfReader::read_couplings() {
  for (const XmlElement& element : document_.in_sections("equality"))
    if (element.tag() == "joint") read_coupling(element);
}

// q1 - ref1 = c0 + c1 (q2 - ref2) + ...; joints stand at their references so far.
void MjcfReader::read_coupling(const XmlElement& element) {
  const MjcfAttributes given(element, {});
  const auto find = [&](const char* attribute) -> const MjcfJointAddress* {
    const auto found = joints_.find(given.word(attribute));
    if (found != joints_.end() && !found->second.is_free) return &found->second;
    given.fail(attribute, fmt::format("there is no joint `{}` to couple", given.word(attribute)));
    return nullptr;
  };
  const MjcfJointAddress* const follower_at = find("joint1");
  const MjcfJointAddress* const leader_at = given.has("joint2") ? find("joint2") : nullptr;
  if (follower_at == nullptr || (given.has("joint2") && leader_at == nullptr)) return;
  if (choices_.mimic == UrdfMimic::ignore) return leave_out("<joint> of <equality>");
  if (given.word("active") == "false") return leave_out("equality that is not active");
  const std::vector<double> c = given.numbers("polycoef", {0., 1., 0., 0., 0.});
  if (c[2] != 0. || c[3] != 0. || c[4] != 0.)
    return leave_out("<joint> of <equality> that is not linear");
  UrdfJoint& follower = joint_at(*follower_at);
  const double at = follower.angle.value_or(0.) + c[0];
  if (choices_.mimic == UrdfMimic::fixed || leader_at == nullptr) return fix_joint(at, follower);
  const UrdfJoint& leader = joint_at(*leader_at);
  if (follower_at->robot != leader_at->robot) {
    given.fail(
        "joint2",
        fmt::format("joint `{}` cannot follow `{}`, which is of another robot: joints of one "
                    "robot are coupled (mimic = ignore leaves couplings out)",
                    follower.name, leader.name));
    return;
  }
  follower.follows = {leader.name, c[1], at - c[1] * leader.angle.value_or(0.), element.place()};
}

// With I the joint's inertia, T the time constant and z the ratio: k = I / (T z)^2, c = 2 I / T.
void MjcfReader::settle_springs() {
  for (UrdfRobot& robot : scene_.robots) {
    inertias_.push_back(joint_inertias(robot));
    for (std::size_t k = 0; k < robot.joints.size(); ++k) {
      UrdfJoint& joint = robot.joints[k];
      const auto given = spring_dampers_.find(joint.name);
      if (given == spring_dampers_.end()) continue;
      const auto [time, ratio] = given->second;
      const double inertia = inertias_.back()[k].effective;
      joint.stiffness = inertia / (time * time * ratio * ratio);
      joint.damping = 2. * inertia / time;
    }
  }
}

void MjcfReader::read_actuators() {
  for (const XmlElement& element : document_.in_sections("actuator")) {
    const std::string_view tag = element.tag();
    MjcfDrive& drive = drives_.emplace_back();
    if (tag == "motor" || tag == "position" || tag == "velocity" || tag == "general") {
      drive = read_actuator(element);
    } else if (check_mjcf_child(element, "actuator")) {
      leave_out(fmt::format("<{}> of <actuator>", tag));
    }
  }
  limit_efforts();
}

MjcfDrive MjcfReader::read_actuator(const XmlElement& element) {
  const MjcfAttributes given = document_.attributes(element, "");
  leave_out_unread(given);
  const auto none = [&](const std::string& what) {
    leave_out(what);
    return MjcfDrive{};
  };
  const std::string name = given.word("joint");
  if (name.empty()) return none(fmt::format("<{}> of no joint", element.tag()));
  const auto found = joints_.find(name);
  if (found == joints_.end()) {
    given.fail("joint", fmt::format("there is no joint `{}`", name));
    return {};
  }
  const MjcfJointAddress& at = found->second;
  if (at.is_free) return none(fmt::format("<{}> of a free joint", element.tag()));
  MjcfDrive drive{at, read_mjcf_actuator(given)};
  MjcfActuator& actuator = drive.actuator;
  if (!actuator.is_linear)
    return none(fmt::format("<{}> whose gain or bias is of another type", element.tag()));
  if (!inertias_.empty()) actuator.settle_damping(inertias_[at.robot][at.joint].rigid);
  if (!actuator.is_motor() && !actuator.is_servo())
    return none(fmt::format("<{}> that is no servo", element.tag()));
  find_ctrl_range(given, drive);
  find_effort_limit(given, drive);
  if (actuator.is_servo()) add_servo(given, drive);
  return drive;
}

void MjcfReader::find_ctrl_range(const MjcfAttributes& given, MjcfDrive& drive) {
  drive.ctrl_range = document_.range(given, "ctrlrange", "ctrllimited");
  const double part = drive.actuator.inherited_range;
  if (!drive.actuator.holds_angle() || !(part > 0.)) return;
  const UrdfJoint& joint = joint_at(*drive.joint);
  if (drive.ctrl_range) {
    given.fail("inheritrange", "ctrlrange and inheritrange are given: one is allowed");
  } else if (!joint.lower_limit || !joint.upper_limit) {
    given.fail("inheritrange", fmt::format("joint `{}` has no range to inherit", joint.name));
  } else {
    const double middle = 0.5 * (*joint.lower_limit + *joint.upper_limit);
    const double half = 0.5 * part * (*joint.upper_limit - *joint.lower_limit);
    drive.ctrl_range = {middle - half, middle + half};
  }
}

/// The torque of a motor is bounded by its ctrl too.
void MjcfReader::find_effort_limit(const MjcfAttributes& given, MjcfDrive& drive) {
  const MjcfActuator& actuator = drive.actuator;
  const auto limit = [&](const std::array<double, 2>& ends, const char* range, double factor) {
    const double most =
        factor * greater_end(ends, fmt::format("{} of <{}>", range, given.own().tag()));
    if (!(most > 0.) || !std::isfinite(most)) return;
    if (drive.effort_limit && *drive.effort_limit <= most) return;
    drive.effort_limit = most;
    drive.limit_place = given.place(range);
  };
  if (const auto ends = document_.range(given, "forcerange", "forcelimited"))
    limit(*ends, "forcerange", std::abs(actuator.gear));
  if (actuator.is_motor() && drive.ctrl_range)
    limit(*drive.ctrl_range, "ctrlrange", std::abs(actuator.gear * actuator.gain));
}

/// Torques of a joint's actuators add up, and so do their limits; there is none unless each has one.
void MjcfReader::limit_efforts() {
  struct Sum {
    std::size_t drives = 0, limits = 0;
    double most = 0.;
    language::Position place;
  };
  std::map<UrdfJoint*, Sum> sums;
  for (const MjcfDrive& drive : drives_) {
    if (!drive.joint) continue;
    Sum& sum = sums[&joint_at(*drive.joint)];
    ++sum.drives;
    if (!drive.effort_limit) continue;
    ++sum.limits;
    sum.most += *drive.effort_limit;
    sum.place = drive.limit_place;
  }
  for (const auto& [joint, sum] : sums) {
    if (sum.drives > 1 && sum.limits > 0)
      leave_out("limits of several actuators of a joint, each by itself (their sum is limited)");
    if (sum.limits < sum.drives || (joint->effort_limit && *joint->effort_limit <= sum.most))
      continue;
    joint->effort_limit = sum.most;
    joint->effort_place = sum.place;
  }
}

/// Servos of one joint act together: gains and dampings add up.
void MjcfReader::add_servo(const MjcfAttributes& given, const MjcfDrive& drive) {
  const MjcfActuator& actuator = drive.actuator;
  UrdfJoint& joint = joint_at(*drive.joint);
  const double squared = actuator.gear * actuator.gear;
  double gain = 0. - squared * actuator.bias[1], damping = 0. - squared * actuator.bias[2];
  UrdfServo servo;
  servo.place = given.own().place();
  if (joint.servo) {
    servo.place = joint.servo->place;
    gain += joint.servo->of_rate ? 0. : joint.servo->gain;
    damping += joint.servo->of_rate ? joint.servo->gain : joint.servo->damping;
  }
  servo.of_rate = gain == 0.;
  servo.gain = servo.of_rate ? damping : gain;
  servo.damping = servo.of_rate ? 0. : damping;
  joint.servo = servo;
}

void MjcfReader::read_keyframe() {
  std::string known;
  for (const XmlElement& key : document_.in_sections("keyframe")) {
    if (!check_mjcf_child(key, "keyframe")) continue;
    check_mjcf_attributes(key);
    const std::string name = key.text("name");
    if (!choices_.keyframe.empty() && name == choices_.keyframe) return take_key(key);
    known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
  }
  if (choices_.keyframe.empty()) {
    if (!known.empty()) left_out_[fmt::format("keyframe ({}: the argument `keyframe`)", known)] = 1;
    return;
  }
  report_.error(choices_.keyframe_place,
                fmt::format("the file has no <key> `{}`; it has {}", choices_.keyframe,
                            known.empty() ? "none" : known));
}

void MjcfReader::take_key(const XmlElement& key) {
  std::size_t positions = 0, rates = 0;
  for (const MjcfJointAddress& at : addresses_) {
    positions += at.is_free ? 7 : 1;
    rates += at.is_free ? 6 : 1;
  }
  const auto numbers = [&](const char* attribute, std::size_t wanted) {
    const std::vector<double> given = key.file->numbers(key.node, attribute, wanted);
    if (!given.empty() && given.size() != wanted)
      key.file->fail(key.place(attribute), fmt::format("{} has {} numbers, and the file's joints "
                                                       "{}",
                                                       attribute, given.size(), wanted));
    return given.size() == wanted ? given : std::vector<double>{};
  };
  const std::vector<double> q = numbers("qpos", positions), v = numbers("qvel", rates);
  std::size_t next = 0, next_rate = 0;
  for (const MjcfJointAddress& at : addresses_) {
    UrdfRobot& robot = scene_.robots[at.robot];
    if (at.is_free) {
      UrdfStart& start = *robot.start;
      if (!q.empty()) {
        const Quaterniond turn{q[next + 3], q[next + 4], q[next + 5], q[next + 6]};
        if (turn == Quaterniond{0., 0., 0., 0.}) {
          key.file->fail(key.place("qpos"), "a quaternion of length 0 is no orientation");
          return;
        }
        start.pose = {{q[next], q[next + 1], q[next + 2]}, normalized(turn)};
      }
      if (!v.empty()) {
        start.velocity = {v[next_rate], v[next_rate + 1], v[next_rate + 2]};
        // MJCF has it in the body's axes.
        start.angular_velocity = rotate(
            start.pose.orientation, Vector3d{v[next_rate + 3], v[next_rate + 4], v[next_rate + 5]});
      }
    } else {
      UrdfJoint& joint = robot.joints[at.joint];
      if (!q.empty()) joint.angle = q[next];
      if (!v.empty()) joint.rate = v[next_rate];
    }
    next += at.is_free ? 7 : 1;
    next_rate += at.is_free ? 6 : 1;
  }
  take_ctrl(numbers("ctrl", drives_.size()));
}

// The torque gear gain u of a drive moves the goal of the joint's servo by as much over its gain.
void MjcfReader::take_ctrl(const std::vector<double>& ctrl) {
  for (std::size_t i = 0; i < ctrl.size(); ++i) {
    const MjcfDrive& drive = drives_[i];
    if (!drive.joint) continue;
    const MjcfActuator& actuator = drive.actuator;
    const auto& range = drive.ctrl_range;
    const double u = range ? std::clamp(ctrl[i], (*range)[0], (*range)[1]) : ctrl[i];
    std::optional<UrdfServo>& servo = joint_at(*drive.joint).servo;
    if (actuator.is_servo() && servo) {
      const double part = actuator.gear * actuator.gear * actuator.gain / servo->gain;
      servo->goal = servo->goal.value_or(0.) + part * (u / actuator.gear);
    } else if (u != 0.) {
      leave_out("ctrl of a motor in the <key>");
    }
  }
}

}  // namespace hookpoint::simulation
