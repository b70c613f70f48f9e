// What a robot's contacts hold in their springs.
#include "simulation/engine/dts_robot.h"

namespace hookpoint::simulation {

double DtsRobot::ground_energy() const {
  double sum = 0.;
  for (const ContactPoint& point : points_) {
    if (!point.pending.attached) continue;
    const auto& material = experiment_->materials[static_cast<std::size_t>(point.material)];
    sum += contact::stored_energy(law_, point.depth, point.pending.stretch, material.constants);
  }
  return sum;
}

}  // namespace hookpoint::simulation
