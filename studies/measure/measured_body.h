// The body that a study's metrics of motion look at.
#pragma once

#include <cstddef>
#include <string_view>

#include "simulation/experiment/experiment.h"

namespace hookpoint::studies {

struct MeasuredBody {
  int robot = 0;         ///< index of its robot
  std::size_t base = 0;  ///< index of that robot's base in WorldState::bodies
  std::size_t body = 0;  ///< index of the body there
};

/// Whether a robot has a mobile base or links.
bool something_moves(const simulation::Experiment& experiment);

/// The body that `trail` names: a robot, which stands for its base, or a body of one, with or
/// without the world's name: "arm.leg1.link2". Without a trail the base of the first mobile robot,
/// or else the last link of the first chain of the first robot that has links. Throws
/// simulation::ExperimentError where there is no such body, or nothing moves it.
MeasuredBody measured_body(const simulation::Experiment& experiment, std::string_view trail = {});

}  // namespace hookpoint::studies
