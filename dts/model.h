// The robot as the engine sees it: a reference member (fixed, mobile or planar) that carries serial
// chains, joints in modified Denavit-Hartenberg form (Reichler & Delcomyn 2000, Fig. 2; Lilly
// 1993), whose links may carry chains in turn (docs/decisions/0027-chains-on-links.md).
// Immutable once built, but for set_rotor_inertia; share it freely.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "dts/chain_group.h"
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

/// Link i's own four numbers place its frame after the preceding one: Rot_x(alpha) Trans_x(a)
/// Rot_z(theta) Trans_z(d). The joint variable adds to theta (revolute) or to d (prismatic). SI,
/// radians. Ahead of them may stand any fixed transform, for axes that four numbers cannot place or
/// place badly (common normals of near-parallel axes lie far away).
struct LinkDescription {
  double a = 0., alpha = 0., d = 0., theta = 0.;
  JointType joint = JointType::revolute;
  MassProperties<double> mass;
  Vector3d joint_position;        ///< of the fixed transform, preceding link's axes [m]
  Quaterniond joint_orientation;  ///< of the fixed transform
  double rotor_inertia = 0.;      ///< I_r of the joint's motor and gears, at the joint [kg m^2, kg]
  bool full = false;              ///< it may be given a rotor inertia later
};

struct ChainDescription {
  Vector3d hip_position;        ///< p_BH, hip in the carrier's axes [m]
  Quaterniond hip_orientation;  ///< R_BH
  std::vector<LinkDescription> links;
  std::size_t carrier = 0;  ///< body that it hangs on: 0 the base, or a link of an earlier chain
};

struct RobotDescription {
  bool mobile = false;
  MassProperties<double> base;  ///< ignored for a fixed base
  std::vector<ChainDescription> chains;
  /// Of a mobile base that is kept in a plane of world axes: which of x, y, z is its normal.
  std::optional<std::size_t> plane_normal = {};
};

/// Where the recursions find a link: which of its chain, and the lane of the group that the chain
/// is in.
struct Seat {
  std::size_t group = 0, lane = 0, link = 0;
};

/// A robot's constants, ready for the recursions. Share it between threads, one
/// Workspace each. Bodies are numbered: 0 the base, then the links chain by chain; link l is body l
/// + 1.
template <class Real>
class Model {
 public:
  /// Takes any description whose chains come after their carriers; a joint whose articulated
  /// inertia about (along) its axis is 0, such as a massless last link, gives accelerations that
  /// are not finite.
  explicit Model(const RobotDescription& robot);

  bool mobile() const { return mobile_; }
  /// 0, 1, 2 for the world axis that a planar base neither moves along nor turns away from.
  const std::optional<std::size_t>& plane_normal() const { return plane_normal_; }
  std::size_t body_count() const { return inertias_.size(); }
  std::size_t link_count() const { return body_count() - 1; }
  std::size_t chain_count() const { return chain_count_; }
  /// Chains on the base come first, and every chain after its carrier.
  std::span<const ChainGroup<Real>> groups() const { return groups_; }
  std::span<const ChainGroup<Real>> base_groups() const { return groups().first(base_groups_); }
  /// Those whose chains hang on links.
  std::span<const ChainGroup<Real>> link_groups() const { return groups().subspan(base_groups_); }
  /// Some link carries chains.
  bool branches() const { return base_groups_ < groups_.size(); }
  /// Changes I_r of the joint of body `body` >= 1, which was described with one or as `full`
  /// [kg m^2, kg].
  void set_rotor_inertia(std::size_t body, Real rotor_inertia);
  /// Zero for a fixed base, whose mass plays no part.
  const RigidInertia<Real>& base() const { return inertias_[0]; }
  const RigidInertia<Real>& inertia(std::size_t body) const { return inertias_[body]; }
  /// The place of body `body` >= 1.
  const Seat& seat_of(std::size_t body) const { return seats_[body - 1]; }
  /// The body that carries body `body` >= 1: the link before it, or what its chain hangs on. Its
  /// number is the lower.
  std::size_t carrier_of(std::size_t body) const {
    const Seat& seat = seat_of(body);
    return seat.link > 0 ? body - 1 : groups_[seat.group].carriers[seat.lane];
  }

 private:
  void add_chain(const ChainDescription& description, std::size_t chain, std::size_t first_link,
                 std::size_t depth);
  std::size_t group_for(std::span<const LinkDescription> links, std::size_t depth);

  bool mobile_;
  std::optional<std::size_t> plane_normal_;
  std::size_t chain_count_;
  std::size_t base_groups_ = 0;
  std::vector<RigidInertia<Real>> inertias_;
  std::vector<ChainGroup<Real>> groups_;
  std::vector<Seat> seats_;
};

/// Calls `visit(group)` for every group, what a chain carries before the chain.
template <class Real, class Visit>
void for_each_inward(const Model<Real>& model, const Visit& visit) {
  const std::span<const ChainGroup<Real>> on_links = model.link_groups();
  for (std::size_t g = on_links.size(); g-- > 0;) visit(on_links[g]);
  for (const ChainGroup<Real>& group : model.base_groups()) visit(group);
}

extern template class Model<double>;

}  // namespace hookpoint::dts
