// With M the mass matrix, M_jj comes from composite bodies. The diagonal of M^-1 comes from articulated
// inertias I_A, inwards, and from the inverse inertia W of each body with the whole robot around it,
// outwards (Rodriguez, Jain, Kreutz-Delgado 1991). Of body i on p, with X the transform of motions, S
// the axis, r the rotor's inertia:
//   U = I_A S, D = S^T U + r, I_A of p gains X^T (I_A - U U^T / D) X
//   W' = X W_p X^T, (M^-1)_ii = 1/D + U^T W' U / D^2, W = (1 - S U^T / D) W' (...)^T + S S^T / D
// A free base has W = I_A^-1, a fixed one 0.
#include "simulation/scene/mjcf/joint_inertia.h"

#include <eigen3/Eigen/Dense>

#include "dts/mass_properties.h"
#include "math/rotation.h"

namespace hookpoint::simulation {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// X_PC of a joint's child where the joint stands.
Pose child_pose(const UrdfJoint& joint) {
  const double q = joint.angle.value_or(0.);
  if (joint.type == UrdfJointType::prismatic) return joint.origin * Pose{q * joint.axis, {}};
  const bool turns =
      joint.type == UrdfJointType::revolute || joint.type == UrdfJointType::continuous;
  return turns ? joint.origin * Pose{{}, exponential(q * joint.axis)} : joint.origin;
}

Eigen::Matrix3d cross_matrix(const Vector3d& p) {
  return Eigen::Matrix3d{{0., -p.z, p.y}, {p.z, 0., -p.x}, {-p.y, p.x, 0.}};
}

/// About the origin of the frame, angular part first.
Matrix6 spatial_inertia(const MassSpec& of) {
  const Symmetric3d& I = of.inertia;
  const Eigen::Matrix3d c = cross_matrix(of.center_of_mass);
  Matrix6 inertia;
  inertia << Eigen::Matrix3d{{I.xx, I.xy, I.xz}, {I.xy, I.yy, I.yz}, {I.xz, I.yz, I.zz}} -
                 of.mass * c * c,
      of.mass * c, -of.mass * c, of.mass * Eigen::Matrix3d::Identity();
  return inertia;
}

/// From motions of the parent to those of the child at X_PC.
Matrix6 motion_transform(const Pose& X_PC) {
  Eigen::Matrix3d R_CP;
  const Quaterniond q_CP = conjugate(X_PC.orientation);
  const Vector3d x = rotate(q_CP, Vector3d{1., 0., 0.}), y = rotate(q_CP, Vector3d{0., 1., 0.}),
                 z = rotate(q_CP, Vector3d{0., 0., 1.});
  R_CP << x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z;
  Matrix6 X = Matrix6::Zero();
  X.topLeftCorner<3, 3>() = X.bottomRightCorner<3, 3>() = R_CP;
  X.bottomLeftCorner<3, 3>() = -R_CP * cross_matrix(X_PC.position);
  return X;
}

Vector6 motion_axis(const UrdfJoint& joint) {
  const Vector3d& a = joint.axis;
  Vector6 S = Vector6::Zero();
  S.segment<3>(joint.type == UrdfJointType::prismatic ? 3 : 0) = Eigen::Vector3d(a.x, a.y, a.z);
  return S;
}

bool has_an_axis(const UrdfJoint& joint) {
  return joint.type != UrdfJointType::fixed && joint.type != UrdfJointType::floating;
}

}  // namespace

std::vector<JointInertia> joint_inertias(const UrdfRobot& robot) {
  const std::size_t count = robot.joints.size();
  std::vector<Matrix6> composite, articulated, X(count), W(robot.links.size(), Matrix6::Zero());
  for (const UrdfLink& link : robot.links) composite.push_back(spatial_inertia(link.mass));
  articulated = composite;
  std::vector<Vector6> S(count, Vector6::Zero()), U(count, Vector6::Zero());
  std::vector<double> D(count, 0.);
  std::vector<JointInertia> found(count);
  for (std::size_t k = count; k-- > 0;) {
    const UrdfJoint& joint = robot.joints[k];
    X[k] = motion_transform(child_pose(joint));
    Matrix6 felt = articulated[joint.child];
    if (has_an_axis(joint)) {
      S[k] = motion_axis(joint);
      found[k].rigid = S[k].dot(composite[joint.child] * S[k]) + joint.rotor_inertia;
      U[k] = felt * S[k];
      D[k] = S[k].dot(U[k]) + joint.rotor_inertia;
      if (D[k] > 0.) felt -= U[k] * U[k].transpose() / D[k];
    }
    composite[joint.parent] += X[k].transpose() * composite[joint.child] * X[k];
    if (joint.type != UrdfJointType::floating)
      articulated[joint.parent] += X[k].transpose() * felt * X[k];
  }
  for (std::size_t k = 0; k < count; ++k) {
    const UrdfJoint& joint = robot.joints[k];
    Matrix6& of = W[joint.child];
    of = X[k] * W[joint.parent] * X[k].transpose();
    if (joint.type == UrdfJointType::floating) of = articulated[joint.child].inverse();
    if (!(D[k] > 0.)) continue;
    found[k].effective = 1. / (1. / D[k] + U[k].dot(of * U[k]) / (D[k] * D[k]));
    const Matrix6 follows = Matrix6::Identity() - S[k] * U[k].transpose() / D[k];
    of = (follows * of * follows.transpose() + S[k] * S[k].transpose() / D[k]).eval();
  }
  return found;
}

}  // namespace hookpoint::simulation
