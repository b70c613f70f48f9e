#include "simulation/dts_engine/memoryless_detection.h"

namespace hookpoint::simulation {

MemorylessDetection::MemorylessDetection(const Experiment& experiment,
                                         const contact::Terrain* ground, double reach,
                                         const Options& options)
    : stays_outside_(options.stays_outside),
      objects_(shape_objects(experiment, ground)),
      detection_(experiment, objects_, ground, reach, options.self),
      motions_(objects_.size()) {
  contacts_.reserve(slots_for(objects_));
}

}  // namespace hookpoint::simulation
