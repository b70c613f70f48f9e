// Owners of what SUNDIALS hands out, and the callbacks that lead from it to an AdaptiveStepper. For
// cvode.cpp and arkode.cpp only.
#pragma once

#include <arkode/arkode.h>
#include <arkode/arkode_ls.h>
#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

#include "integrators/adaptive.h"
#include "integrators/sundials_version.h"

namespace hookpoint::integrators::sundials {

struct Free {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};
template <class Pointer>
using Owner = std::unique_ptr<std::remove_pointer_t<Pointer>, Free>;

/// Owns what CVODE and ARKODE call a solver's memory, which each frees by a function of its own.
template <auto release>
class SolverMemory {
 public:
  SolverMemory() = default;
  ~SolverMemory() { release(&memory_); }
  SolverMemory(const SolverMemory&) = delete;
  SolverMemory& operator=(const SolverMemory&) = delete;
  /// Frees what it had; then owns `made`.
  void reset(void* made = nullptr) {
    release(&memory_);
    memory_ = made;
  }
  operator void*() const { return memory_; }

 private:
  void* memory_ = nullptr;
};

/// Throws std::bad_alloc where a function of the library found no memory, and another exception
/// where it failed otherwise: a tolerance that is not positive.
inline void require(int flag, const char* function) {
  static_assert(CV_MEM_FAIL == ARK_MEM_FAIL && CVLS_MEM_FAIL == ARKLS_MEM_FAIL);
  if (flag == CV_MEM_FAIL || flag == CVLS_MEM_FAIL) throw std::bad_alloc();
  if (flag < 0)
    throw std::runtime_error(std::string("SUNDIALS: ") + function + " returned " +
                             std::to_string(flag));
}
/// The library hands out null where it finds no memory.
template <class Pointer>
void require_made(const Pointer& made) {
  if (made == nullptr) throw std::bad_alloc();
}

inline Owner<SUNContext> make_context() {
  SUNContext context = nullptr;
  const int flag = create_context(&context);
  Owner<SUNContext> owner(context);
  require(flag, "SUNContext_Create");
  return owner;
}

/// A vector of the library over numbers of ours.
inline Owner<N_Vector> vector_over(std::span<double> numbers, SUNContext context) {
  Owner<N_Vector> vector(
      N_VMake_Serial(static_cast<sunindextype>(numbers.size()), numbers.data(), context));
  require_made(vector);
  return vector;
}

/// Whether `vector` has as many numbers as there are now.
inline bool is_over(N_Vector vector, std::span<const double> numbers) {
  return N_VGetLength(vector) == static_cast<sunindextype>(numbers.size());
}

/// A Jacobian of half bandwidth `band` and its solver: dense where a band would save nothing.
struct LinearSolver {
  Owner<SUNMatrix> matrix;
  Owner<SUNLinearSolver> solver;
};
inline LinearSolver make_linear_solver(N_Vector y, std::size_t size, std::size_t band,
                                       SUNContext context) {
  const auto n = static_cast<sunindextype>(size);
  const auto half = static_cast<sunindextype>(band);
  const bool dense = 2 * half + 1 >= n;
  LinearSolver linear;
  linear.matrix.reset(dense ? SUNDenseMatrix(n, n, context)
                            : SUNBandMatrix(n, half, half, context));
  require_made(linear.matrix);
  linear.solver.reset(dense ? SUNLinSol_Dense(y, linear.matrix.get(), context)
                            : SUNLinSol_Band(y, linear.matrix.get(), context));
  require_made(linear.solver);
  return linear;
}

inline AdaptiveStepper& stepper(void* user) { return *static_cast<AdaptiveStepper*>(user); }

/// For the library: 0 fine, 1 try a shorter step, -1 give up.
template <bool (AdaptiveStepper::*part)(double, const double*, double*)>
int rates(double time, N_Vector y, N_Vector rate, void* user) {
  if (stepper(user).spent()) return -1;
  return (stepper(user).*part)(time, NV_DATA_S(y), NV_DATA_S(rate)) ? 0 : 1;
}

inline int events(double time, N_Vector y, double* values, void* user) {
  if (stepper(user).spent()) return -1;
  stepper(user).event_values(time, NV_DATA_S(y), values);
  return 0;
}

}  // namespace hookpoint::integrators::sundials
