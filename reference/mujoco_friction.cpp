#include "reference/mujoco_friction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/experiment_checks.h"
#include "reference/ground.h"
#include "reference/settings.h"
#include "reference/touching_points.h"

namespace hookpoint::reference {
namespace {

/// A contact of a body at rest on a plane.
struct Contact {
  double inverse_weight = 0.;           ///< A [1/kg]
  double normal = 0., tangential = 0.;  ///< loads [N]
  double along = 0., across = 0.;  ///< parts of the tangential direction along the two tangents
  double friction = 0.;            ///< mu
};

/// Where friction holds a load, per unit of normal force: the depth's share q, the same for each
/// row of the pyramid, and the speeds.
struct Pyramid {
  double depth = 0.;               ///< P over sum f, of the rows f = max(0, P - B mu v . t)/R
  double along = 0., across = 0.;  ///< B mu v / R over sum f
};

/// Rows in opposite pairs carry t = f_t/mu each way: both while t < 2 q, then the difference is
/// t = 2 w; else the one that is left carries t = q + w. All rows together carry 1.
std::optional<Pyramid> pyramid_at_rest(double t, double u) {
  const double most = std::max(t, u), least = std::min(t, u);
  const double q = most <= 0.5 ? 0.25 : 0.5 * (1. - most);
  if (least > 2. * q) return std::nullopt;  // beyond the pyramid
  const auto speed = [q](double load) { return load <= 2. * q ? 0.5 * load : load - q; };
  return Pyramid{q, speed(t), speed(u)};
}

/// The impedance at a depth (XML reference, solimp).
double impedance_at(const std::array<double, 5>& solimp, double depth) {
  const auto [d0, width_d, width, midpoint, power] = solimp;
  if (d0 == width_d || width <= 0.) return d0;
  const double x = std::min(1., depth / width);
  const double y = x <= midpoint
                       ? midpoint * std::pow(x / midpoint, power)
                       : 1. - (1. - midpoint) * std::pow((1. - x) / (1. - midpoint), power);
  return d0 + y * (width_d - d0);
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

/// Downhill speed at impedance `d`, and the depth at which the normal load is carried.
struct Rest {
  double speed, depth;
};
std::optional<Rest> rest(const Contact& contact, const MujocoSettings& settings,
                         const Reference& reference, double d) {
  const double softness = (1. - d) / d * contact.inverse_weight;
  if (settings.elliptic) {
    if (contact.tangential > contact.friction * contact.normal) return std::nullopt;
    return Rest{softness / settings.friction_impedance * contact.tangential / reference.damping,
                softness * contact.normal / (reference.stiffness * d)};
  }
  const double mu = contact.friction;
  const double row = 2. * mu * mu / settings.friction_impedance * (1. + mu * mu) * softness;
  const double load = contact.tangential / (mu * contact.normal);
  const auto pyramid =
      pyramid_at_rest(load * std::abs(contact.along), load * std::abs(contact.across));
  if (!pyramid) return std::nullopt;
  const double downhill =
      pyramid->along * std::abs(contact.along) + pyramid->across * std::abs(contact.across);
  return Rest{downhill * row * contact.normal / (reference.damping * mu),
              pyramid->depth * row * contact.normal / (reference.stiffness * d)};
}

/// How many boundary points of the base lie lowest along `normal`.
double footprint(const simulation::RobotSpec& robot, const Vector3d& normal) {
  const auto height = [&](const Vector3d& point) {
    return dot(rotate(robot.orientation, point), normal);
  };
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& point : robot.base.boundary_points) lowest = std::min(lowest, height(point));
  return static_cast<double>(
      std::ranges::count_if(robot.base.boundary_points,
                            [&](const Vector3d& point) { return height(point) - lowest < 1e-6; }));
}

std::optional<Contact> contact_at_rest(const simulation::Experiment& experiment) {
  if (!experiment.terrain || experiment.robots.size() != 1) return std::nullopt;
  const simulation::RobotSpec& robot = experiment.robots[0];
  const Ground ground = ground_of(*experiment.terrain);
  const auto* plane = std::get_if<GroundPlane>(&ground);
  if (plane == nullptr || !robot.chains.empty()) return std::nullopt;
  const double contacts = footprint(robot, plane->normal);
  const auto& shapes = robot.base.shapes;
  // MuJoCo finds the four corners of a box, whatever points are sampled on it.
  const bool box = shapes.size() == 1 && contacts == 4. &&
                   std::holds_alternative<simulation::Box>(shapes[0].geometry);
  if (contacts == 0. || (!touches_by_points(experiment, 0) && !box)) return std::nullopt;

  Contact contact;
  const double mass = robot.base.mass.mass;
  contact.inverse_weight = 1. / mass;
  contact.normal = -dot(experiment.gravity, plane->normal) * mass / contacts;
  const Vector3d pull =
      mass / contacts *
      (experiment.gravity - dot(experiment.gravity, plane->normal) * plane->normal);
  contact.tangential = norm(pull);
  contact.friction = single_friction(ground_material(experiment));
  if (!(contact.tangential > 0. && contact.normal > 0. && contact.friction > 0.))
    return std::nullopt;
  const auto [first, second] = mujoco_tangents(plane->normal);
  contact.along = dot(pull, first) / contact.tangential;
  contact.across = dot(pull, second) / contact.tangential;
  return contact;
}

}  // namespace

std::array<Vector3d, 2> mujoco_tangents(const Vector3d& normal) {
  const Vector3d axis = std::abs(normal.y) < 0.5 ? Vector3d{0., 1., 0.} : Vector3d{0., 0., 1.};
  const Vector3d across = axis - dot(axis, normal) * normal;
  const Vector3d first = (1. / norm(across)) * across;
  return {first, cross(normal, first)};
}

std::optional<double> mujoco_friction_mixing(const simulation::Experiment& experiment) {
  const auto contact = contact_at_rest(experiment);
  if (!contact) return std::nullopt;
  const auto material = ground_material(experiment);
  const MujocoSettings settings =
      mujoco_settings(settings_of(experiment, "mujoco"), experiment.deltat, material);
  const MujocoRow row = mujoco_row(settings, experiment.deltat, material, contact->inverse_weight);
  const Reference reference = reference_of(row, experiment.deltat);
  double depth = 0.;
  std::optional<Rest> found;
  for (int i = 0; i < 20; ++i) {  // d changes by a few percent with depth: each turn gains a digit
    found = rest(*contact, settings, reference, impedance_at(row.impedance, depth));
    if (!found) return std::nullopt;
    depth = found->depth;
  }
  return found->speed / contact->tangential;
}

}  // namespace hookpoint::reference
