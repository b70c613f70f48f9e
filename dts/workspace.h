// Every intermediate and result of the recursions, sized once from a Model: one a thread, no
// allocation afterwards.
#pragma once

#include <vector>

#include "dts/model.h"

namespace hookpoint::dts {

/// A body's pose and velocity, of its frame's origin, world axes.
template <class Real>
struct BodyMotion {
  Matrix3<Real> R_WB;
  Vector3<Real> p_WB;  ///< [m]
  Vector3<Real> v_WB;  ///< [m/s]
  Vector3<Real> w_WB;  ///< [rad/s]
};

/// What the passes hand one another about a link, in link axes.
template <class Real>
struct LinkPass {
  Screw<Real> turn;    ///< about the link's z, by its angle and offset
  Matrix3<Real> R_WB;  ///< of the link
  Vector3<Real> w;     ///< angular velocity
  Motion<Real> c;      ///< acceleration that the velocities alone give the link
  Wrench<Real> U;      ///< IA S
  Real D_inverse{};    ///< 1 / (S^T IA S + I_r)
  Real u{};            ///< tau - S^T pA
  Real impulse{};      ///< as u, when impulses take the place of forces; 0 but during a response
};

/// What a chain asks of its hip frame, or all chains on a link of the link's: f = IA a + pA.
template <class Real>
struct HipPass {
  ArticulatedInertia<Real> IA;
  Wrench<Real> pA;
};

/// The base with all that it carries, base axes, factored for a = -IA^-1 pA.
template <class Real>
struct BasePass {
  Vector3<Real> w;     ///< angular velocity
  Matrix3<Real> H;     ///< of IA
  Symmetric3<Real> M;  ///< of IA
  Symmetric3<Real> M_inverse;
  Symmetric3<Real> rotational_inverse;  ///< (I - H M^-1 H^T)^-1
};

template <class Real>
struct Workspace {
  explicit Workspace(const Model<Real>& model)
      : bodies(model.body_count()),
        external(model.body_count()),
        joint_accelerations(model.link_count()),
        hip_wrenches(model.chain_count()),
        hips(model.groups().size()),
        carrier_w(model.groups().size()),
        carrier_motions(model.branches() ? model.body_count() : 0),
        carried(carrier_motions.size()) {
    for (const ChainGroup<Real>& group : model.groups()) {
      links.resize(links.size() + group.link_count());
    }
    link_wrenches.resize(links.size());
  }

  /// What the passes know about the links of `group`, from the base outwards.
  std::span<LinkPass<Lanes<Real>>> passes(const ChainGroup<Real>& group) {
    return std::span(links).subspan(group.first_pass, group.link_count());
  }

  // Set by forward_kinematics.
  std::vector<BodyMotion<Real>> bodies;

  // Set by the caller (external_forces.h): on each body, about its origin, world axes.
  std::vector<Wrench<Real>> external;

  // Set by forward_dynamics.
  Vector3<Real> base_acceleration;  ///< of the base origin, world axes; free fall: g [m/s^2]
  Vector3<Real> base_angular_acceleration;  ///< world axes [rad/s^2]
  std::vector<Real> joint_accelerations;    ///< chain by chain
  /// By each chain ON the body that carries it, about its hip, world axes.
  std::vector<Wrench<Real>> hip_wrenches;

  // Between the passes.
  std::vector<LinkPass<Lanes<Real>>> links;        ///< group by group
  std::vector<HipPass<Lanes<Real>>> hips;          ///< one a group
  std::vector<Vector3<Lanes<Real>>> carrier_w;     ///< one a group: w of the carriers, their axes
  std::vector<Wrench<Lanes<Real>>> link_wrenches;  ///< as links: on the link, link axes
  Elimination<Lanes<Real>> full;                   ///< of the link just passed, if it has a rotor
  BasePass<Real> base;
  Motion<Real> base_motion;  ///< acceleration less gravity (or velocity jump), base axes
  // Of links that carry chains; one a body, none where no link does.
  std::vector<Motion<Real>> carrier_motions;  ///< as base_motion, link axes
  std::vector<HipPass<Real>> carried;         ///< what the chains on it ask of the link, link axes
};

}  // namespace hookpoint::dts
