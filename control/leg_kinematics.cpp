#include "control/leg_kinematics.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::control {

Vector3d foot_position(const LegLengths& lengths, const LegAngles& angles) {
  const double shank = angles.femur + angles.tibia;
  const double reach =
      lengths.coxa + lengths.femur * std::cos(angles.femur) + lengths.tibia * std::cos(shank);
  return {reach * std::cos(angles.coxa), reach * std::sin(angles.coxa),
          lengths.femur * std::sin(angles.femur) + lengths.tibia * std::sin(shank)};
}

ShankAngles shank_angles(double femur, double tibia, double outwards, double up, Knee knee) {
  const double wanted = std::hypot(outwards, up);
  const double shortest = std::abs(femur - tibia);
  const double longest = femur + tibia;
  const double distance = std::clamp(wanted, shortest, longest);
  // Twice the product of the sides, times cosine and sine of the angle between femur and tibia's
  // extension.
  const double cosine = distance * distance - femur * femur - tibia * tibia;
  const double sine = std::sqrt((longest - distance) * (longest + distance) *
                                (distance - shortest) * (distance + shortest));
  ShankAngles angles{};
  angles.reachable = wanted == distance;
  angles.tibia = std::atan2(knee == Knee::up ? -sine : sine, cosine);
  angles.femur = std::atan2(up, outwards) -
                 std::atan2(tibia * std::sin(angles.tibia), femur + tibia * std::cos(angles.tibia));
  return angles;
}

LegSolution leg_angles(const LegLengths& lengths, const Vector3d& p_HF, Knee knee) {
  const double outwards = std::hypot(p_HF.x, p_HF.y) - lengths.coxa;
  const ShankAngles shank = shank_angles(lengths.femur, lengths.tibia, outwards, p_HF.z, knee);
  return {{std::atan2(p_HF.y, p_HF.x), shank.femur, shank.tibia}, shank.reachable};
}

Vector3d foot_position(const Leg& leg, const JointAngles& angles) {
  const LegLengths& lengths = leg.lengths;
  if (leg.kind == LegKind::insect)
    return foot_position(lengths, LegAngles{angles[0], angles[1], angles[2]});
  const double shank = angles[1] + angles[2];
  const double down = lengths.femur * std::cos(angles[1]) + lengths.tibia * std::cos(shank);
  const double back = lengths.femur * std::sin(angles[1]) + lengths.tibia * std::sin(shank);
  if (leg.kind == LegKind::planar) return {down, 0., back};
  const double cosine = std::cos(angles[0]), sine = std::sin(angles[0]);
  return {down * cosine - leg.hip_offset * sine, down * sine + leg.hip_offset * cosine, -back};
}

LegGoal joint_angles(const Leg& leg, const Vector3d& p_HF) {
  const LegLengths& lengths = leg.lengths;
  if (leg.kind == LegKind::insect) {
    const LegSolution found = leg_angles(lengths, p_HF, leg.knee);
    return {{found.angles.coxa, found.angles.femur, found.angles.tibia}, found.reachable};
  }
  if (leg.kind == LegKind::planar) {
    const ShankAngles found = shank_angles(lengths.femur, lengths.tibia, p_HF.x, p_HF.z, leg.knee);
    return {{0., found.femur, found.tibia}, found.reachable};
  }
  // From the front the foot is `down` below the offset's end, at right angles to it:
  // x = down cos q1 - offset sin q1, y = down sin q1 + offset cos q1.
  const double squared = p_HF.x * p_HF.x + p_HF.y * p_HF.y - leg.hip_offset * leg.hip_offset;
  const double down = std::sqrt(std::max(squared, 0.));
  const ShankAngles found = shank_angles(lengths.femur, lengths.tibia, down, -p_HF.z, leg.knee);
  const double hip = std::atan2(p_HF.y, p_HF.x) - std::atan2(leg.hip_offset, down);
  return {{hip, found.femur, found.tibia}, found.reachable && squared >= 0.};
}

}  // namespace hookpoint::control
