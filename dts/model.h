// The robot as the engine sees it: a reference member (fixed or mobile) that carries serial chains,
// joints in modified Denavit-Hartenberg form (Reichler & Delcomyn 2000, Fig. 2; Lilly 1993).
// Immutable once built; share it freely.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dts/spatial.h"
#include "math/rotation.h"

namespace hookpoint::dts {

/// Mass [kg], centre of mass [m] and inertia about the centre of mass [kg m^2], in the axes of the
/// body's frame.
template <class Real>
struct MassProperties {
  Real mass{};
  Vector3<Real> center_of_mass;
  Symmetric3<Real> inertia;
};

enum class JointType { revolute, prismatic };

/// Link i's own four numbers place its frame after the preceding one: Rot_x(alpha) Trans_x(a)
/// Rot_z(theta) Trans_z(d). The joint variable adds to theta (revolute) or to d (prismatic). SI,
/// radians.
struct LinkDescription {
  double a = 0., alpha = 0., d = 0., theta = 0.;
  JointType joint = JointType::revolute;
  MassProperties<double> mass;
};

struct ChainDescription {
  Vector3d hip_position;        ///< p_BH, hip in base axes [m]
  Quaterniond hip_orientation;  ///< R_BH
  std::vector<LinkDescription> links;
};

struct RobotDescription {
  bool mobile = false;
  MassProperties<double> base;  ///< ignored for a fixed base
  std::vector<ChainDescription> chains;
};

/// What the recursions need of a body's mass: about the body frame's origin, body axes.
template <class Real>
struct RigidInertia {
  Real mass{};
  Vector3<Real> mass_moment;  ///< h = m c [kg m]
  Symmetric3<Real> inertia;   ///< about the frame's origin [kg m^2]
};

/// What is left of an articulated inertia once its joint moves freely: Ia = IA - U U^T / D.
template <class Real>
struct Elimination {
  ArticulatedInertia<Real> Ia;
  Wrench<Real> U;    ///< IA S
  Real D_inverse{};  ///< 1 / (S^T IA S)
};

template <class Real>
struct LinkConstants {
  JointType joint = JointType::revolute;
  Real sin_alpha{}, cos_alpha{}, a{}, d{}, theta{};
  bool twisted = true;  ///< alpha or a differs from 0, so that there is a screw about x
  RigidInertia<Real> inertia;
};

template <class Real>
struct ChainConstants {
  std::size_t first_link = 0, link_count = 0;
  // H is the hip frame after the first link's constant screw about x, which the model has merged
  // into it.
  bool aligned = true;  ///< R_BH is the identity
  Vector3<Real> p_BH;
  Matrix3<Real> R_BH;
  Vector3<Real> hip_to_H;  ///< from the hip as described to H, base axes [m]
  Elimination<Real> leaf;  ///< of the last link, which carries nothing: constant
};

/// A robot's constants, ready for the recursions. Immutable: share it between threads, one
/// Workspace each. Bodies are numbered: 0 the base, then the links chain by chain; link l is body l
/// + 1.
template <class Real>
class Model {
 public:
  /// Takes any description; a joint whose articulated inertia about (along) its axis is 0, such as
  /// a massless last link, gives accelerations that are not finite.
  explicit Model(const RobotDescription& robot);

  bool mobile() const { return mobile_; }
  std::size_t body_count() const { return 1 + links_.size(); }
  std::size_t link_count() const { return links_.size(); }
  std::size_t chain_count() const { return chains_.size(); }
  std::span<const LinkConstants<Real>> links() const { return links_; }
  std::span<const ChainConstants<Real>> chains() const { return chains_; }
  /// Zero for a fixed base, whose mass plays no part.
  const RigidInertia<Real>& base() const { return base_; }
  const RigidInertia<Real>& inertia(std::size_t body) const {
    return body == 0 ? base_ : links_[body - 1].inertia;
  }
  /// The chain that body `body` >= 1 belongs to.
  std::size_t chain_of(std::size_t body) const { return chain_of_link_[body - 1]; }

 private:
  bool mobile_;
  RigidInertia<Real> base_;
  std::vector<LinkConstants<Real>> links_;
  std::vector<ChainConstants<Real>> chains_;
  std::vector<std::size_t> chain_of_link_;
};

extern template class Model<double>;

}  // namespace hookpoint::dts
