// What pulls a robot along its ground, where that follows from the scene's own signals: weight and
// the forces on its base, from step to step.
#pragma once

#include <cstdint>
#include <string>

#include "simulation/run/world.h"
#include "studies/measure/metric.h"

namespace hookpoint::studies {

/// Why the forces of the scene depend on what moves; "" where signals and constants alone decide
/// them.
std::string why_forces_depend_on_motion(const simulation::Experiment& experiment);

/// Weight and external forces on the measured robot, a single body that rests. The signals are
/// evaluated as in the run, noise included, in a world that stands still.
class DrivingForce {
 public:
  /// At time 0. `context` outlives it. Throws simulation::ExperimentError.
  explicit DrivingForce(const RunContext& context);

  Vector3d force() const;   ///< world axes [N]
  Vector3d moment() const;  ///< of the external forces about the centre of mass, world axes [N m]
  /// The next step; false where the run ends.
  bool advance();
  std::int64_t step() const { return world_.state().step; }

 private:
  const RunContext& context_;
  simulation::World world_;
  std::int64_t steps_;
};

}  // namespace hookpoint::studies
