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

LegSolution leg_angles(const LegLengths& lengths, const Vector3d& p_HF, Knee knee) {
  const double outwards = std::hypot(p_HF.x, p_HF.y) - lengths.coxa;
  const double wanted = std::hypot(outwards, p_HF.z);
  const double shortest = std::abs(lengths.femur - lengths.tibia);
  const double longest = lengths.femur + lengths.tibia;
  const double distance = std::clamp(wanted, shortest, longest);
  // Twice the product of the sides, times cosine and sine of the angle between femur and tibia's
  // extension.
  const double cosine =
      distance * distance - lengths.femur * lengths.femur - lengths.tibia * lengths.tibia;
  const double sine = std::sqrt((longest - distance) * (longest + distance) *
                                (distance - shortest) * (distance + shortest));
  LegSolution solution;
  solution.reachable = wanted == distance;
  solution.angles.coxa = std::atan2(p_HF.y, p_HF.x);
  solution.angles.tibia = std::atan2(knee == Knee::up ? -sine : sine, cosine);
  solution.angles.femur =
      std::atan2(p_HF.z, outwards) -
      std::atan2(lengths.tibia * std::sin(solution.angles.tibia),
                 lengths.femur + lengths.tibia * std::cos(solution.angles.tibia));
  return solution;
}

}  // namespace hookpoint::control
