#include "studies/predictions/start_effects.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "simulation/experiment/kinematics.h"

namespace hookpoint::studies {
namespace {

/// Part of a closed form that may be the start's.
constexpr double negligible = 0.01;

/// Of all contacts along the plane [N/m]: our law's springs, or those that an engine has from the
/// material at `settings = matched`.
double stretching_stiffness(const RunContext& context, const BodyOnPlane& body) {
  if (body.law) return body.tangential_stiffness();
  const bool matched = body.peer && context.experiment->settings == "matched";
  return matched ? body.contacts() * body.material.tangential_stiffness : 0.;
}

/// Speed that a slide keeps of its start, at most [m/s].
double speed_of_stretching(const RunContext& context, const BodyOnPlane& body) {
  const double stiffness = stretching_stiffness(context, body);
  const double pull = body.mass * body.gravity * body.sine;
  const double limit = body.material.kinetic_friction * body.mass * body.gravity * body.cosine;
  if (body.sticks() || stiffness == 0. || !(pull > 0.)) return 0.;
  const double frequency = std::sqrt(stiffness / body.mass);
  const double phase = std::acos(1. - limit / pull);
  return pull / (body.mass * frequency) * std::sin(phase) -
         (pull - limit) / body.mass * phase / frequency;
}

/// Moment of inertia about an axis through the centre of mass, `axis` a unit vector, world axes
/// [kg m^2].
double inertia_about(const RunContext& context, const Vector3d& axis) {
  const simulation::RobotSpec& robot = context.robot_spec();
  const std::vector<simulation::Pose> poses = simulation::body_poses(robot);
  struct Part {
    double mass;
    Vector3d center;
    double inertia;
  };
  std::vector<Part> parts;
  double mass = 0.;
  Vector3d moment;
  std::size_t body = 0;
  simulation::for_each_body(robot, [&](const simulation::BodySpec& spec) {
    const simulation::Pose& X_BL = poses[body++];
    const Quaterniond R_WL = robot.orientation * X_BL.orientation;
    const Vector3d in_body = rotate(conjugate(R_WL), axis);
    const Vector3d center =
        rotate(robot.orientation, X_BL.position) + rotate(R_WL, spec.mass.center_of_mass);
    parts.push_back({spec.mass.mass, center, dot(in_body, spec.mass.inertia * in_body)});
    mass += spec.mass.mass;
    moment += spec.mass.mass * center;
  });
  double inertia = 0.;
  for (const Part& part : parts) {
    const Vector3d arm = cross(axis, part.center - (1. / mass) * moment);
    inertia += part.inertia + part.mass * dot(arm, arm);
  }
  return inertia;
}

/// A swing: what is left of its amplitude after a time.
struct Swing {
  double amplitude = 0.;  ///< of the centre of mass along the fall [m]
  double decay = 0.;      ///< of its slowest mode [1/s]
};

/// Of a body on contacts of our law that are all alike, in the plane of the fall: its displacements
/// along the fall and the normal, and its pitch.
Swing swing_of(const RunContext& context, const BodyOnPlane& body) {
  const contact::LinearContact at = body.law->linearise(body.normal_load(), body.material);
  const bool slides = !body.sticks();
  const double along_stiffness = slides ? 0. : at.tangential_stiffness;
  const double along_damping = slides ? 0. : at.tangential_damping;
  Eigen::Matrix3d K = Eigen::Matrix3d::Zero(), C = K, M = K;
  const double inertia = inertia_about(context, cross(context.normal, context.downhill));
  M.diagonal() << body.mass, body.mass, inertia;
  for (const Vector3d& point : body.footprint) {
    const double x = dot(point, context.downhill);
    // Depth grows by -z + x phi, the point moves along the fall by x_c - h phi.
    const Eigen::Vector3d depth(0., -1., x), along(1., 0., -body.height);
    K += at.normal_stiffness * depth * depth.transpose() +
         along_stiffness * along * along.transpose();
    C += at.normal_damping * depth * depth.transpose() + along_damping * along * along.transpose();
  }
  const double rocking = K(2, 2) - along_stiffness * body.contacts() * body.height * body.height;
  const double weight = body.mass * body.gravity * body.cosine;
  K(2, 2) -= weight * body.height;
  if (!(rocking > weight * body.height) || !(inertia > 0.)) return {};
  Eigen::Matrix<double, 6, 6> motion = Eigen::Matrix<double, 6, 6>::Zero();
  motion.topRightCorner<3, 3>().setIdentity();
  motion.bottomLeftCorner<3, 3>() = -M.inverse() * K;
  motion.bottomRightCorner<3, 3>() = -M.inverse() * C;
  const Eigen::VectorXcd rates = Eigen::EigenSolver<Eigen::MatrixXd>(motion, false).eigenvalues();
  // A motion along the plane that nothing holds is no swing.
  const double slowest = 1e-6 * std::sqrt(at.normal_stiffness * body.contacts() / body.mass);
  Swing swing{0., HUGE_VAL};
  for (const auto& rate : rates)
    if (std::abs(rate) > slowest) swing.decay = std::min(swing.decay, -rate.real());
  const double moment =
      std::min(body.tangent(), body.material.kinetic_friction) * weight * body.height;
  swing.amplitude = body.height * moment / rocking;
  return swing;
}

}  // namespace

std::string why_start_counts(const RunContext& context, const BodyOnPlane& body, Fitted fitted,
                             double predicted) {
  if (body.settled || predicted == 0.) return "";
  const double allowed = negligible * std::abs(predicted);
  if (fitted == Fitted::speed && speed_of_stretching(context, body) > allowed)
    return "the speed that the body gained while its slack springs stretched is more than 1 % of it; "
           "measure later and longer (settle, duration)";
  if (!body.law || body.single_point) return "";
  const double time = context.duration - context.settle;
  const Swing swing = swing_of(context, body);
  const double left = swing.amplitude * std::exp(-swing.decay * context.settle);
  const double error = fitted == Fitted::speed ? 3. * left / time : 30. * left / (time * time);
  if (error > allowed)
    return "at `settle` the body still swings from its start with slack springs; measure later "
           "(settle)";
  return "";
}

}  // namespace hookpoint::studies
