// Where the measured robot touches uneven ground and obstacles under `touch = shapes`: found from poses
// alone, by the shapes, so that it means the same of every engine.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "simulation/dts_engine/memoryless_detection.h"
#include "studies/measure/run_context.h"

namespace hookpoint::studies {

class TouchingShapes {
 public:
  /// Of one place of a body.
  struct Place {
    std::size_t body = 0;              ///< in WorldState::bodies
    std::optional<std::size_t> point;  ///< among its boundary points; none of an edge or a rim
    Vector3d position;                 ///< where it touches, world [m]
    Vector3d normal;                   ///< out of what it touches, unit
    Vector3d velocity;                 ///< of the material that it touches, world [m/s]
    double depth = 0.;                 ///< > 0 inside [m]
  };

  /// Whether a point's depth under the tile below it is not all that shapes can tell: there are obstacles,
  /// or the ground is no plane.
  static bool matter(const RunContext& context);
  explicit TouchingShapes(const RunContext& context);

  /// Valid until the next call. O(bodies log bodies + pairs of shapes whose boxes meet).
  std::span<const Place> look(const simulation::WorldState& world,
                              const simulation::WorldInputs& inputs);

 private:
  const RunContext& context_;
  std::vector<std::size_t> first_bodies_;  ///< of each robot, in WorldState::bodies
  simulation::MemorylessDetection detection_;
  std::vector<Place> places_;
};

}  // namespace hookpoint::studies
