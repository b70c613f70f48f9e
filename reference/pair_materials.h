// The constants of a contact between two sides, as every engine reads them.
#pragma once

#include "simulation/experiment/contact_materials.h"

namespace hookpoint::reference {

/// As the World's `combine` and its Pairs make them of the two materials.
class PairMaterials {
 public:
  explicit PairMaterials(const simulation::Experiment& experiment)
      : table_(experiment), count_(static_cast<int>(experiment.materials.size())) {}

  /// `foot`: of what a robot touches with, no_material where it has none. O(1).
  const contact::MaterialConstants<double>& of(int foot, int ground) const {
    return table_.of(foot, ground < count_ ? ground : simulation::no_material);
  }

 private:
  simulation::ContactMaterials table_;
  int count_;
};

}  // namespace hookpoint::reference
