// Checks of a run that give warnings at its end: whether its energy grew from nothing, and whether bodies
// passed through each other or through obstacles.
#pragma once

#include <string>
#include <vector>

#include "simulation/run/energy_watch.h"
#include "simulation/run/overlap_watch.h"
#include "simulation/run/passage_watch.h"

namespace hookpoint::simulation {

class WorldWatch {
 public:
  /// Of a run from the world's present step to step `last`.
  WorldWatch(const Experiment& experiment, World& world, std::int64_t last)
      : energy_(experiment, world, last),
        overlap_(experiment, world),
        passage_(experiment, world) {}

  /// After each step.
  void observe() {
    energy_.observe();
    overlap_.observe();
    passage_.observe();
  }

  /// Sentences for the user.
  std::vector<std::string> findings() const {
    std::vector<std::string> all;
    for (std::string finding : {energy_.finding(), overlap_.finding(), passage_.finding()})
      if (!finding.empty()) all.push_back(std::move(finding));
    return all;
  }

 private:
  EnergyWatch energy_;
  OverlapWatch overlap_;
  PassageWatch passage_;
};

}  // namespace hookpoint::simulation
