// The constants of a contact, from the materials of its two sides.
#pragma once

#include <cstddef>
#include <vector>

#include "contact/vocabulary.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// Constants of a contact between a foot (a shape, point or body) of material `foot` and ground of
/// material `ground`, indices into Experiment::materials or no_material. Those of a Pair where there
/// is one; else of each constant the one that one side alone states, or both combined by the World's
/// rule. Without a material on either side the defaults.
contact::MaterialConstants<double> contact_constants(const Experiment& experiment, int foot,
                                                     int ground);

/// The same of all materials of an experiment, worked out once: a look-up for each contact of a step.
class ContactMaterials {
 public:
  explicit ContactMaterials(const Experiment& experiment);

  /// O(1).
  const contact::MaterialConstants<double>& of(int foot, int ground) const {
    return table_[rows_[place(foot)] + place(ground)];
  }

  /// Of a contact between two objects of a world, in whose order the terrain comes first, then
  /// obstacles, then bodies: the later one is the foot. Where neither states a material, the terrain's;
  /// without terrain the World's first. O(1).
  const contact::MaterialConstants<double>& between(int earlier, int later) const {
    return earlier == no_material && later == no_material ? of(no_material, unstated_)
                                                          : of(later, earlier);
  }

  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const contact::MaterialConstants<double>& constants : table_) visit(constants);
  }

 private:
  /// Of a material, no_material (-1) first.
  static std::size_t place(int material) {
    const int from_zero = material + 1;
    return static_cast<std::size_t>(from_zero);
  }

  int unstated_ = no_material;     ///< of what states none
  std::vector<std::size_t> rows_;  ///< of each material as a foot's, first of none: where it begins
  std::vector<contact::MaterialConstants<double>> table_;
};

}  // namespace hookpoint::simulation
