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

/// What a joint accelerates: the inertia of its link and all further out about its axis (their
/// mass, for a prismatic joint) and of its rotor, and the size that such an inertia is measured
/// against.
struct MovedInertia {
  double value = 0., scale = 0.;

  /// A body whose frame L stands at `X_JL` in that of the joint's link.
  void add(const MassSpec& mass, const Pose& X_JL, bool turns) {
    const Vector3d p_JC = X_JL.position + rotate(X_JL.orientation, mass.center_of_mass);
    const Symmetric3d I_C = rotate(rotation_matrix(X_JL.orientation), mass.inertia);
    const Symmetric3d I_J = I_C + point_inertia(mass.mass, p_JC);
    value += turns ? I_J.zz : mass.mass;
    scale += turns ? I_J.xx + I_J.yy + I_J.zz : mass.mass;
  }
  void add_rotor(double inertia) {
    value += inertia;
    scale += inertia;
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
  std::vector<MovedInertia> moved(links.size());
  for (const TreeLink& outer : links) {
    moved[outer.joint()].add_rotor(outer.link.rotor_inertia);
    Pose X_JL;
    for (std::size_t body = outer.body; body > 0;) {
      const TreeLink& at = links[body - 1];
      moved[at.joint()].add(outer.link.body.mass, X_JL, turns(at.joint()));
      X_JL = frame_before(at) * joint_pose(at.link) * X_JL;
      body = at.parent;
    }
  }
  for (std::size_t joint = 0; joint < links.size(); ++joint) {
    if (moved[joint].value > 1e-12 * moved[joint].scale) continue;
    loading.error(
        place_of(*loaded.links[joint], mass_field::mass),
        fmt::format("the joint of `{}` moves no {}: give the link, or one further out, a "
                    "mass{}",
                    links[joint].link.body.name, turns(joint) ? "inertia about its axis" : "mass",
                    turns(joint) ? " and a shape or an `inertia`" : ""));
  }
}

}  // namespace hookpoint::simulation
