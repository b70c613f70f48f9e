// What a closed form says of a metric of one run.
#pragma once

#include "simulation/experiment/closed_form.h"

namespace hookpoint::studies {

using simulation::NoClosedForm;

/// The metric's value in SI, or in one line why there is no closed form of it.
using Prediction = simulation::ClosedForm<double>;

}  // namespace hookpoint::studies
