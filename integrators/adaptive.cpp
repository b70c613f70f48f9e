#include "integrators/adaptive.h"

#include <algorithm>

namespace hookpoint::integrators {
namespace {

/// Multiplications of an evaluation for each number of the system: kinematics, terrain, law. From
/// robots of 200 to 30,000 numbers, whose evaluations take 1 to 5 ns a number.
constexpr double work_per_number = 5.;

}  // namespace

AdaptiveStepper::AdaptiveStepper(const HybridSystem& system, long most, bool factorises)
    : directions_(system.event_count()),
      dofs_(system.dof_count()),
      block_(system.jacobian_block()),
      most_evaluations_(most),
      factorises_(factorises),
      evaluation_work_(work_per_number *
                       static_cast<double>(system.position_size() + system.velocity_size() +
                                           system.event_count())),
      origin_(system.position_size()),
      q_(system.position_size()) {
  const std::size_t velocities = system.velocity_size();
  for (std::vector<double>* numbers : {&u_, &v_, &u_rate_, &v_rate_, &other_rate_, &zero_, &first_})
    numbers->resize(velocities);
  between_.resize(velocities + dofs_);
  unknowns_.reserve(velocities + dofs_);
  for (std::size_t i = dofs_; i < velocities; ++i)
    if (system.is_active_state(i)) active_.push_back(i);
  unknowns_.resize(2 * dofs_ + active_.size());
  if (has_too_many_unknowns()) throw TooManyUnknowns(unknowns_.size(), active_.size());
}

// LU without pivots' cost: n^3/3 of a full matrix, n half (half + 1) of a band.
double AdaptiveStepper::factorisation_work() const {
  if (!factorises_) return 0.;
  const auto size = static_cast<double>(unknowns_.size()), half = static_cast<double>(band());
  return 2. * half + 1. >= size ? size * size * size / 3. : size * half * (half + 1.);
}

bool AdaptiveStepper::spent() const {
  return evaluations_ > most_evaluations_ ||
         evaluation_work_ * static_cast<double>(evaluations_) + earlier_work_ +
                 factorisation_work() * static_cast<double>(factorisations()) >
             most_work;
}

Spending AdaptiveStepper::spending() const {
  const bool refused = has_too_many_unknowns();
  return {evaluations_, earlier_factorisations_ + (refused ? 0 : factorisations()),
          unknowns_.size(), active_.size(), refused};
}

std::size_t AdaptiveStepper::band() const {
  return active_.empty() ? 2 * block_ - 1 : unknowns_.size();
}

Status AdaptiveStepper::step(System& system, double t, double dt, std::span<double> q,
                             std::span<double> v) {
  const Status status = evaluate(system, Stage::first, t, q, v, first_);
  if (status != Status::ok) return status;
  system_ = &dynamic_cast<HybridSystem&>(system);
  start_ = t;
  at_start_ = true;
  lost_ = false;
  evaluations_ = 0;
  earlier_factorisations_ = 0;
  earlier_work_ = 0.;
  start_from(q, v);
  const Status reached = integrate(dt);
  if (reached != Status::ok) return reached;
  read(unknowns_.data());
  return accept(q_, v_, q, v);
}

// Two nodes of Gauss: exact for cubics.
bool AdaptiveStepper::integrate_on_the_way(double from, double to) {
  if (!system_->has_integrals()) return true;
  constexpr double node = 0.28867513459481287;  // 1/sqrt(12)
  const double middle = 0.5 * (from + to), length = to - from;
  for (const double sign : {-1., 1.}) {
    if (!interpolate(middle + sign * node * length, std::span(between_).first(unknowns_.size())))
      return false;
    read(between_.data());
    system_->weigh_at(0.5 * length, q_, v_);
  }
  return true;
}

Status AdaptiveStepper::integrate(double dt) {
  double reached = 0.;
  if (const Status begun = begin_within_budget(0., dt); begun != Status::ok) return begun;
  while (true) {
    const Arrival arrival = advance(dt);
    if (arrival.kind == Arrival::Kind::failed) {
      count();
      return why_failed();
    }
    if (!integrate_on_the_way(reached, arrival.time)) {
      count();
      return Status::no_step;
    }
    reached = arrival.time;
    const bool event = arrival.kind == Arrival::Kind::event;
    const bool over = arrival.kind == Arrival::Kind::at_end || dt - arrival.time <= least_step * dt;
    if (event) ++statistics_.events;
    // The caller commits the end of the whole. An event there is committed and crossed here: the
    // next step begins at its zero, where nothing tells any more which way it went.
    if (event || !over) {
      read(unknowns_.data());
      system_->commit(start_ + arrival.time, q_, v_);
    }
    if (event) system_->cross_events(directions_);
    if (over) {
      count();
      return Status::ok;
    }
    ++statistics_.steps;  // `accept` counts the last
    if (event || system_->chart_exhausted(u_)) {
      count();
      if (event) system_->reinitialize(v_);
      const long solved = factorisations();
      earlier_factorisations_ += solved;
      earlier_work_ += factorisation_work() * static_cast<double>(solved);
      start_from(q_, v_);
      const Status begun = begin_within_budget(arrival.time, dt);
      if (begun != Status::ok) return begun;
    }
  }
}

Status AdaptiveStepper::begin_within_budget(double time, double end) {
  if (has_too_many_unknowns()) return Status::too_long;
  return begin(time, end) ? Status::ok : Status::no_step;
}

Status AdaptiveStepper::why_failed() const {
  if (spent()) return Status::too_long;
  return lost_ ? Status::not_finite : Status::no_step;
}

void AdaptiveStepper::start_from(std::span<const double> q, std::span<const double> v) {
  std::copy(q.begin(), q.end(), origin_.begin());
  std::copy(v.begin(), v.end(), v_.begin());
  std::ranges::fill(u_, 0.);
  active_.clear();
  for (std::size_t i = dofs_; i < v.size(); ++i)
    if (system_->is_active_state(i)) active_.push_back(i);
  unknowns_.resize(2 * dofs_ + active_.size());
  write(u_, v_, unknowns_.data());
}

void AdaptiveStepper::read(const double* y) {
  for (std::size_t i = 0; i < dofs_; ++i) {
    u_[i] = y[2 * i];
    v_[i] = y[2 * i + 1];
  }
  for (std::size_t i = 0; i < active_.size(); ++i) v_[active_[i]] = y[2 * dofs_ + i];
  system_->retract(origin_, u_, q_);
}

void AdaptiveStepper::write(std::span<const double> u, std::span<const double> v, double* y) const {
  for (std::size_t i = 0; i < dofs_; ++i) {
    y[2 * i] = u[i];
    y[2 * i + 1] = v[i];
  }
  for (std::size_t i = 0; i < active_.size(); ++i) y[2 * dofs_ + i] = v[active_[i]];
}

bool AdaptiveStepper::write_rates(Status status, std::span<const double> u_rate,
                                  std::span<const double> v_rate, double* rate) {
  write(u_rate, v_rate, rate);
  lost_ = status != Status::ok;
  return !lost_;
}

bool AdaptiveStepper::rates(double time, const double* y, double* rate) {
  ++evaluations_;
  read(y);
  system_->tangent_rate(u_, v_, u_rate_);
  if (at_start_) {
    at_start_ = false;
    return write_rates(Status::ok, u_rate_, first_, rate);
  }
  const Status status = evaluate(*system_, Stage::trial, start_ + time, q_, v_, v_rate_);
  return write_rates(status, u_rate_, v_rate_, rate);
}

bool AdaptiveStepper::explicit_rates(double time, const double* y, double* rate) {
  read(y);
  evaluations_ += 2;
  statistics_.evaluations += 2;
  const Status status = system_->split_accelerations(start_ + time, q_, v_, v_rate_, other_rate_);
  return write_rates(status, zero_, v_rate_, rate);
}

bool AdaptiveStepper::implicit_rates(double time, const double* y, double* rate) {
  read(y);
  system_->tangent_rate(u_, v_, u_rate_);
  evaluations_ += 2;
  statistics_.evaluations += 2;
  const Status status = system_->split_accelerations(start_ + time, q_, v_, other_rate_, v_rate_);
  return write_rates(status, u_rate_, v_rate_, rate);
}

void AdaptiveStepper::event_values(double time, const double* y, double* values) {
  ++evaluations_;
  read(y);
  system_->event_values(start_ + time, q_, v_, {values, system_->event_count()});
}

}  // namespace hookpoint::integrators
