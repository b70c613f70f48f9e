#include "dts/model.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "dts/joint.h"
#include "dts/rigid_body.h"

namespace hookpoint::dts {
namespace {

template <class Real>
RigidInertia<Real> about_origin(const MassProperties<double>& body) {
  return in_all_lanes<Real>(
      RigidInertia<double>{body.mass, body.mass * body.center_of_mass,
                           body.inertia + point_inertia(body.mass, body.center_of_mass)});
}

Screw<double> twist_of(const LinkDescription& link) {
  const SineCosine<double> alpha = sine_cosine(link.alpha);
  return {alpha.sine, alpha.cosine, link.a};
}

bool is_placed(const LinkDescription& link) {
  return link.joint_position != Vector3d{} || link.joint_orientation != Quaterniond{};
}

/// A link's fixed transform and screw about x as one: R, and the shift in the preceding link's
/// axes.
struct Ahead {
  Vector3d shift;
  Matrix3d R;
};
Ahead ahead_of(const LinkDescription& link) {
  const Matrix3d R = rotation_matrix(normalized(link.joint_orientation));
  const Screw<double> twist = twist_of(link);
  return {link.joint_position + R * Vector3d{twist.shift, 0., 0.},
          times_rotation_x(R, twist.sine, twist.cosine)};
}

/// R = Rot_z(turn) Rot_x(alpha) Rot_z(theta): the first goes into the placement, the others into
/// the link's screws. Well conditioned for any alpha, since each angle is that of what the others
/// leave.
Placement<double> split_placement(LinkDescription& link) {
  const auto [shift, R] = ahead_of(link);
  const double turn = R.xz == 0. && R.yz == 0. ? 0. : std::atan2(R.xz, -R.yz);
  const SineCosine<double> z = sine_cosine(turn);
  const Matrix3d rest{z.cosine * R.xx + z.sine * R.yx,
                      z.cosine * R.xy + z.sine * R.yy,
                      z.cosine * R.xz + z.sine * R.yz,
                      z.cosine * R.yx - z.sine * R.xx,
                      z.cosine * R.yy - z.sine * R.xy,
                      z.cosine * R.yz - z.sine * R.xz,
                      R.zx,
                      R.zy,
                      R.zz};
  link.a = 0.;
  link.alpha = std::atan2(-rest.yz, rest.zz);
  link.theta += std::atan2(-rest.xy, rest.xx);
  return {shift, z.sine, z.cosine};
}

/// The hip with all that never moves against it: the first link's fixed transform and screw about
/// x, of which `first` is left with none.
HipConstants<double> merged_hip(const ChainDescription& description, LinkDescription& first) {
  const Matrix3d R = rotation_matrix(normalized(description.hip_orientation));
  const Ahead ahead = ahead_of(first);
  const Vector3d hip_to_H = R * ahead.shift;
  first.a = first.alpha = 0.;
  first.joint_position = {};
  first.joint_orientation = {};
  return {description.hip_position + hip_to_H, R * ahead.R, hip_to_H};
}

/// Whether the link's elimination leaves nothing 0.
bool is_full(const LinkDescription& link) { return link.full || link.rotor_inertia != 0.; }

/// Puts a link of a chain into lane `lane`.
template <class Real>
void set_link(LinkConstants<Lanes<Real>>& links, std::size_t lane, LinkDescription link) {
  links.joint = link.joint;
  links.placed = links.placed || is_placed(link);
  const Placement<double> placement = is_placed(link) ? split_placement(link) : Placement<double>{};
  set_lane(links.placement, lane, in_all_lanes<Real>(placement));
  links.twisted = links.twisted || link.alpha != 0. || link.a != 0.;
  set_lane(links.twist, lane, in_all_lanes<Real>(twist_of(link)));
  links.d.lanes[lane] = link.d;
  links.theta.lanes[lane] = link.theta;
  set_lane(links.inertia, lane, about_origin<Real>(link.mass));
  links.full = is_full(link);
  links.rotor_inertia.lanes[lane] = link.rotor_inertia;
}

/// What leaves the last link of the group's chains.
template <class Real>
void eliminate_leaf(ChainGroup<Real>& group) {
  const LinkConstants<Lanes<Real>>& last = group.links.back();
  group.leaf = last.full ? eliminate_fully(last, articulated(last.inertia))
                         : eliminate(last.joint, articulated(last.inertia));
}

/// Adds a chain to a group of its kind: in the next lane, and for the time being in those beyond.
template <class Real>
void add_to(ChainGroup<Real>& group, std::size_t chain, std::size_t first_link, std::size_t carrier,
            const HipConstants<double>& hip, std::span<const LinkDescription> links) {
  group.aligned = group.aligned && hip.R_BH == Matrix3d::identity();
  for (std::size_t lane = group.chain_count; lane < lane_count; ++lane) {
    group.chains[lane] = chain;
    group.first_links[lane] = first_link;
    group.carriers[lane] = carrier;
    set_lane(group.hip, lane, in_all_lanes<Real>(hip));
    for (std::size_t n = 0; n < links.size(); ++n) set_link<Real>(group.links[n], lane, links[n]);
  }
  group.in_use.bits[group.chain_count] = -1;
  ++group.chain_count;
  if (!links.empty()) eliminate_leaf(group);
}

/// How many links that carry chains lie between the base and each chain.
std::vector<std::size_t> depths_of(const RobotDescription& robot) {
  std::vector<std::size_t> of_chains;
  std::vector<std::size_t> beyond{0};  // of a chain that hangs on a body, one a body
  for (const ChainDescription& chain : robot.chains) {
    assert(chain.carrier < beyond.size() && "a chain comes after its carrier");
    of_chains.push_back(beyond[chain.carrier]);
    beyond.resize(beyond.size() + chain.links.size(), of_chains.back() + 1);
  }
  return of_chains;
}

}  // namespace

template <class Real>
Model<Real>::Model(const RobotDescription& robot)
    : mobile_(robot.mobile),
      plane_normal_(robot.mobile ? robot.plane_normal : std::nullopt),
      chain_count_(robot.chains.size()),
      inertias_{robot.mobile ? about_origin<Real>(robot.base) : RigidInertia<Real>{}} {
  std::vector<std::size_t> first_links;
  for (const ChainDescription& chain : robot.chains) {
    first_links.push_back(link_count());
    for (const LinkDescription& link : chain.links)
      inertias_.push_back(about_origin<Real>(link.mass));
  }
  seats_.resize(link_count());
  // Level by level, so that a carrier's group comes before those of what it carries.
  const std::vector<std::size_t> depths = depths_of(robot);
  std::size_t added = 0;
  for (std::size_t depth = 0; added < chain_count_; ++depth) {
    for (std::size_t chain = 0; chain < chain_count_; ++chain) {
      if (depths[chain] != depth) continue;
      add_chain(robot.chains[chain], chain, first_links[chain], depth);
      ++added;
    }
    if (depth == 0) base_groups_ = groups_.size();
  }
}

template <class Real>
void Model<Real>::add_chain(const ChainDescription& description, std::size_t chain,
                            std::size_t first_link, std::size_t depth) {
  std::vector<LinkDescription> links = description.links;
  LinkDescription none;
  const HipConstants<double> hip = merged_hip(description, links.empty() ? none : links.front());
  const std::size_t g = group_for(links, depth);
  for (std::size_t n = 0; n < links.size(); ++n) {
    seats_[first_link + n] = {g, groups_[g].chain_count, n};
  }
  add_to<Real>(groups_[g], chain, first_link, description.carrier, hip, links);
  if (depth == 0) return;
  const Seat& carrier = seat_of(description.carrier);
  groups_[carrier.group].links[carrier.link].carries = true;
}

/// The group with room for a chain of these joints, eliminated alike, so far from the base: the
/// first there is, or a new one. So a chain moves the same bit for bit whatever its neighbours are.
template <class Real>
std::size_t Model<Real>::group_for(std::span<const LinkDescription> links, std::size_t depth) {
  const auto fits = [&](const ChainGroup<Real>& group) {
    return group.chain_count < lane_count && group.depth == depth &&
           std::ranges::equal(
               group.links, links,
               [](const LinkConstants<Lanes<Real>>& of_group, const LinkDescription& link) {
                 return of_group.joint == link.joint && of_group.full == is_full(link);
               });
  };
  const auto found = std::ranges::find_if(groups_, fits);
  const std::size_t g = std::size_t(found - groups_.begin());
  if (found != groups_.end()) return g;
  ChainGroup<Real>& group = groups_.emplace_back();
  group.index = g;
  group.depth = depth;
  if (g > 0) group.first_pass = groups_[g - 1].first_pass + groups_[g - 1].link_count();
  group.links.resize(links.size());
  for (std::size_t n = 0; n < links.size(); ++n) {
    group.links[n].joint = links[n].joint;
    group.links[n].full = is_full(links[n]);
  }
  return g;
}

template <class Real>
void Model<Real>::set_rotor_inertia(std::size_t body, Real rotor_inertia) {
  const Seat& seat = seat_of(body);
  ChainGroup<Real>& group = groups_[seat.group];
  LinkConstants<Lanes<Real>>& link = group.links[seat.link];
  assert(link.full && "described with a rotor");
  // Lanes beyond the last chain repeat it.
  const std::size_t last = seat.lane + 1 == group.chain_count ? lane_count : seat.lane + 1;
  for (std::size_t lane = seat.lane; lane < last; ++lane)
    link.rotor_inertia.lanes[lane] = rotor_inertia;
  if (group.ends_at(seat.link)) eliminate_leaf(group);
}

template class Model<double>;

}  // namespace hookpoint::dts
