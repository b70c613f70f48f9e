// Metrics of the body's motion: displacement fits, stopping, direction, energy.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "studies/measure/metric.h"
#include "studies/metrics/table.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

double downhill(const RunContext&, const Observation& observation) {
  return observation.displacement;
}
double sideways(const RunContext& context, const Observation& observation) {
  return dot(observation.body.position - context.start, cross(context.normal, context.downhill));
}

/// Least-squares fit of a displacement s(t) by a polynomial, one sample at a time. Time runs over
/// [-1, 1] and s from its first sample, so that the sums stay well conditioned.
class DisplacementFit : public Metric {
 public:
  explicit DisplacementFit(const RunContext& context,
                           double (*displacement)(const RunContext&, const Observation&) = downhill)
      : context_(context),
        displacement_(displacement),
        middle_(0.5 * (context.settle + context.duration)),
        half_(0.5 * (context.duration - context.settle)) {}

  void observe(const Observation& observation) override {
    if (!settled(context_, observation)) return;
    const double now = displacement_(context_, observation);
    if (count_ == 0) first_ = now;
    const double tau = (observation.world.time - middle_) / half_;
    const double s = now - first_;
    ++count_;
    double power = 1.;
    for (int k = 0; k <= 4; ++k, power *= tau) {
      time_sums_[k] += power;
      if (k <= 2) sums_[k] += s * power;
    }
  }

 protected:
  /// ds/dt of the best line.
  std::optional<double> slope() const {
    if (count_ < 2) return std::nullopt;
    const double n = time_sums_[0];
    const double determinant = n * time_sums_[2] - time_sums_[1] * time_sums_[1];
    return (n * sums_[1] - time_sums_[1] * sums_[0]) / determinant / half_;
  }
  /// d2s/dt2 of the best parabola: the normal equations solved by a symmetric 3x3 inverse.
  std::optional<double> curvature() const {
    if (count_ < 3) return std::nullopt;
    const Symmetric3d normal_matrix{time_sums_[0], time_sums_[2], time_sums_[4],
                                    time_sums_[1], time_sums_[2], time_sums_[3]};
    const Vector3d coefficients = inverse(normal_matrix) * Vector3d{sums_[0], sums_[1], sums_[2]};
    return 2. * coefficients.z / (half_ * half_);
  }

 private:
  const RunContext& context_;
  double (*displacement_)(const RunContext&, const Observation&);
  double middle_, half_, first_ = 0.;
  long count_ = 0;
  double time_sums_[5] = {}, sums_[3] = {};
};

class CreepSpeed : public DisplacementFit {
 public:
  using DisplacementFit::DisplacementFit;
  std::optional<double> value() const override { return slope(); }
};

class SlipAcceleration : public DisplacementFit {
 public:
  using DisplacementFit::DisplacementFit;
  std::optional<double> value() const override { return curvature(); }
};

/// Along downhill m a = m g_t - F, along the normal N = m g_n: friction is F/N.
class Friction : public DisplacementFit {
 public:
  explicit Friction(const RunContext& context)
      : DisplacementFit(context),
        pull_(dot(context.experiment->gravity, context.downhill)),
        load_(-dot(context.experiment->gravity, context.normal)),
        applies_(context.ground && load_ > 0. &&
                 std::ranges::none_of(
                     context.experiment->forces,
                     [&](const simulation::ForceSpec& f) { return f.robot == context.robot; })) {}
  std::optional<double> value() const override {
    const std::optional<double> acceleration = curvature();
    if (!applies_ || !acceleration) return std::nullopt;
    return (pull_ - *acceleration) / load_;
  }

 private:
  double pull_, load_;  // of gravity [m/s^2]
  bool applies_;
};

class SettleShift : public Metric {
 public:
  explicit SettleShift(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    if (!shift_ && settled(context_, observation)) shift_ = observation.displacement;
  }
  std::optional<double> value() const override { return shift_; }

 private:
  const RunContext& context_;
  std::optional<double> shift_;
};

class StoppingDistance : public Metric {
 public:
  explicit StoppingDistance(const RunContext&) {}
  void observe(const Observation& observation) override {
    displacement_ = observation.displacement;
    speed_ = norm(observation.body.velocity);
  }
  std::optional<double> value() const override {
    return speed_ < onset_speed ? std::optional(displacement_) : std::nullopt;
  }

 private:
  double displacement_ = 0., speed_ = 0.;
};

class DirectionError : public Metric {
 public:
  static constexpr double least_path = 1e-3;  ///< [m]: under it the direction is noise
  explicit DirectionError(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    if (!settled(context_, observation)) return;
    if (!from_) from_ = observation.body.position;
    path_ = tangential(observation.body.position - *from_, context_.normal);
  }
  std::optional<double> value() const override {
    if (norm(path_) < least_path) return std::nullopt;
    const Vector3d across = cross(context_.normal, context_.downhill);
    return std::abs(std::atan2(dot(path_, across), dot(path_, context_.downhill)));
  }

 private:
  const RunContext& context_;
  std::optional<Vector3d> from_;
  Vector3d path_;
};

class EnergyGain : public Metric {
 public:
  explicit EnergyGain(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    const double energy = mechanical_energy(context_, observation.world);
    if (!start_) start_ = energy;
    gain_ = std::max(gain_, energy - *start_);
  }
  std::optional<double> value() const override { return gain_; }

 private:
  const RunContext& context_;
  std::optional<double> start_;
  double gain_ = 0.;
};

class SpinMax : public Metric {
 public:
  explicit SpinMax(const RunContext& context) : context_(context) {}
  void observe(const Observation& observation) override {
    if (settled(context_, observation))
      greatest_ = std::max(greatest_, norm(observation.body.angular_velocity));
  }
  std::optional<double> value() const override { return greatest_; }

 private:
  const RunContext& context_;
  double greatest_ = 0.;
};

std::unique_ptr<Metric> make_creep_speed(const RunContext& context) {
  return std::make_unique<CreepSpeed>(context);
}
std::unique_ptr<Metric> make_creep_sideways(const RunContext& context) {
  return std::make_unique<CreepSpeed>(context, sideways);
}
std::unique_ptr<Metric> make_slip_acceleration(const RunContext& context) {
  return std::make_unique<SlipAcceleration>(context);
}
std::unique_ptr<Metric> make_friction(const RunContext& context) {
  return std::make_unique<Friction>(context);
}
std::unique_ptr<Metric> make_settle_shift(const RunContext& context) {
  return std::make_unique<SettleShift>(context);
}
std::unique_ptr<Metric> make_stopping_distance(const RunContext& context) {
  return std::make_unique<StoppingDistance>(context);
}
std::unique_ptr<Metric> make_direction_error(const RunContext& context) {
  return std::make_unique<DirectionError>(context);
}
std::unique_ptr<Metric> make_energy_gain(const RunContext& context) {
  return std::make_unique<EnergyGain>(context);
}
std::unique_ptr<Metric> make_spin_max(const RunContext& context) {
  return std::make_unique<SpinMax>(context);
}

}  // namespace

std::span<const MetricDefinition> motion_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "creep_speed",
       .unit = "m/s",
       .doc = "least-squares slope of the downhill displacement over [settle, duration]",
       .make = make_creep_speed,
       .predict = predicted::creep_speed,
       .regime = Regime::holds},
      {.name = "creep_sideways",
       .unit = "m/s",
       .doc = "the same of the displacement across the fall, along normal x downhill",
       .make = make_creep_sideways,
       .predict = predicted::creep_sideways,
       .regime = Regime::holds},
      {.name = "slip_acceleration",
       .unit = "m/s^2",
       .doc = "least-squares parabola of the same: its second derivative",
       .make = make_slip_acceleration,
       .predict = predicted::slip_acceleration,
       .regime = Regime::slides},
      {.name = "friction",
       .unit = "",
       .doc =
           "force of the ground against the motion downhill over that along its normal, from the motion: (g_t - slip_acceleration)/g_n; nothing under external forces",
       .make = make_friction,
       .predict = predicted::friction,
       .regime = Regime::slides},
      {.name = "anisotropy",
       .unit = "",
       .doc =
           "greatest over least friction of the runs that differ in the swept direction alone, less 1",
       .make = make_friction,
       .predict = predicted::anisotropy,
       .regime = Regime::slides,
       .scope = MetricScope::sweep},
      {.name = "settle_shift",
       .unit = "m",
       .doc = "downhill displacement at `settle`",
       .make = make_settle_shift},
      {.name = "stopping_distance",
       .unit = "m",
       .doc = "displacement at the end, if the body rests then",
       .make = make_stopping_distance,
       .predict = predicted::stopping_distance},
      {.name = "direction_error",
       .unit = "rad",
       .doc = "angle between the displacement after `settle` and downhill",
       .make = make_direction_error,
       .predict = predicted::direction_error,
       .regime = Regime::slides},
      {.name = "energy_gain",
       .unit = "J",
       .doc = "greatest rise of kinetic and gravitational energy above the start's",
       .make = make_energy_gain},
      {.name = "spin_max",
       .unit = "rad/s",
       .doc = "greatest angular speed of the body after `settle`",
       .make = make_spin_max},
  });
  return rows;
}

}  // namespace hookpoint::studies
