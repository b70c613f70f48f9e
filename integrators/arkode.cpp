#include "integrators/arkode.h"

#include <algorithm>

#include "integrators/sundials_memory.h"
#include "integrators/sundials_version.h"

namespace hookpoint::integrators {
namespace {

using sundials::require;

class Arkode final : public AdaptiveStepper {
 public:
  Arkode(const HybridSystem& system, const Tolerances& tolerances, bool imex)
      : AdaptiveStepper(system, tolerances.most_evaluations, imex),
        explicit_part_(imex ? sundials::rates<&AdaptiveStepper::explicit_rates>
                            : sundials::rates<&AdaptiveStepper::rates>),
        implicit_part_(imex ? sundials::rates<&AdaptiveStepper::implicit_rates> : nullptr),
        tolerances_(tolerances),
        events_(static_cast<int>(system.event_count())),
        context_(sundials::make_context()) {
    create();
  }

 private:
  static constexpr double growth = 1.2;  ///< of the first step tried, while none is rejected

  void create() {
    memory_.reset();
    y_ = sundials::vector_over(unknowns_, context_.get());
    between_ = sundials::vector_over(unknowns_, context_.get());
    memory_.reset(ARKStepCreate(explicit_part_, implicit_part_, 0., y_.get(), context_.get()));
    sundials::require_made(memory_);
    require(sundials::silence_arkode(memory_), "silence_arkode");
    require(ARKodeSetUserData(memory_, static_cast<AdaptiveStepper*>(this)), "ARKodeSetUserData");
    require(ARKodeSStolerances(memory_, tolerances_.relative, tolerances_.absolute),
            "ARKodeSStolerances");
    require(ARKodeSetMaxErrTestFails(memory_, most_rejections), "ARKodeSetMaxErrTestFails");
    // A higher interpolant evaluates rates of its own, and whether it does depends on more than
    // this step: a run that is resumed would count others.
    require(ARKodeSetInterpolantDegree(memory_, 3), "ARKodeSetInterpolantDegree");
    if (events_ > 0) {
      require(ARKodeRootInit(memory_, events_, sundials::events), "ARKodeRootInit");
      require(ARKodeSetNoInactiveRootWarn(memory_), "ARKodeSetNoInactiveRootWarn");
    }
    if (implicit_part_ != nullptr) {
      require(
          ARKStepSetTableNum(memory_, ARKODE_ARK436L2SA_DIRK_6_3_4, ARKODE_ARK436L2SA_ERK_6_3_4),
          "ARKStepSetTableNum");
      linear_ = sundials::make_linear_solver(y_.get(), unknowns_.size(), band(), context_.get());
      require(ARKodeSetLinearSolver(memory_, linear_.solver.get(), linear_.matrix.get()),
              "ARKodeSetLinearSolver");
      // By default Newton's iteration is trusted after one correction where the ones before went
      // well. The implicit part here is linear off contact, all of them go well, and the one with
      // an old matrix is far off: errors of 1e-2 at a tolerance of 1e-6.
      require(ARKodeSetNonlinCRDown(memory_, 1.), "ARKodeSetNonlinCRDown");
    } else {
      require(ARKStepSetTableNum(memory_, ARKODE_DIRK_NONE, ARKODE_DORMAND_PRINCE_7_4_5),
              "ARKStepSetTableNum");
    }
  }

  bool begin(double time, double end) override {
    longest_ = 0.;
    if (!sundials::is_over(y_.get(), unknowns_)) create();
    return ARKStepReInit(memory_, explicit_part_, implicit_part_, time, y_.get()) == ARK_SUCCESS &&
           ARKodeSetStopTime(memory_, end) == ARK_SUCCESS &&
           ARKodeSetMinStep(memory_, least_step * end) == ARK_SUCCESS &&
           ARKodeSetInitStep(memory_, next_step_) == ARK_SUCCESS;  // 0: the library's own guess
  }

  Arrival advance(double end) override {
    double time = 0.;
    const int flag = ARKodeEvolve(memory_, end, y_.get(), &time, ARK_ONE_STEP);
    double taken = 0.;
    require(ARKodeGetLastStep(memory_, &taken), "ARKodeGetLastStep");
    longest_ = std::max(longest_, taken);
    if (flag == ARK_SUCCESS) return {Arrival::Kind::inside, time};
    if (flag == ARK_TSTOP_RETURN) return {Arrival::Kind::at_end, time};
    if (flag != ARK_ROOT_RETURN) return {};
    if (ARKodeGetRootInfo(memory_, directions_.data()) != ARK_SUCCESS) return {};
    return {Arrival::Kind::event, time};
  }

  bool interpolate(double time, std::span<double> y) override {
    N_VSetArrayPointer(y.data(), between_.get());
    return ARKodeGetDky(memory_, time, 0, between_.get()) == ARK_SUCCESS;
  }

  void count() override {
    long errors = 0, divergences = 0, jacobians = 0;
    require(ARKodeGetNumErrTestFails(memory_, &errors), "ARKodeGetNumErrTestFails");
    if (linear_.solver) {
      require(ARKodeGetNumNonlinSolvConvFails(memory_, &divergences),
              "ARKodeGetNumNonlinSolvConvFails");
      require(ARKodeGetNumJacEvals(memory_, &jacobians), "ARKodeGetNumJacEvals");
    }
    statistics_.rejected += static_cast<double>(errors + divergences);
    statistics_.jacobians += static_cast<double>(jacobians);
    // The library's own proposal is cut short by the end of the interval; the longest step that it
    // took is not.
    if (longest_ > 0.) next_step_ = errors > 0 ? longest_ : growth * longest_;
  }

  long factorisations() const override {
    long count = 0;
    if (linear_.solver)
      require(ARKodeGetNumLinSolvSetups(memory_, &count), "ARKodeGetNumLinSolvSetups");
    return count;
  }

  ARKRhsFn explicit_part_, implicit_part_;
  Tolerances tolerances_;
  int events_;
  sundials::Owner<SUNContext> context_;
  sundials::Owner<N_Vector> y_;
  sundials::Owner<N_Vector> between_;  ///< over what `interpolate` is given
  sundials::LinearSolver linear_;
  sundials::SolverMemory<ARKodeFree> memory_;
  double longest_ = 0.;  ///< step taken since `begin` [s]
};

}  // namespace

std::unique_ptr<Stepper> make_arkode(const System& system, const Tolerances& tolerances) {
  return std::make_unique<Arkode>(dynamic_cast<const HybridSystem&>(system), tolerances, false);
}

std::unique_ptr<Stepper> make_arkode_imex(const System& system, const Tolerances& tolerances) {
  return std::make_unique<Arkode>(dynamic_cast<const HybridSystem&>(system), tolerances, true);
}

}  // namespace hookpoint::integrators
