// The interface of an integrator and the table of those there are. One method, one file.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "integrators/stability_bound.h"
#include "integrators/system.h"

namespace hookpoint::integrators {

/// Evaluations of rates and events that one `step` of an adaptive integrator may need. What needs
/// more crawls, over a discontinuity or a stiffness that it cannot take, and says so rather than go
/// on for ever.
inline constexpr long most_evaluations = 300000;

/// What an adaptive integrator holds its local error to: of an unknown y (position along the
/// tangent, velocity; m, rad, and per s) at most about relative |y| + absolute a step.
struct Tolerances {
  double relative = 1e-6;
  double absolute = 1e-8;
  long most_evaluations = integrators::most_evaluations;
};

/// What the integration has cost since the stepper was made: counts, exact up to 2^53.
struct Statistics {
  double steps = 0.;        ///< accepted; of an adaptive integrator its internal steps
  double rejected = 0.;     ///< steps taken back: error too large, or no convergence
  double evaluations = 0.;  ///< of accelerations, those for Jacobians included
  double jacobians = 0.;    ///< Jacobian matrices by difference quotients
  double events = 0.;       ///< roots at which the integration stopped and restarted
};

class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Advances (q, v) from time `t` by `dt` [s]. Calls `system.accelerations` with Stage::first at
  /// (t, q, v) before anything else, then with Stage::trial only. On failure q and v are as before.
  /// Allocates nothing (the first step of an adaptive integrator excepted, which sets up its
  /// library).
  virtual Status step(System& system, double t, double dt, std::span<double> q,
                      std::span<double> v) = 0;

  /// What it carries from step to step, as numbers, to be saved and restored with a run: its
  /// statistics, and the step that its error control would try next (0: none).
  static constexpr std::size_t state_size() { return 6; }
  void save(std::span<double> numbers) const;
  void restore(std::span<const double> numbers);

  const Statistics& statistics() const { return statistics_; }

 protected:
  /// system.accelerations, counted.
  Status evaluate(System& system, Stage stage, double t, std::span<const double> q,
                  std::span<const double> v, std::span<double> a);
  /// q, v := next_q, next_v if those are finite (a step is counted), else nothing.
  Status accept(std::span<const double> next_q, std::span<const double> next_v, std::span<double> q,
                std::span<double> v);

  Statistics statistics_;
  double next_step_ = 0.;  ///< [s] what alone the next step may depend on beside (q, v)
};

/// What an integrator says of itself, in the file of its method.
struct StepperDescription {
  std::string_view name;     ///< as in `integrator = rk4`
  int order = 0;             ///< error of a run ~ dt^order on smooth systems; 0: adaptive
  int evaluations = 0;       ///< calls of `accelerations` a step; 0: as many as it takes
  std::string_view summary;  ///< one line
  /// With work arrays of the system's size; only adaptive ones read the tolerances.
  std::unique_ptr<Stepper> (*make)(const System& system, const Tolerances& tolerances) = nullptr;
  LinearStability stability = {};  ///< of an adaptive one it is not used
  /// A step's displacement is dt times the velocities that it ends with. The bristles of contacts
  /// then move ahead of their forces too (contact::reaction_with_moved_bristle).
  bool moves_with_new_velocity = false;
  /// It calls System::take_joints_at_end_of.
  bool implicit_joints = false;
  constexpr bool adaptive() const { return order == 0; }
};

/// `make` of a method with fixed steps.
template <class Method>
std::unique_ptr<Stepper> make_fixed_step(const System& system, const Tolerances& /*tolerances*/) {
  return std::make_unique<Method>(system);
}

/// Every integrator of this folder.
std::span<const StepperDescription> stepper_table();

/// Their names, in that order.
std::vector<std::string> integrator_names();

/// The row of a name; null for an unknown name.
const StepperDescription* find_stepper(std::string_view name);

/// A stepper for systems of this system's size; null for an unknown name.
std::unique_ptr<Stepper> make_stepper(std::string_view name, const System& system,
                                      const Tolerances& tolerances = {});

/// Whether every number is finite.
bool all_finite(std::span<const double> values);

}  // namespace hookpoint::integrators
