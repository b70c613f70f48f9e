// The closed forms of how deep a robot stands in its ground, and how deep it falls into it.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "studies/measure/body_on_plane.h"
#include "studies/predictions/predictions.h"

namespace hookpoint::studies {
namespace {

/// Depths of the touching points: a rigid footprint on equal springs k that carries N and the
/// moment of the friction F about the centre of mass, d_i = a + b x_i + c y_i with sum k d_i = N,
/// sum k d_i x_i = F h (x downhill), sum k d_i y_i = 0.
simulation::ClosedForm<std::vector<double>> footprint_depths(const RunContext& context,
                                                             const BodyOnPlane& body,
                                                             double mean_depth) {
  if (body.footprint.size() > 1 && body.law && !body.linear_normal_force())
    return NoClosedForm{
        "the normal force of " + context.experiment->contact +
        " is not proportional to depth: how several points share a load is unknown"};
  const double moment = body.friction_load() * body.contacts() * body.height;
  const auto loads = body.normal_loads(moment, context.downhill, context.normal);
  if (!loads)
    return NoClosedForm{
        body.uneven ? "the contacts are not level: how they share the load is unknown"
                    : "the body does not stand: a contact would lift, or all lie on one line"};
  const double load = body.normal_load();
  // A plane holds its base against rolling, with moments of its own.
  constexpr double even = 1e-9;
  if (context.robot_spec().plane_normal && std::abs(loads->across) * body.height > even * load)
    return NoClosedForm{"the plane that keeps the robot's base holds it against tilting"};
  std::vector<double> depths;
  for (const double each : loads->at_points) depths.push_back(each / load * mean_depth);
  return depths;
}

/// Where a mass m that falls through `gap` onto a spring k and damper c first comes to rest: the
/// first zero of d' in m d'' = m g - k d - c d', d(0) = 0, d'(0) = sqrt(2 g gap). `depth` is m g/k,
/// `decay` c/(2 m). No closed form for a damper that does not let it swing.
Prediction greatest_depth(double gravity, double gap, double depth, double decay) {
  const double square = gravity / depth - decay * decay;
  if (!(square > 0.)) return NoClosedForm{"the damper does not let the body swing"};
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
    return body.law->linearise(load, body.material).normal_damping;
  };
  const double once = damping(body.normal_load()), twice = damping(2. * body.normal_load());
  return once == twice ? std::optional(once) : std::nullopt;
}

Prediction depth_of_landing(const RunContext& context, const BodyOnPlane& body,
                            const std::vector<double>& depths) {
  const auto [least, greatest] = std::minmax_element(depths.begin(), depths.end());
  if (*greatest - *least > 1e-9 * *greatest)
    return NoClosedForm{"with `settle = 0` the body swings, and its contacts are not equally deep"};
  const std::optional<double> damping = linear_damping(body);
  if (!damping || (body.peer && context.experiment->settings != "matched"))
    return NoClosedForm{
        "with `settle = 0` the body swings, and its contacts are no linear springs and dampers"};
  return greatest_depth(body.gravity, std::max(0., body.gap), *greatest,
                        *damping * body.contacts() / (2. * body.mass));
}

/// What a metric takes of the depths of the points.
enum class DepthOfPoints { greatest, mean, root_mean_square };

Prediction depth_of_points(DepthOfPoints taken, const RunContext& context,
                           const simulation::ClosedForm<double>& softness) {
  if (std::string why = not_resting_as_one_body(context); !why.empty())
    return NoClosedForm{std::move(why)};
  const BodyOnPlane body = body_on_plane(context);
  if (body.peer && !softness) return softness.none();
  if (body.peer && !body.level())
    return NoClosedForm{"depths in other engines are known on level ground alone"};
  if (body.peer && body.speed > 0.) return NoClosedForm{"the body is thrown along the ground"};
  if (!body.peer && !body.law) return 0.;
  const auto depths =
      footprint_depths(context, body,
                       body.law ? body.law->static_depth(body.normal_load(), body.material)
                                : *softness * body.normal_load());
  if (!depths) return depths.none();
  if (context.settle == 0. && body.level() && body.speed == 0. && !body.settled) {
    if (taken != DepthOfPoints::greatest)
      return NoClosedForm{"with `settle = 0` the body's landing counts"};
    return depth_of_landing(context, body, *depths);
  }
  if (taken == DepthOfPoints::greatest) return std::ranges::max(*depths);
  double sum = 0., squares = 0.;
  for (const double depth : *depths) {
    sum += depth;
    squares += depth * depth;
  }
  const double count = body.contacts();
  return taken == DepthOfPoints::mean ? sum / count : std::sqrt(squares / count);
}

}  // namespace

Prediction predicted::penetration_max(const RunContext& context, const PeerContact& peer) {
  return depth_of_points(DepthOfPoints::greatest, context, peer.softness);
}
Prediction predicted::penetration_mean(const RunContext& context, const PeerContact& peer) {
  return depth_of_points(DepthOfPoints::mean, context, peer.softness);
}
Prediction predicted::penetration_rms(const RunContext& context, const PeerContact& peer) {
  return depth_of_points(DepthOfPoints::root_mean_square, context, peer.softness);
}

}  // namespace hookpoint::studies
