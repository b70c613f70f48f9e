// URDF files drawn at random: chains of links with shapes and meshes, limits, transmissions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/fuzz/generated_experiment.h"

namespace hookpoint::fuzz {

struct GeneratedRobot {
  std::vector<GeneratedFile> files;  ///< the URDF first, then meshes
  std::string arguments;             ///< of its Include, each after ", "
};

/// `degenerate`: the part of values that are.
GeneratedRobot generate_robot(std::uint64_t seed, double degenerate);

}  // namespace hookpoint::fuzz
