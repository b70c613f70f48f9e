// Chains of one robot side by side: those of the same length and joint types run through the
// recursions together, one a lane of a pack (docs/performance.md).
#pragma once

#include <span>
#include <vector>

#include "dts/mdh.h"
#include "math/pack_structures.h"

namespace hookpoint::dts {

/// Chains that go together.
inline constexpr std::size_t lane_count = 4;
template <class Real>
using Lanes = Pack<Real, lane_count>;

enum class JointType { revolute, prismatic };

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
  Real D_inverse{};  ///< 1 / (S^T IA S + I_r)
};

/// The part of a link's fixed transform that its screws cannot take up.
template <class Real>
struct Placement {
  Vector3<Real> shift;      ///< preceding link's axes [m]
  Real sine{}, cosine{1.};  ///< of a turn about z that follows it
};

template <class Real>
struct LinkConstants {
  JointType joint = JointType::revolute;
  bool placed = false;  ///< there is a placement ahead of the screws
  Placement<Real> placement;
  bool twisted = false;  ///< alpha or a differs from 0, so that there is a screw about x
  bool carries = false;  ///< a chain hangs on the link, in some lane
  Screw<Real> twist;     ///< by alpha and a, about the preceding frame's x
  Real d{}, theta{};
  RigidInertia<Real> inertia;
  bool full = false;     ///< its elimination leaves nothing 0: it has a rotor
  Real rotor_inertia{};  ///< I_r, which moves with the joint alone [kg m^2, kg]
};

/// Where a chain starts, on the body B that carries it. H is the hip frame after the first link's
/// constant screw about x, which the model has merged into it.
template <class Real>
struct HipConstants {
  Vector3<Real> p_BH;
  Matrix3<Real> R_BH;
  Vector3<Real> hip_to_H;  ///< from the hip as described to H, axes of B [m]
};

/// Up to `lane_count` chains. The lanes beyond the last chain repeat it: they compute and write the
/// numbers that it does, and are left out of sums (`in_use`).
template <class Real>
struct ChainGroup {
  std::size_t index = 0;  ///< among the model's groups
  std::size_t depth = 0;  ///< links that carry chains, from the base to these
  std::size_t chain_count = 0;
  std::size_t first_pass = 0;                    ///< where the group's links start in a workspace
  std::array<std::size_t, lane_count> chains{};  ///< which, in the robot's order
  std::array<std::size_t, lane_count> first_links{};  ///< theirs, in the robot's order
  std::array<std::size_t, lane_count> carriers{};     ///< the bodies that they hang on
  Mask<Lanes<Real>> in_use;
  bool aligned = true;  ///< every R_BH is the identity
  HipConstants<Lanes<Real>> hip;
  std::vector<LinkConstants<Lanes<Real>>> links;
  Elimination<Lanes<Real>> leaf;  ///< of the last links, where they carry nothing: constant

  std::size_t link_count() const { return links.size(); }
  bool on_base() const { return depth == 0; }
  /// Link `n` is the last of all, so that its elimination is `leaf`.
  bool ends_at(std::size_t n) const { return n + 1 == links.size() && !links[n].carries; }
};

/// For each lane, where link `n` of its chain finds its own among `of_links`, one a link.
template <class Real, class T>
std::array<T*, lane_count> at_link(const ChainGroup<Real>& group, std::size_t n,
                                   std::span<T> of_links) {
  std::array<T*, lane_count> result;
  for (std::size_t i = 0; i < lane_count; ++i) result[i] = &of_links[group.first_links[i] + n];
  return result;
}
/// The same among `of_bodies`, one a body, of which the first is the base.
template <class Real, class T>
std::array<T*, lane_count> at_body(const ChainGroup<Real>& group, std::size_t n,
                                   std::span<T> of_bodies) {
  return at_link(group, n + 1, of_bodies);
}
/// For each lane, where its chain finds its carrier's among `of_bodies`.
template <class Real, class T>
std::array<T*, lane_count> at_carrier(const ChainGroup<Real>& group, std::span<T> of_bodies) {
  std::array<T*, lane_count> result;
  for (std::size_t i = 0; i < lane_count; ++i) result[i] = &of_bodies[group.carriers[i]];
  return result;
}
/// For each lane, where its chain finds its own among `of_chains`, one a chain.
template <class Real, class T>
std::array<T*, lane_count> at_chain(const ChainGroup<Real>& group, std::span<T> of_chains) {
  std::array<T*, lane_count> result;
  for (std::size_t i = 0; i < lane_count; ++i) result[i] = &of_chains[group.chains[i]];
  return result;
}

}  // namespace hookpoint::dts
