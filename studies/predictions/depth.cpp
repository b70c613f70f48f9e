// The closed forms of how deep a robot stands in its ground, and how deep it falls into it.
#include <algorithm>
#include <cmath>

#include "studies/body_on_plane.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

/// Whether depth is proportional to load: the equations of `footprint_depths` are linear then.
bool linear_normal_force(const BodyOnPlane& body) {
  const double load = body.normal_load();
  const double once = contact::static_depth(*body.law, load, body.material);
  const double twice = contact::static_depth(*body.law, 2. * load, body.material);
  return std::abs(twice - 2. * once) <= 1e-12 * once;
}

/// Depth under the mean load of a touching point.
double mean_depth(const BodyOnPlane& body, std::optional<double> softness) {
  return body.law ? contact::static_depth(*body.law, body.normal_load(), body.material)
                  : *softness * body.normal_load();
}

/// Depths of the touching points: a rigid footprint on equal springs k that carries N and the
/// moment of the friction F about the centre of mass, d_i = a + b x_i + c y_i with sum k d_i = N,
/// sum k d_i x_i = F h (x downhill), sum k d_i y_i = 0. Empty when a point would lift, or when the
/// springs are not linear.
std::vector<double> footprint_depths(const RunContext& context, const BodyOnPlane& body,
                                     std::optional<double> softness) {
  const double depth = mean_depth(body, softness);
  if (body.single_point) return {depth};
  if (body.footprint.size() < 3 || (body.law && !linear_normal_force(body))) return {};
  const double stiffness = body.normal_load() / depth;
  const Vector3d across = cross(context.normal, context.downhill);
  Symmetric3d sums;
  for (const Vector3d& point : body.footprint) {
    const double x = dot(point, context.downhill), y = dot(point, across);
    sums += Symmetric3d{1., x * x, y * y, x, y, x * y};
  }
  const double moment = body.friction_load() * body.contacts() * body.height;
  const Vector3d plane =
      (1. / stiffness) *
      (inverse(sums) * Vector3d{body.normal_load() * body.contacts(), moment, 0.});
  // A plane holds its base against rolling, with moments of its own.
  constexpr double even = 1e-9;
  if (context.robot_spec().plane_normal && std::abs(plane.z) * body.height > even * plane.x)
    return {};
  std::vector<double> depths;
  for (const Vector3d& point : body.footprint) {
    depths.push_back(plane.x + plane.y * dot(point, context.downhill) +
                     plane.z * dot(point, across));
    if (!(depths.back() > 0.)) return {};
  }
  return depths;
}

/// Where a mass m that falls through `gap` onto a spring k and damper c first comes to rest: the
/// first zero of d' in m d'' = m g - k d - c d', d(0) = 0, d'(0) = sqrt(2 g gap). `depth` is m g/k,
/// `decay` c/(2 m). Nothing for a damper that does not let it swing.
std::optional<double> greatest_depth(double gravity, double gap, double depth, double decay) {
  const double square = gravity / depth - decay * decay;
  if (!(square > 0.)) return std::nullopt;
  const double frequency = std::sqrt(square), speed = std::sqrt(2. * gravity * gap);
  // d' = exp(-decay t) (speed cos + (g - decay speed)/frequency sin), with the first zero in (0,
  // pi].
  const double phase = std::atan2(speed * frequency, decay * speed - gravity);
  const double sway = (speed - decay * depth) / frequency;
  return depth +
         std::exp(-decay * phase / frequency) * (sway * std::sin(phase) - depth * std::cos(phase));
}

/// The damper of one touching point [N s/m], where the law has one that does not depend on the
/// load.
std::optional<double> linear_damping(const BodyOnPlane& body) {
  if (!body.law) return body.material.normal_damping;
  const auto damping = [&](double load) {
    return contact::linearise(*body.law, load, body.material).normal_damping;
  };
  const double once = damping(body.normal_load()), twice = damping(2. * body.normal_load());
  return once == twice ? std::optional(once) : std::nullopt;
}

}  // namespace

std::optional<double> penetration(std::string_view metric, const RunContext& context,
                                  std::optional<double> softness) {
  if (!one_rigid_body(context) && !stands_as_one_body(context)) return std::nullopt;
  const BodyOnPlane body = body_on_plane(context);
  if (body.peer && (!softness || !body.level() || body.speed > 0.)) return std::nullopt;
  if (!body.peer && !body.law) return 0.;
  const std::vector<double> depths = footprint_depths(context, body, softness);
  if (depths.empty()) return std::nullopt;
  const auto [least, greatest] = std::minmax_element(depths.begin(), depths.end());
  if (context.settle == 0. && body.level() && body.speed == 0.) {
    const std::optional<double> damping = linear_damping(body);
    const bool swings = metric == "penetration_max" && damping &&
                        *greatest - *least <= 1e-9 * *greatest &&
                        (!body.peer || context.experiment->settings == "matched");
    if (!swings) return std::nullopt;
    return greatest_depth(body.gravity, std::max(0., body.gap), *greatest,
                          *damping * body.contacts() / (2. * body.mass));
  }
  if (metric == "penetration_max") return *greatest;
  double sum = 0., squares = 0.;
  for (const double depth : depths) {
    sum += depth;
    squares += depth * depth;
  }
  const double count = body.contacts();
  return metric == "penetration_mean" ? sum / count : std::sqrt(squares / count);
}

}  // namespace hookpoint::studies
