// Chain: links in series from a hip of the base or of a link.
#include <fmt/format.h>

#include <vector>

#include "simulation/kinematics.h"
#include "simulation/scene/body.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {
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
  const std::vector<const language::Object*> links = object.children_of("Link");
  BodyIndex next{carrier.robot, static_cast<int>(loaded.links.size()) + 1};
  const BodyIndex first = next;
  for (const language::Object* link : links) {
    chain.links.push_back(load_link(*link, name_within(*link, object), loading));
    loading.bodies.emplace(link, next);
    loaded.links.push_back(link);
    ++next.body;
  }
  if (links.empty()) {
    loading.error(
        object.position,
        fmt::format("chain `{}` has no links; give it a Link NAME {{ ... }}", chain.name));
  }
  loaded.spec.chains.push_back(std::move(chain));
  for (std::size_t i = 0; i < links.size(); ++i) {
    const BodyIndex link{first.robot, first.body + static_cast<int>(i)};
    for (const language::Object* carried : links[i]->children_of("Chain"))
      load_chain(*carried, robot, link, loaded, loading);
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
