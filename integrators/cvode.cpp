#include "integrators/cvode.h"

#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "integrators/sundials_memory.h"
#include "integrators/sundials_version.h"

namespace hookpoint::integrators {
namespace {

using sundials::require;

class Cvode final : public AdaptiveStepper {
 public:
  Cvode(const HybridSystem& system, const Tolerances& tolerances, int method)
      : AdaptiveStepper(system, tolerances.most_evaluations, method == CV_BDF),
        tolerances_(tolerances),
        method_(method),
        events_(static_cast<int>(system.event_count())),
        context_(sundials::make_context()) {
    create();
  }

 private:
  void create() {
    memory_.reset();
    y_ = sundials::vector_over(unknowns_, context_.get());
    between_ = sundials::vector_over(unknowns_, context_.get());
    memory_.reset(CVodeCreate(method_, context_.get()));
    sundials::require_made(memory_);
    require(sundials::silence_cvode(memory_), "silence_cvode");
    require(CVodeInit(memory_, sundials::rates<&AdaptiveStepper::rates>, 0., y_.get()),
            "CVodeInit");
    require(CVodeSetUserData(memory_, static_cast<AdaptiveStepper*>(this)), "CVodeSetUserData");
    require(CVodeSStolerances(memory_, tolerances_.relative, tolerances_.absolute),
            "CVodeSStolerances");
    require(CVodeSetMaxErrTestFails(memory_, most_rejections), "CVodeSetMaxErrTestFails");
    require(CVodeSetNoInactiveRootWarn(memory_), "CVodeSetNoInactiveRootWarn");
    if (events_ > 0) require(CVodeRootInit(memory_, events_, sundials::events), "CVodeRootInit");
    if (method_ == CV_BDF) {
      linear_ = sundials::make_linear_solver(y_.get(), unknowns_.size(), band(), context_.get());
      require(CVodeSetLinearSolver(memory_, linear_.solver.get(), linear_.matrix.get()),
              "CVodeSetLinearSolver");
    } else {
      corrector_.reset(SUNNonlinSol_FixedPoint(y_.get(), 0, context_.get()));
      sundials::require_made(corrector_);
      require(CVodeSetNonlinearSolver(memory_, corrector_.get()), "CVodeSetNonlinearSolver");
    }
  }

  bool begin(double time, double end) override {
    if (!sundials::is_over(y_.get(), unknowns_)) create();
    return CVodeReInit(memory_, time, y_.get()) == CV_SUCCESS &&
           CVodeSetStopTime(memory_, end) == CV_SUCCESS &&
           CVodeSetMinStep(memory_, least_step * end) == CV_SUCCESS;
  }

  Arrival advance(double end) override {
    double time = 0.;
    switch (CVode(memory_, end, y_.get(), &time, CV_ONE_STEP)) {
      case CV_SUCCESS:
        return {Arrival::Kind::inside, time};
      case CV_TSTOP_RETURN:
        return {Arrival::Kind::at_end, time};
      case CV_ROOT_RETURN:
        if (CVodeGetRootInfo(memory_, directions_.data()) != CV_SUCCESS) return {};
        return {Arrival::Kind::event, time};
      default:
        return {};
    }
  }

  bool interpolate(double time, std::span<double> y) override {
    N_VSetArrayPointer(y.data(), between_.get());
    return CVodeGetDky(memory_, time, 0, between_.get()) == CV_SUCCESS;
  }

  void count() override {
    long errors = 0, divergences = 0, jacobians = 0;
    require(CVodeGetNumErrTestFails(memory_, &errors), "CVodeGetNumErrTestFails");
    require(CVodeGetNumNonlinSolvConvFails(memory_, &divergences),
            "CVodeGetNumNonlinSolvConvFails");
    if (linear_.solver) require(CVodeGetNumJacEvals(memory_, &jacobians), "CVodeGetNumJacEvals");
    statistics_.rejected += static_cast<double>(errors + divergences);
    statistics_.jacobians += static_cast<double>(jacobians);
  }

  long factorisations() const override {
    long count = 0;
    if (linear_.solver)
      require(CVodeGetNumLinSolvSetups(memory_, &count), "CVodeGetNumLinSolvSetups");
    return count;
  }

  Tolerances tolerances_;
  int method_, events_;
  sundials::Owner<SUNContext> context_;
  sundials::Owner<N_Vector> y_;
  sundials::Owner<N_Vector> between_;  ///< over what `interpolate` is given
  sundials::LinearSolver linear_;
  sundials::Owner<SUNNonlinearSolver> corrector_;
  sundials::SolverMemory<CVodeFree> memory_;
};

}  // namespace

std::unique_ptr<Stepper> make_cvode_bdf(const System& system, const Tolerances& tolerances) {
  return std::make_unique<Cvode>(dynamic_cast<const HybridSystem&>(system), tolerances, CV_BDF);
}

std::unique_ptr<Stepper> make_cvode_adams(const System& system, const Tolerances& tolerances) {
  return std::make_unique<Cvode>(dynamic_cast<const HybridSystem&>(system), tolerances, CV_ADAMS);
}

}  // namespace hookpoint::integrators
