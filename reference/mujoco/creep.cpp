#include "reference/mujoco/creep.h"

#include <algorithm>
#include <cmath>

#include "reference/mujoco/engine.h"
#include "reference/mujoco/friction.h"
#include "reference/mujoco/settings.h"
#include "reference/resting_body.h"
#include "reference/static_depth.h"
#include "reference/steady_creep.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::reference {
namespace {

/// A body at rest on a plane, of which each contact carries the same friction.
struct Load {
  double inverse_weight = 0.;           ///< A [1/kg]
  double normal = 0., tangential = 0.;  ///< of a contact, in the mean [N]
  /// Least and largest normal load of a contact over the mean one.
  double least = 1., largest = 1.;
  double along = 0., across = 0.;  ///< parts of the pull along the two tangents, as magnitudes
  double turned = 0.;              ///< the product of the two with their signs
  double friction = 0.;            ///< mu
};

/// Rows of a pyramid at rest carry f = max(0, q -+ w) for a depth q and a speed w along each
/// tangent, in units of the mean normal load.
struct Pyramid {
  double depth = 0., along = 0., across = 0.;
};

/// Opposite rows carry a load t = f_t/mu together: both while t <= 2 q, and then w = t/2; else the
/// one that is left, and w = t - q. All rows together carry 1.
std::optional<Pyramid> pyramid_at_rest(double t, double u, double least, double largest) {
  if (t + u >= 1.) return std::nullopt;  // beyond the pyramid
  const double q = std::min(0.25, 0.5 * (1. - std::max(t, u)));
  const auto speed = [q](double load) { return load <= 2. * q ? 0.5 * load : load - q; };
  const Pyramid mean{q, speed(t), speed(u)};
  // A contact with another normal load has another depth: rows each way carry max(2 q, q + w). The
  // mean is the mean of all only if the same rows carry everywhere.
  const int lost = (mean.along > q ? 1 : 0) + (mean.across > q ? 1 : 0);
  for (const double normal : {least, largest}) {
    const double depth = q + (normal - 1.) / (4. - lost);
    if (!(depth > 0.) || (mean.along > q) != (mean.along > depth) ||
        (mean.across > q) != (mean.across > depth))
      return std::nullopt;
  }
  return mean;
}

/// The impedance at a depth (XML reference, solimp).
double impedance_at(const std::array<double, 5>& solimp, double depth) {
  const auto [at_surface, at_width, width, midpoint, power] = solimp;
  if (at_surface == at_width || width <= 0.) return at_surface;
  const double x = std::min(1., depth / width);
  const double y = x <= midpoint
                       ? midpoint * std::pow(x / midpoint, power)
                       : 1. - (1. - midpoint) * std::pow((1. - x) / (1. - midpoint), power);
  return at_surface + y * (at_width - at_surface);
}

struct Reference {
  double stiffness, damping;  ///< K [1/s^2], B [1/s]
};
Reference reference_of(const MujocoRow& row, double dt) {
  const double d = row.impedance[1];
  if (row.reference[0] < 0.) return {-row.reference[0] / (d * d), -row.reference[1] / d};
  const double time = std::max(row.reference[0], 2. * dt) * d;
  return {1. / (time * time * row.reference[1] * row.reference[1]), 2. / time};
}

/// Velocity at impedance `d`, and the depth at which the normal load is carried.
struct Rest {
  simulation::CreepVelocity velocity;
  double depth;
};
simulation::ClosedForm<Rest> rest(const Load& load, const MujocoSettings& settings,
                                  const Reference& reference, double d) {
  const double softness = (1. - d) / d * load.inverse_weight;
  const double mu = load.friction;
  if (settings.elliptic) {
    if (load.tangential > mu * load.least * load.normal) return point_at_limit;
    return Rest{{softness / settings.friction_impedance * load.tangential / reference.damping, 0.},
                softness * load.normal / (reference.stiffness * d)};
  }
  const double row = 2. * mu * mu / settings.friction_impedance * (1. + mu * mu) * softness;
  const double part = load.tangential / (mu * load.normal);
  const auto pyramid =
      pyramid_at_rest(part * load.along, part * load.across, load.least, load.largest);
  if (!pyramid)
    return simulation::NoClosedForm{
        "a contact of MuJoCo's pyramid slips, or lacks a row that another one has"};
  // With downhill = a first + b second, sideways is a second - b first, and the speed along each
  // tangent has the sign of a or b.
  const double speed = row * load.normal / (reference.damping * mu);
  const double downhill = pyramid->along * load.along + pyramid->across * load.across;
  const double sideways = pyramid->across * load.along - pyramid->along * load.across;
  return Rest{{speed * downhill, load.turned < 0. ? -speed * sideways : speed * sideways},
              pyramid->depth * row * load.normal / (reference.stiffness * d)};
}

/// Least and largest normal load, under the moment of the friction.
void spread(const RestingBody& body, const Vector3d& loads, Load& load) {
  for (const Vector3d& arm : body.arms) {
    const double part = load_at(body, loads, arm) / load.normal;
    load.least = std::min(load.least, part);
    load.largest = std::max(load.largest, part);
  }
}

simulation::ClosedForm<Load> load_at_rest(const simulation::Experiment& experiment) {
  const auto body = resting_body(experiment);
  const double friction = single_friction(ground_material(experiment));
  if (!body) return body.none();
  if (!(body->press > 0.))
    return simulation::NoClosedForm{"nothing presses the body on its ground"};
  if (!(friction > 0.)) return simulation::NoClosedForm{"the ground has no friction"};
  const auto loads = normal_loads(*body, body->pull);
  if (!loads) return loads.none();
  Load load;
  const auto count = static_cast<double>(body->arms.size());
  load.inverse_weight = 1. / body->mass->mass;
  load.normal = body->press / count;
  load.tangential = body->pull / count;
  load.friction = friction;
  const auto [first, second] = mujoco_tangents(body->normal);
  load.along = std::abs(dot(body->downhill, first));
  load.across = std::abs(dot(body->downhill, second));
  load.turned = dot(body->downhill, first) * dot(body->downhill, second);
  spread(*body, *loads, load);
  return load;
}

double mass_of(const simulation::Experiment& experiment) {
  double mass = 0.;
  for (const simulation::RobotSpec& robot : experiment.robots)
    mass += simulation::robot_mass(robot);
  return mass;
}

/// Whether MuJoCo keeps to the spring: its rows' softness against the inverse weight of a contact,
/// which is that of all mass at least.
bool mujoco_keeps_spring(const simulation::Experiment& experiment) {
  const auto material = ground_material(experiment);
  const MujocoSettings settings = mujoco_settings(Settings::matched, experiment.deltat, material);
  const double softness =
      1. / (experiment.deltat *
            (material.normal_damping + experiment.deltat * material.normal_stiffness));
  const double inverse_weight = 1. / mass_of(experiment);
  const MujocoRow row = mujoco_row(settings, experiment.deltat, material, inverse_weight);
  return row.impedance[0] == inverse_weight / (inverse_weight + softness);
}

}  // namespace

simulation::ClosedForm<simulation::CreepVelocity> mujoco_creep(
    const simulation::Experiment& experiment) {
  const auto load = load_at_rest(experiment);
  if (!load) return load.none();
  const auto material = ground_material(experiment);
  const MujocoSettings settings =
      mujoco_settings(settings_of(experiment, mujoco_peer), experiment.deltat, material);
  if (settings.no_slip_iterations > 0)
    return simulation::NoClosedForm{"MuJoCo's no-slip iterations end before they converge"};
  const MujocoRow row = mujoco_row(settings, experiment.deltat, material, load->inverse_weight);
  const Reference reference = reference_of(row, experiment.deltat);
  double depth = 0.;
  simulation::CreepVelocity velocity;
  for (int i = 0; i < 20; ++i) {  // d changes by a few percent with depth: each turn gains a digit
    const auto found = rest(*load, settings, reference, impedance_at(row.impedance, depth));
    if (!found) return found.none();
    depth = found->depth;
    velocity = found->velocity;
  }
  return velocity;
}

simulation::ClosedForm<double> mujoco_softness(const simulation::Experiment& experiment) {
  if (settings_of(experiment, mujoco_peer) == Settings::matched && !mujoco_keeps_spring(experiment))
    return simulation::NoClosedForm{
        "MuJoCo's impedance is cut off at a bound: its contact is softer than the material"};
  return matched_softness(experiment);
}

}  // namespace hookpoint::reference
