#include "integrators/stepper.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "integrators/explicit_euler.h"
#include "integrators/rk4.h"
#include "integrators/semi_implicit_euler.h"

namespace hookpoint::integrators {
namespace {

template <class Method>
std::unique_ptr<Stepper> make(const System& system) {
  return std::make_unique<Method>(system);
}

constexpr std::array steppers{
    StepperDescription{"explicit_euler", 1, 1,
                       "position by the old velocity; unstable on undamped springs",
                       make<ExplicitEuler>},
    StepperDescription{"semi_implicit_euler", 1, 1,
                       "position by the new velocity; keeps vibrations bounded up to dt = 2/w",
                       make<SemiImplicitEuler>},
    StepperDescription{"rk4", 4, 4, "classical Runge-Kutta, fourth order on rotations as well",
                       make<RungeKutta4>},
};

}  // namespace

std::span<const StepperDescription> stepper_table() { return steppers; }

const StepperDescription* find_stepper(std::string_view name) {
  for (const StepperDescription& stepper : steppers) {
    if (stepper.name == name) return &stepper;
  }
  return nullptr;
}

std::unique_ptr<Stepper> make_stepper(std::string_view name, const System& system) {
  const StepperDescription* stepper = find_stepper(name);
  return stepper ? stepper->make(system) : nullptr;
}

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

Status accept(std::span<const double> next_q, std::span<const double> next_v, std::span<double> q,
              std::span<double> v) {
  if (!all_finite(next_q) || !all_finite(next_v)) return Status::not_finite;
  std::copy(next_q.begin(), next_q.end(), q.begin());
  std::copy(next_v.begin(), next_v.end(), v.begin());
  return Status::ok;
}

}  // namespace hookpoint::integrators
