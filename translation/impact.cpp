#include "translation/impact.h"

#include <algorithm>
#include <cmath>

namespace hookpoint::translation {

std::optional<double> rebound(double mass, double deltat, const ForceOverStep& force) {
  constexpr int phases = 8, most_steps = 1'000'000;
  double sum = 0.;
  for (int phase = 0; phase < phases; ++phase) {
    // The ground is met within the first step.
    double depth = impact_speed * deltat * ((phase + 0.5) / phases - 1.);
    double approach = impact_speed;
    int step = 0;
    for (; step < most_steps && !(approach <= 0. && depth <= 0.); ++step) {
      approach -= deltat / mass * std::max(0., force(depth, approach));
      depth += deltat * approach;
    }
    if (step == most_steps || !std::isfinite(approach)) return std::nullopt;
    sum -= approach / impact_speed;
  }
  return sum / phases;
}

void predict_rebound(Behaviour& behaviour, const Situation& at, const ForceOverStep& force) {
  behaviour.rebound = rebound(at.mass, at.deltat, force);
  if (!behaviour.rebound) behaviour.add_unknown("the impact does not end within a million steps");
}

double explicit_stable_step(double mass, double stiffness, double damping) {
  return (std::sqrt(damping * damping + 4. * stiffness * mass) - damping) / stiffness;
}

}  // namespace hookpoint::translation
