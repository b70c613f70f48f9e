// The interface of a fixed-step integrator and the table of those there are. One method, one file.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "integrators/system.h"

namespace hookpoint::integrators {

class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Advances (q, v) from time `t` by `dt` [s]. Calls `system.accelerations` with Stage::first at
  /// (t, q, v) before anything else, then with Stage::trial only. On failure q and v are as before.
  /// Allocates nothing.
  virtual Status step(System& system, double t, double dt, std::span<double> q,
                      std::span<double> v) = 0;
};

/// One row of the table.
struct StepperDescription {
  std::string_view name;     ///< as in `integrator = rk4`
  int order = 0;             ///< error of a run ~ dt^order on smooth systems
  int evaluations = 0;       ///< calls of `accelerations` a step
  std::string_view summary;  ///< one line
  std::unique_ptr<Stepper> (*make)(const System& system) =
      nullptr;  ///< with work arrays of the system's size
};

/// Every integrator of this folder.
std::span<const StepperDescription> stepper_table();

/// The row of a name; null for an unknown name.
const StepperDescription* find_stepper(std::string_view name);

/// A stepper for systems of this system's size; null for an unknown name.
std::unique_ptr<Stepper> make_stepper(std::string_view name, const System& system);

/// Whether every number is finite.
bool all_finite(std::span<const double> values);

/// q, v := next_q, next_v if those are finite, else nothing.
Status accept(std::span<const double> next_q, std::span<const double> next_v, std::span<double> q,
              std::span<double> v);

}  // namespace hookpoint::integrators
