// Differences between SUNDIALS 6 (Debian 12) and SUNDIALS 7 (Debian 13). The rest of this folder
// uses the names of version 7. For the other files of this folder that use SUNDIALS.
#pragma once

#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>

#if SUNDIALS_VERSION_MAJOR < 7
// Version 7 has one set of functions for all steppers of ARKODE.
inline constexpr auto ARKodeSetUserData = ARKStepSetUserData;
inline constexpr auto ARKodeSStolerances = ARKStepSStolerances;
inline constexpr auto ARKodeSetMaxErrTestFails = ARKStepSetMaxErrTestFails;
inline constexpr auto ARKodeSetInterpolantDegree = ARKStepSetInterpolantDegree;
inline constexpr auto ARKodeRootInit = ARKStepRootInit;
inline constexpr auto ARKodeSetNoInactiveRootWarn = ARKStepSetNoInactiveRootWarn;
inline constexpr auto ARKodeSetLinearSolver = ARKStepSetLinearSolver;
inline constexpr auto ARKodeSetNonlinCRDown = ARKStepSetNonlinCRDown;
inline constexpr auto ARKodeSetStopTime = ARKStepSetStopTime;
inline constexpr auto ARKodeSetMinStep = ARKStepSetMinStep;
inline constexpr auto ARKodeSetInitStep = ARKStepSetInitStep;
inline constexpr auto ARKodeEvolve = ARKStepEvolve;
inline constexpr auto ARKodeGetLastStep = ARKStepGetLastStep;
inline constexpr auto ARKodeGetRootInfo = ARKStepGetRootInfo;
inline constexpr auto ARKodeGetDky = ARKStepGetDky;
inline constexpr auto ARKodeGetNumErrTestFails = ARKStepGetNumErrTestFails;
inline constexpr auto ARKodeGetNumNonlinSolvConvFails = ARKStepGetNumNonlinSolvConvFails;
inline constexpr auto ARKodeGetNumLinSolvSetups = ARKStepGetNumLinSolvSetups;
inline constexpr auto ARKodeGetNumJacEvals = ARKStepGetNumJacEvals;
inline constexpr auto ARKodeFree = ARKStepFree;
#endif

namespace hookpoint::integrators::sundials {

// The library prints nothing: the caller reads the flags that its functions return.
#if SUNDIALS_VERSION_MAJOR < 7
/// Creates a context of one process, without MPI; a negative flag where the library cannot.
inline int create_context(SUNContext* context) { return SUNContext_Create(nullptr, context); }

inline void print_nothing(int, const char*, const char*, char*, void*) {}
inline int silence_cvode(void* solver) {
  return CVodeSetErrHandlerFn(solver, print_nothing, nullptr);
}
inline int silence_arkode(void* solver) {
  return ARKStepSetErrHandlerFn(solver, print_nothing, nullptr);
}
#else
inline int create_context(SUNContext* context) {
  const int flag = SUNContext_Create(SUN_COMM_NULL, context);
  return flag < 0 ? flag : SUNContext_ClearErrHandlers(*context);
}

// Errors have lost their handler with the context's. The warning "t + h = t" is printed without
// one.
inline int silence_cvode(void* solver) { return CVodeSetMaxHnilWarns(solver, -1); }
inline int silence_arkode(void* solver) { return ARKodeSetMaxHnilWarns(solver, -1); }
#endif

}  // namespace hookpoint::integrators::sundials
