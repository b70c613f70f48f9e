// Rebound of a mass on a contact, as an engine steps it.
#pragma once

#include <functional>
#include <optional>

#include "translation/situation.h"

namespace hookpoint::translation {

/// Force of a contact over one step [N], from its depth [m] and the speed of approach [m/s] at the
/// step's beginning. Negative forces are cut off: a contact does not pull.
using ForceOverStep = std::function<double(double depth, double approach)>;

/// Speed after over speed before of a mass [kg] that comes at 1 m/s, without weight, under
/// semi-implicit Euler: v += dt f/m, x += dt v. The mean over where in a step the ground is met.
/// Empty for an impact that is not over after 1e6 steps, or that ends in numbers that are not finite.
std::optional<double> rebound(double mass, double deltat, const ForceOverStep& force);

/// The same of the contact at `at`, as a part of what it does.
void predict_rebound(Behaviour& behaviour, const Situation& at, const ForceOverStep& force);

/// The largest step [s] at which semi-implicit Euler with a spring k and a damper c that are
/// evaluated at the step's beginning is stable: dt^2 k/m + 2 dt c/m <= 4.
double explicit_stable_step(double mass, double stiffness, double damping);

}  // namespace hookpoint::translation
