// A robot of dts descriptions as Bullet's btMultiBody (revolute joints). Bullet's bodies sit at the
// centre of mass along the principal axes, so frame B of a description and frame C of Bullet differ
// by the principal rotation R_BC.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <eigen3/Eigen/Dense>
#include <memory>
#include <vector>

#include "dts/model.h"
#include "dts/state.h"

namespace hookpoint::tests {

class BulletMultibody {
 public:
  explicit BulletMultibody(const dts::RobotDescription& robot) {
    const Principal base = principal(robot.base);
    int count = 0;
    for (const auto& chain : robot.chains) count += int(chain.links.size());
    body_ = std::make_unique<btMultiBody>(count, robot.base.mass, bullet(base.moments),
                                          !robot.mobile, false);
    base_ = base;
    int l = 0;
    std::vector<Principal> bodies{base};
    for (const auto& chain : robot.chains) {
      int parent = int(chain.carrier) - 1;
      Principal before = bodies[chain.carrier];
      // The hip or the preceding link's frame, seen from the preceding Bullet frame.
      Matrix3d R_PF = rotation_matrix(chain.hip_orientation);
      Vector3d p_PF = chain.hip_position;
      for (const auto& link : chain.links) {
        const Principal here = principal(link.mass);
        const Matrix3d turn_x = rotation_matrix(exponential(Vector3d{link.alpha, 0., 0.}));
        const Matrix3d turn_z = rotation_matrix(exponential(Vector3d{0., 0., link.theta}));
        p_PF += R_PF * link.joint_position;
        R_PF = R_PF * rotation_matrix(link.joint_orientation);
        const Matrix3d R_PL = R_PF * turn_x * turn_z;
        const Vector3d p_PL =
            p_PF + R_PF * (Vector3d{link.a, 0., 0.} + turn_x * Vector3d{0., 0., link.d});
        const Matrix3d R_CC = transpose(transpose(before.R_BC) * R_PL * here.R_BC);
        body_->setupRevolute(l, link.mass.mass, bullet(here.moments), parent,
                             bullet(quaternion_from(R_CC)),
                             bullet(transpose_times(here.R_BC, {0., 0., 1.})),
                             bullet(transpose_times(before.R_BC, p_PL - before.center)),
                             bullet(transpose_times(here.R_BC, here.center)), true);
        parent = l++;
        before = here;
        bodies.push_back(here);
        R_PF = Matrix3d::identity();
        p_PF = {};
      }
    }
    body_->finalizeMultiDof();
    body_->setLinearDamping(0.);
    body_->setAngularDamping(0.);
    body_->setUseGyroTerm(true);
  }

  void set_state(const dts::State<double>& state, const Vector3d& gravity,
                 const std::vector<double>& torques) {
    const Matrix3d R_WB = rotation_matrix(state.base_orientation);
    const Vector3d offset = R_WB * base_.center;
    body_->setBasePos(bullet(state.base_position + offset));
    // Bullet stores the rotation from world to base.
    body_->setWorldToBaseRot(bullet(quaternion_from(transpose(R_WB * base_.R_BC))));
    body_->setBaseOmega(bullet(state.base_angular_velocity));
    body_->setBaseVel(bullet(state.base_velocity + cross(state.base_angular_velocity, offset)));
    body_->clearForcesAndTorques();
    body_->addBaseForce(body_->getBaseMass() * bullet(gravity));
    for (int l = 0; l < body_->getNumLinks(); ++l) {
      body_->setJointPos(l, state.joint_positions[l]);
      body_->setJointVel(l, state.joint_rates[l]);
      body_->addLinkForce(l, body_->getLinkMass(l) * bullet(gravity));
      body_->addJointTorque(l, torques[l]);
    }
  }

  /// The articulated-body algorithm; velocities grow by accelerations times `dt`.
  void compute_accelerations(double dt) {
    body_->computeAccelerationsArticulatedBodyAlgorithmMultiDof(dt, scratch_r_, scratch_v_,
                                                                scratch_m_, false, false, false);
  }
  double joint_rate(int l) const { return body_->getJointVel(l); }

 private:
  struct Principal {
    Vector3d center, moments;
    Matrix3d R_BC;
  };

  static Principal principal(const dts::MassProperties<double>& mass) {
    const Symmetric3d& m = mass.inertia;
    Eigen::Matrix3d I;
    I << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(I);
    Eigen::Matrix3d R = solver.eigenvectors();
    if (R.determinant() < 0.) R.col(0) *= -1.;
    const Eigen::Vector3d d = solver.eigenvalues();
    return {mass.center_of_mass,
            {d[0], d[1], d[2]},
            {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)}};
  }
  static btVector3 bullet(const Vector3d& a) { return {a.x, a.y, a.z}; }
  static btQuaternion bullet(const Quaterniond& q) { return {q.x, q.y, q.z, q.w}; }

  std::unique_ptr<btMultiBody> body_;
  Principal base_;
  btAlignedObjectArray<btScalar> scratch_r_;
  btAlignedObjectArray<btVector3> scratch_v_;
  btAlignedObjectArray<btMatrix3x3> scratch_m_;
};

}  // namespace hookpoint::tests
