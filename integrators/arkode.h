// SUNDIALS ARKODE (Reynolds & al. 2023): one-step methods of adaptive step.
#pragma once

#include "integrators/stepper.h"

namespace hookpoint::integrators {

/// The explicit pair of order 5(4) of Dormand & Prince 1980.
std::unique_ptr<Stepper> make_arkode(const System& system, const Tolerances& tolerances);

/// The additive pair of order 4(3) of Kennedy & Carpenter 2003, ARK4(3)6L[2]SA: contact and the
/// kinematics u' = tangent_rate(u, v) implicit, so that a contact spring is solved with its own
/// motion; gravity, gyroscopic terms and joint torques explicit.
std::unique_ptr<Stepper> make_arkode_imex(const System& system, const Tolerances& tolerances);

inline constexpr StepperDescription arkode{
    .name = "arkode",
    .summary = "SUNDIALS ARKODE: adaptive explicit Runge-Kutta of order 5, Dormand-Prince",
    .make = make_arkode};

inline constexpr StepperDescription arkode_imex{
    .name = "arkode_imex",
    .summary =
        "SUNDIALS ARKODE: additive Runge-Kutta of order 4, contact implicit, the rest "
        "explicit",
    .make = make_arkode_imex};

}  // namespace hookpoint::integrators
