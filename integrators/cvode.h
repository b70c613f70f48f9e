// SUNDIALS CVODE (Hindmarsh & al. 2005): linear multistep methods of variable order and step.
#pragma once

#include "integrators/stepper.h"

namespace hookpoint::integrators {

/// Backward differentiation formulas of order 1 to 5, for stiff contact; Newton's method with a
/// Jacobian by difference quotients, dense, or a band where groups of coordinates are independent
/// (HybridSystem::jacobian_block).
std::unique_ptr<Stepper> make_cvode_bdf(const System& system, const Tolerances& tolerances);

/// Adams-Moulton formulas of order 1 to 12, corrected by functional iteration: the
/// predictor-corrector that the paper weighs in 3.5.
std::unique_ptr<Stepper> make_cvode_adams(const System& system, const Tolerances& tolerances);

inline constexpr StepperDescription cvode_bdf{
    .name = "cvode_bdf",
    .summary =
        "SUNDIALS CVODE: backward differentiation of order 1 to 5, Newton with the dense or "
        "band Jacobian",
    .make = make_cvode_bdf};

inline constexpr StepperDescription cvode_adams{
    .name = "cvode_adams",
    .summary = "SUNDIALS CVODE: Adams-Moulton predictor-corrector of order 1 to 12",
    .make = make_cvode_adams};

}  // namespace hookpoint::integrators
