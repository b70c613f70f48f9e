#include "integrators/stepper.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "integrators/arkode.h"
#include "integrators/cvode.h"
#include "integrators/explicit_euler.h"
#include "integrators/implicit_joints.h"
#include "integrators/rk4.h"
#include "integrators/semi_implicit_euler.h"

namespace hookpoint::integrators {
namespace {

// In the order in which they are listed to the user.
constexpr std::array steppers{
    explicit_euler, semi_implicit_euler, implicit_joints, rk4,          // fixed steps
    cvode_bdf,      cvode_adams,         arkode,          arkode_imex,  // adaptive
};

}  // namespace

std::span<const StepperDescription> stepper_table() { return steppers; }

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const StepperDescription& stepper : stepper_table()) names.emplace_back(stepper.name);
  return names;
}

const StepperDescription* find_stepper(std::string_view name) {
  for (const StepperDescription& stepper : steppers) {
    if (stepper.name == name) return &stepper;
  }
  return nullptr;
}

std::unique_ptr<Stepper> make_stepper(std::string_view name, const System& system,
                                      const Tolerances& tolerances) {
  const StepperDescription* stepper = find_stepper(name);
  if (stepper == nullptr) return nullptr;
  // Where nothing moves there is no step to choose, and SUNDIALS takes no system without unknowns.
  if (stepper->adaptive() && system.velocity_size() == 0)
    return std::make_unique<SemiImplicitEuler>(system);
  return stepper->make(system, tolerances);
}

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

void Stepper::save(std::span<double> numbers) const {
  const auto& [steps, rejected, evaluations, jacobians, events] = statistics_;
  const std::array state{steps, rejected, evaluations, jacobians, events, next_step_};
  std::copy(state.begin(), state.end(), numbers.begin());
}

void Stepper::restore(std::span<const double> numbers) {
  statistics_ = {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]};
  next_step_ = numbers[5];
}

Status Stepper::evaluate(System& system, Stage stage, double t, std::span<const double> q,
                         std::span<const double> v, std::span<double> a) {
  ++statistics_.evaluations;
  return system.accelerations(stage, t, q, v, a);
}

Status Stepper::accept(std::span<const double> next_q, std::span<const double> next_v,
                       std::span<double> q, std::span<double> v) {
  if (!all_finite(next_q) || !all_finite(next_v)) return Status::not_finite;
  std::copy(next_q.begin(), next_q.end(), q.begin());
  std::copy(next_v.begin(), next_v.end(), v.begin());
  ++statistics_.steps;
  return Status::ok;
}

}  // namespace hookpoint::integrators
