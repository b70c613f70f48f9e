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

}  // namespace hookpoint::control
