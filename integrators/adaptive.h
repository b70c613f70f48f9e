// What the adaptive integrators share: the unknowns, and the way from t to t + dt by internal steps
// that end at events. The libraries' side is in cvode.cpp and arkode.cpp.
#pragma once

#include <stdexcept>

#include "integrators/hybrid_system.h"
#include "integrators/stepper.h"

namespace hookpoint::integrators {

/// Work that one `step` of an adaptive integrator may take, in multiplications. A few seconds of
/// one processor.
inline constexpr double most_work = 4e9;

/// Thrown where one factorisation of the Jacobian would take more than `most_work`.
struct TooManyUnknowns : std::length_error {
  TooManyUnknowns(std::size_t all, std::size_t of_first_order)
      : std::length_error("too many unknowns for a Jacobian"),
        unknowns(all),
        states(of_first_order) {}
  std::size_t unknowns, states;  ///< as in Spending
};

/// What a `step` has spent since it began.
struct Spending {
  long evaluations = 0;            ///< of rates and events
  long factorisations = 0;         ///< of the Jacobian
  std::size_t unknowns = 0;        ///< at present
  std::size_t states = 0;          ///< of them, states of first order: bristles of contacts
  bool too_many_unknowns = false;  ///< one factorisation would take more than `most_work`
};

/// Unknowns: y = (u_1, v_1, u_2, v_2, ..., s_1, s_2, ...), u the tangent coordinates of
/// q = origin (+) u, so that an orientation moves on its group and y' is an ordinary equation
/// (Munthe-Kaas 1999). Coordinate by coordinate, which makes the Jacobian a band where groups of
/// them are independent. s are the states of first order that evolve until the next event; those of
/// contacts in the air, most of a robot's, are not worth a column of the Jacobian. Each call
/// of `step` restarts from (q, v): inputs may have jumped there, and a run that is saved and
/// resumed continues bit for bit (docs/decisions/0010). Time is counted from the step's start.
class AdaptiveStepper : public Stepper {
 public:
  /// `most`: Tolerances::most_evaluations. `factorises`: whether the method solves linear systems
  /// with the Jacobian; TooManyUnknowns where the system has too many for that.
  AdaptiveStepper(const HybridSystem& system, long most, bool factorises);
  /// `system` is a HybridSystem: std::bad_cast for another.
  Status step(System& system, double t, double dt, std::span<double> q, std::span<double> v) final;

  // For the library's callbacks, at `time` since the step's start [s]; y and the results have
  // `unknowns()` and `event_count()` numbers. False when a rate is not finite: a shorter step may
  // help.
  bool rates(double time, const double* y, double* rate);
  /// Rates without contact and kinematics, and those of contact and kinematics: the two parts of an
  /// implicit-explicit method.
  bool explicit_rates(double time, const double* y, double* rate);
  bool implicit_rates(double time, const double* y, double* rate);
  void event_values(double time, const double* y, double* values);
  /// Whether this step has used up its evaluations or its work: the library gets no further rate.
  bool spent() const;
  Spending spending() const;

 protected:
  /// Of the whole interval: a step that should be shorter still is given up.
  static constexpr double least_step = 1e-12;
  /// Of one internal step in a row. After an event the first may be tried with a length of before
  /// it, and at the pace at which the libraries shorten a step, to 0.3 of it or less, their own
  /// limit of 7 lies far above `least_step`, which is what shall decide: 0.3^40 < 1e-20.
  static constexpr int most_rejections = 40;

  /// How an internal step ended.
  struct Arrival {
    enum class Kind { inside, at_end, event, failed };
    Kind kind = Kind::failed;
    double time = 0.;  ///< reached, since the step's start [s]
  };
  /// Restarts at `time` with the y of `unknowns_`, which may have become more or fewer, not to
  /// go beyond `end`. False where the library refuses.
  virtual bool begin(double time, double end) = 0;
  /// Takes one internal step, leaving y in `unknowns_` and, of an event, `directions_`.
  virtual Arrival advance(double end) = 0;
  /// Writes y at `time` [s] on the way of the internal step just taken, by the method's
  /// interpolant. False where the library refuses.
  virtual bool interpolate(double time, std::span<double> y) = 0;
  /// Adds what the library counted since the last `begin` to the statistics.
  virtual void count() = 0;
  /// Factorisations of the Jacobian since the last `begin`.
  virtual long factorisations() const { return 0; }

  /// Half the Jacobian's bandwidth; unknowns - 1 or more when it is full.
  std::size_t band() const;

  std::vector<double> unknowns_;  ///< never moves in memory
  std::vector<int> directions_;   ///< of each event function, where one has changed sign: -1, 0, 1

 private:
  void start_from(std::span<const double> q, std::span<const double> v);
  /// Multiplications of one factorisation with the present unknowns.
  double factorisation_work() const;
  bool has_too_many_unknowns() const { return factorisation_work() > most_work; }
  /// `begin`, unless there are too many unknowns for the method.
  Status begin_within_budget(double time, double end);
  void read(const double* y);
  /// y of tangent coordinates and velocities, or of their rates.
  void write(std::span<const double> u, std::span<const double> v, double* y) const;
  bool write_rates(Status status, std::span<const double> u_rate, std::span<const double> v_rate,
                   double* rate);
  Status integrate(double dt);
  Status why_failed() const;
  bool integrate_on_the_way(double from, double to);

  std::size_t dofs_, block_;         ///< HybridSystem::dof_count, jacobian_block
  long most_evaluations_;            ///< of a `step`
  std::vector<std::size_t> active_;  ///< of the states of first order
  HybridSystem* system_ = nullptr;   ///< during `step`
  double start_ = 0.;                ///< time of the step's start [s]
  bool at_start_ = false;            ///< the next rates are those that Stage::first gave
  bool lost_ = false;                ///< the latest rates are not finite
  long evaluations_ = 0;             ///< of this `step`
  bool factorises_;
  double evaluation_work_;           ///< multiplications of one evaluation
  long earlier_factorisations_ = 0;  ///< of this `step`, before the last `begin`
  double earlier_work_ = 0.;         ///< their multiplications
  std::vector<double> origin_, q_, u_, v_, u_rate_, v_rate_, other_rate_, zero_, first_;
  std::vector<double> between_;  ///< y on the way of an internal step
};

}  // namespace hookpoint::integrators
