// A measured curve and the port that it is held against.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "studies/measurements/trace_file.h"

namespace hookpoint::studies {

/// What a Trace block has of one case: a curve that was measured, and the port that it is held
/// against.
struct TracePlan {
  std::string name;
  std::filesystem::path file;
  std::string column;  ///< as its file names it; of several the first
  std::string port;    ///< trail; of a vector or an orientation without its parts
  /// Trails of the port's parts: itself; .x .y .z of a vector; .w .x .y .z of an orientation.
  std::vector<std::string> parts;
  std::string port_unit;
  double unit_of_port = 1.;  ///< in SI
  double weight = 1.;        ///< in one over the SI unit; of an orientation in 1/rad
  MeasuredTrace measured;
  bool may_be_empty = false;  ///< it may be that no constant changes it

  bool is_orientation() const { return parts.size() == 4; }
  /// Residuals of a sample: one a part; of an orientation the three of a rotation vector.
  std::size_t residuals_a_sample() const { return is_orientation() ? 3 : parts.size(); }
  std::size_t residuals() const { return residuals_a_sample() * measured.time.size(); }
};

/// Of all that decides its residuals: ports, weight and samples; as 32 hexadecimal digits.
std::string trace_hash(const TracePlan& trace);

}  // namespace hookpoint::studies
