#include "studies/measurements/trace_residual.h"

#include <cmath>

#include "math/rotation.h"

namespace hookpoint::studies {
namespace {

Quaterniond quaternion_of(const double* parts) {
  return normalized(Quaterniond{parts[0], parts[1], parts[2], parts[3]});
}

/// The rotation vector u with exponential(u) = +-q, |u| <= pi.
Vector3d rotation_vector(const Quaterniond& q) {
  const double sign = q.w < 0. ? -1. : 1.;
  const Vector3d axis{sign * q.x, sign * q.y, sign * q.z};
  const double sine = std::sqrt(dot(axis, axis));
  if (sine == 0.) return {};
  return (2. * std::atan2(sine, sign * q.w) / sine) * axis;
}

}  // namespace

void set_residuals(const TracePlan& trace, std::size_t sample, std::span<const double> model,
                   std::span<double> residuals) {
  const std::size_t samples = trace.measured.time.size();
  const double* measured = trace.measured.sample(sample);
  if (!trace.is_orientation()) {
    for (std::size_t i = 0; i < model.size(); ++i)
      residuals[i * samples + sample] = trace.weight * (model[i] - measured[i]);
    return;
  }
  const Vector3d turn =
      rotation_vector(quaternion_of(model.data()) * conjugate(quaternion_of(measured)));
  residuals[sample] = trace.weight * turn.x;
  residuals[samples + sample] = trace.weight * turn.y;
  residuals[2 * samples + sample] = trace.weight * turn.z;
}

std::span<const double> residuals_of(std::span<const double> all, const TracePlan& trace,
                                     std::size_t first) {
  if (all.empty() || std::isnan(all[first])) return {};
  return all.subspan(first, trace.residuals());
}

std::vector<double> modelled(const TracePlan& trace, std::size_t sample,
                             std::span<const double> residuals) {
  const std::size_t samples = trace.measured.time.size();
  const double* measured = trace.measured.sample(sample);
  const auto difference = [&](std::size_t i) {
    return residuals[i * samples + sample] / trace.weight;
  };
  if (trace.is_orientation()) {
    const Vector3d turn{difference(0), difference(1), difference(2)};
    const Quaterniond q = exponential(turn) * quaternion_of(measured);
    return {q.w, q.x, q.y, q.z};
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < trace.parts.size(); ++i)
    values.push_back((measured[i] + difference(i)) / trace.unit_of_port);
  return values;
}

std::vector<double> measured(const TracePlan& trace, std::size_t sample) {
  std::vector<double> values;
  for (std::size_t i = 0; i < trace.parts.size(); ++i)
    values.push_back(trace.measured.sample(sample)[i] / trace.unit_of_port);
  return values;
}

double distance(const TracePlan& trace, std::size_t sample, std::span<const double> residuals) {
  const std::size_t samples = trace.measured.time.size();
  double squares = 0.;
  for (std::size_t at = sample; at < residuals.size(); at += samples)
    squares += residuals[at] * residuals[at];
  return std::sqrt(squares);
}

double mean_distance(std::span<const TracePlan> traces, std::span<const double> residuals) {
  double sum = 0.;
  for (const TracePlan& trace : traces) {
    const std::size_t samples = trace.measured.time.size();
    double lengths = 0.;
    for (std::size_t sample = 0; sample < samples; ++sample)
      lengths += distance(trace, sample, residuals.first(trace.residuals()));
    sum += lengths / static_cast<double>(samples);
    residuals = residuals.subspan(trace.residuals());
  }
  return sum / static_cast<double>(traces.size());
}

}  // namespace hookpoint::studies
