#include "integrators/cvode.h"

#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "integrators/sundials_memory.h"

namespace hookpoint::integrators {
namespace {

class Cvode final : public AdaptiveStepper {
 public:
  Cvode(const System& system, const Tolerances& tolerances, int method)
      : AdaptiveStepper(system),
        tolerances_(tolerances),
        method_(method),
        events_(static_cast<int>(system.event_count())),
        context_(sundials::make_context()) {
    create();
  }
  ~Cvode() override { CVodeFree(&memory_); }
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;

 private:
  void create() {
    CVodeFree(&memory_);
    y_ = sundials::vector_over(unknowns_, context_.get());
    memory_ = CVodeCreate(method_, context_.get());
    CVodeSetErrHandlerFn(memory_, sundials::silent, nullptr);
    CVodeInit(memory_, sundials::rates<&AdaptiveStepper::rates>, 0., y_.get());
    CVodeSetUserData(memory_, static_cast<AdaptiveStepper*>(this));
    CVodeSStolerances(memory_, tolerances_.relative, tolerances_.absolute);
    CVodeSetNoInactiveRootWarn(memory_);
    if (events_ > 0) CVodeRootInit(memory_, events_, sundials::events);
    if (method_ == CV_BDF) {
      linear_ = sundials::make_linear_solver(y_.get(), unknowns_.size(), band(), context_.get());
      CVodeSetLinearSolver(memory_, linear_.solver.get(), linear_.matrix.get());
    } else {
      corrector_.reset(SUNNonlinSol_FixedPoint(y_.get(), 0, context_.get()));
      CVodeSetNonlinearSolver(memory_, corrector_.get());
    }
  }

  void begin(double time, double end) override {
    if (!sundials::is_over(y_.get(), unknowns_)) create();
    CVodeReInit(memory_, time, y_.get());
    CVodeSetStopTime(memory_, end);
    CVodeSetMinStep(memory_, least_step * end);
  }

  Arrival advance(double end) override {
    double time = 0.;
    switch (CVode(memory_, end, y_.get(), &time, CV_ONE_STEP)) {
      case CV_SUCCESS:
        return {Arrival::Kind::inside, time};
      case CV_TSTOP_RETURN:
        return {Arrival::Kind::at_end, time};
      case CV_ROOT_RETURN:
        return {Arrival::Kind::event, time};
      default:
        return {};
    }
  }

  void count() override {
    long errors = 0, divergences = 0, jacobians = 0;
    CVodeGetNumErrTestFails(memory_, &errors);
    CVodeGetNumNonlinSolvConvFails(memory_, &divergences);
    if (linear_.solver) CVodeGetNumJacEvals(memory_, &jacobians);
    statistics_.rejected += static_cast<double>(errors + divergences);
    statistics_.jacobians += static_cast<double>(jacobians);
  }

  Tolerances tolerances_;
  int method_, events_;
  sundials::Owner<SUNContext> context_;
  sundials::Owner<N_Vector> y_;
  sundials::LinearSolver linear_;
  sundials::Owner<SUNNonlinearSolver> corrector_;
  void* memory_ = nullptr;
};

}  // namespace

std::unique_ptr<Stepper> make_cvode_bdf(const System& system, const Tolerances& tolerances) {
  return std::make_unique<Cvode>(system, tolerances, CV_BDF);
}

std::unique_ptr<Stepper> make_cvode_adams(const System& system, const Tolerances& tolerances) {
  return std::make_unique<Cvode>(system, tolerances, CV_ADAMS);
}

}  // namespace hookpoint::integrators
