#include "reference/joint_response.h"

#include <algorithm>
#include <array>

#include "math/rotation.h"
#include "simulation/experiment/joint_type.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::reference {
namespace {

/// Of the largest pivot: what rounding leaves of a coordinate that moves no mass.
constexpr double least_pivot = 1e-14;

std::size_t base_coordinates(const simulation::RobotSpec& robot) {
  if (!robot.mobile) return 0;
  return robot.plane_normal ? 3 : 6;
}

}  // namespace

JointResponse::JointResponse(const simulation::RobotSpec& robot)
    : base_count_(base_coordinates(robot)),
      composites_(simulation::body_count(robot)),
      mass_matrix_(base_count_ + simulation::joint_count(robot)) {
  const std::array<Vector3d, 3> axes{Vector3d{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
  for (std::size_t i = 0; i < axes.size() && robot.mobile; ++i) {
    const bool normal = robot.plane_normal == i;
    if (!robot.plane_normal || normal) motions_.push_back({axes[i], {}});
    if (!robot.plane_normal || !normal) motions_.push_back({{}, axes[i]});
  }
  bodies_.push_back({robot.base.mass});
  simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
    bodies_.push_back({at.link.body.mass, at.parent, simulation::joint_type(at.link.joint).turns,
                       at.link.rotor_inertia});
  });
  motions_.resize(base_count_ + simulation::joint_count(robot));
  forces_.resize(motions_.size());
  accelerations_.resize(motions_.size());
}

JointResponse::Screw JointResponse::momentum(const Inertia& inertia, const Screw& motion) {
  return {inertia.rotation * motion.angular + cross(inertia.moment, motion.linear),
          inertia.mass * motion.linear + cross(motion.angular, inertia.moment)};
}

void JointResponse::stand_at(std::span<const simulation::BodyState> bodies) {
  const Vector3d origin = bodies[0].position;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const simulation::MassSpec& own = bodies_[i].mass;
    const simulation::BodyState& at = bodies[i];
    const Vector3d c = at.position + rotate(at.orientation, own.center_of_mass) - origin;
    const Matrix3d R = rotation_matrix(at.orientation), across = cross_matrix(c);
    composites_[i] = {
        own.mass, own.mass * c,
        R * general(own.inertia) * transpose(R) + own.mass * (transpose(across) * across)};
    if (i == 0) continue;
    const Vector3d axis = rotate(at.orientation, Vector3d{0., 0., 1.});
    motions_[base_count_ + i - 1] =
        bodies_[i].turns ? Screw{axis, cross(at.position - origin, axis)} : Screw{{}, axis};
  }
  for (std::size_t i = bodies_.size(); --i > 0;) {
    Inertia& carrier = composites_[bodies_[i].parent];
    carrier.mass += composites_[i].mass;
    carrier.moment += composites_[i].moment;
    carrier.rotation = carrier.rotation + composites_[i].rotation;
  }
  const std::size_t size = motions_.size();
  for (std::size_t k = 0; k < size; ++k)
    for (std::size_t l = 0; l < size; ++l) mass_matrix_(k, l) = 0.;
  const auto fill = [&](std::size_t k, std::size_t l, const Screw& of_l) {
    const double m = dot(motions_[k].angular, of_l.angular) + dot(motions_[k].linear, of_l.linear);
    mass_matrix_(k, l) = mass_matrix_(l, k) = m;
  };
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const std::size_t column = base_count_ + i - 1;
    const Screw carried = momentum(composites_[i], motions_[column]);
    for (std::size_t j = i; j > 0; j = bodies_[j].parent)
      fill(base_count_ + j - 1, column, carried);
    mass_matrix_(column, column) += bodies_[i].rotor_inertia;
    for (std::size_t k = 0; k < base_count_; ++k) fill(k, column, carried);
  }
  for (std::size_t l = 0; l < base_count_; ++l) {
    const Screw carried = momentum(composites_[0], motions_[l]);
    for (std::size_t k = 0; k < base_count_; ++k) fill(k, l, carried);
  }
  mass_matrix_.factor(least_pivot);
}

void JointResponse::solve(std::span<const double> torques, std::span<double> accelerations) {
  std::ranges::copy(torques, forces_.begin() + static_cast<std::ptrdiff_t>(base_count_));
  mass_matrix_.solve(forces_, accelerations_);
  std::ranges::copy(std::span(accelerations_).subspan(base_count_), accelerations.begin());
}

}  // namespace hookpoint::reference
