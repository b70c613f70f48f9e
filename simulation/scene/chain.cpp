// Chain: links in series from a hip of the base or of a link.
#include <fmt/format.h>

#include <vector>

#include "simulation/experiment/kinematics.h"
#include "simulation/scene/body.h"
#include "simulation/scene/fixed_part.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::append;
using language::Direction;
using language::Fields;
using language::orientation_field;
using language::port_only;
using language::vector_field;

namespace {

const Fields<ChainSpec>& chain_fields() {
  static const Fields<ChainSpec> fields{
      vector_field("hip_distance", "m", &ChainSpec::hip_distance,
                   "the hip's position, in the axes of the base or "
                   "link that carries the chain"),
      orientation_field("hip_orientation", &ChainSpec::hip_orientation,
                        "hip to those axes: quaternion w,x,y,z, or roll,pitch,yaw angles"),
      port_only(Direction::output,
                vector_field("hip_force", "N", "",
                             "of the chain on what carries it in the step just taken, world axes; "
                             "engine dts with a force law only")),
      port_only(Direction::output,
                vector_field("hip_moment", "N.m", "", "the same: moment about the hip")),
  };
  return fields;
}

/// A body and all that it carries: mass, first moment and inertia about the origin of its frame, in
/// its axes.
struct Composite {
  double mass = 0.;     ///< [kg]
  Vector3d moment;      ///< mass times the place of its centre [kg m]
  Symmetric3d inertia;  ///< [kg m^2]

  explicit Composite(const MassSpec& spec)
      : mass(spec.mass),
        moment(spec.mass * spec.center_of_mass),
        inertia(spec.inertia + point_inertia(spec.mass, spec.center_of_mass)) {}

  /// Adds what a body whose frame stands at `X_PL` carries.
  void add(const Composite& outer, const Pose& X_PL) {
    const Vector3d& p = X_PL.position;
    const Vector3d h = rotate(X_PL.orientation, outer.moment);
    const double twice = 2. * dot(p, h);
    mass += outer.mass;
    moment += h + outer.mass * p;
    inertia = inertia + rotate(rotation_matrix(X_PL.orientation), outer.inertia) +
              point_inertia(outer.mass, p) +
              Symmetric3d{twice - 2. * p.x * h.x, twice - 2. * p.y * h.y, twice - 2. * p.z * h.z,
                          -p.x * h.y - h.x * p.y, -p.x * h.z - h.x * p.z, -p.y * h.z - h.y * p.z};
  }
};

BodySpec& body_of(RobotSpec& robot, int body) {
  auto left = static_cast<std::size_t>(body);
  if (left == 0) return robot.base;
  auto chain = robot.chains.begin();
  for (; left > chain->links.size(); ++chain) left -= chain->links.size();
  return chain->links[left - 1].body;
}

}  // namespace

void add_chain_class(language::Schema& schema) {
  language::ClassSchema chain;
  chain.name = "Chain";
  chain.doc =
      "a leg or an arm: links in series, joined at the hip to the base, or to the link that the "
      "chain stands in";
  chain.naming = language::Naming::required;
  chain.top_level = true;
  chain.children = {"Link"};
  append(chain.children, component_families());
  chain.fields = schemas(chain_fields());
  schema.add(std::move(chain));
}

void load_chain(const language::Object& object, const language::Object& robot, BodyIndex carrier,
                LoadedRobot& loaded, Loading& loading) {
  ChainSpec chain = load_fields(object, chain_fields());
  chain.name = name_within(object, robot);
  chain.carrier = static_cast<std::size_t>(carrier.body);
  // What comes next stands in this body, its frame at X_BL; a joint counts from a frame that lies
  // X_FL behind it: the hip, or the last link that moves.
  BodyIndex at = carrier;
  at.X_BL = carrier.X_BL * Pose{chain.hip_distance, chain.hip_orientation};
  chain.hip_distance = at.X_BL.position;
  chain.hip_orientation = at.X_BL.orientation;
  Pose X_FL;
  const std::vector<const language::Object*> links = object.children_of("Link");
  for (const language::Object* link : links) {
    LinkSpec spec = load_link(*link, name_within(*link, object), loading);
    at.mass = spec.body.mass;
    if (is_fixed(*link)) {
      const Pose X = joint_pose(spec);
      at.X_BL = at.X_BL * X;
      X_FL = X_FL * X;
      BodySpec& body =
          chain.links.empty() ? body_of(loaded.spec, carrier.body) : chain.links.back().body;
      at.first_point = body.boundary_points.size();
      add_part(spec.body, at.X_BL, body);
    } else {
      const Pose ahead = X_FL * Pose{spec.joint_location, spec.joint_orientation};
      spec.joint_location = ahead.position;
      spec.joint_orientation = ahead.orientation;
      X_FL = {};
      loaded.links.push_back(link);
      at = {carrier.robot, static_cast<int>(loaded.links.size()), {}, 0, at.mass};
      chain.links.push_back(std::move(spec));
    }
    loading.bodies.emplace(link, at);
  }
  if (links.empty()) {
    loading.error(
        object.position,
        fmt::format("chain `{}` has no links; give it a Link NAME {{ ... }}", chain.name));
  }
  if (!chain.links.empty()) loaded.spec.chains.push_back(std::move(chain));
  for (const language::Object* link : links) {
    for (const language::Object* carried : link->children_of("Chain"))
      load_chain(*carried, robot, loading.bodies.at(link), loaded, loading);
  }
}

void check_joints(const LoadedRobot& loaded, Loading& loading) {
  std::vector<TreeLink> links;
  for_each_link(loaded.spec, [&](const TreeLink& at) { links.push_back(at); });
  const auto turns = [&](std::size_t joint) { return joint_type(links[joint].link.joint).turns; };
  // What carries a body has a lower number.
  std::vector<Composite> carried;
  for (const TreeLink& at : links) carried.emplace_back(at.link.body.mass);
  for (std::size_t joint = links.size(); joint-- > 0;) {
    const TreeLink& at = links[joint];
    if (at.parent > 0)
      carried[at.parent - 1].add(carried[joint], frame_before(at) * joint_pose(at.link));
  }
  for (std::size_t joint = 0; joint < links.size(); ++joint) {
    // The inertia about the joint's axis, of a prismatic joint the mass, and what it is measured
    // against.
    const Composite& moves = carried[joint];
    const Symmetric3d& I = moves.inertia;
    const double rotor = links[joint].link.rotor_inertia;
    const double value = rotor + (turns(joint) ? I.zz : moves.mass);
    const double scale = rotor + (turns(joint) ? I.xx + I.yy + I.zz : moves.mass);
    if (value > 1e-12 * scale) continue;
    loading.error(
        place_of(*loaded.links[joint], mass_field::mass),
        fmt::format("the joint of `{}` moves no {}: give the link, or one further out, a "
                    "mass{}",
                    links[joint].link.body.name, turns(joint) ? "inertia about its axis" : "mass",
                    turns(joint) ? " and a shape or an `inertia`" : ""));
  }
}

}  // namespace hookpoint::simulation
