// Chain: links in series from a hip of the base.
#include <fmt/format.h>

#include "simulation/kinematics.h"
#include "simulation/scene/body.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {
namespace {

const Fields<ChainSpec>& chain_fields() {
  static const Fields<ChainSpec> fields{
      vector_field("hip_distance", "m", &ChainSpec::hip_distance, "the hip's position, base axes"),
      orientation_field("hip_orientation", &ChainSpec::hip_orientation,
                        "hip to base axes: quaternion w,x,y,z, or roll,pitch,yaw angles"),
      port_only(Direction::output,
                vector_field("hip_force", "N", "",
                             "of the chain on the base in the step just taken, world axes; "
                             "engine dts with a force law only")),
      port_only(Direction::output,
                vector_field("hip_moment", "N.m", "", "the same: moment about the hip")),
  };
  return fields;
}

/// What joint `joint` of the chain accelerates: the inertia of its link and all further out about
/// its axis (their mass, for a prismatic joint) and of its rotor, and the size that such an inertia
/// is measured against.
struct MovedInertia {
  double value = 0., scale = 0.;
};
MovedInertia moved_inertia(const std::vector<LinkSpec>& links, std::size_t joint) {
  MovedInertia moved;
  Pose X_JL;
  for (std::size_t i = joint; i < links.size(); ++i) {
    if (i > joint) X_JL = X_JL * joint_pose(links[i]);
    const MassSpec& mass = links[i].body.mass;
    const Vector3d p_JC = X_JL.position + rotate(X_JL.orientation, mass.center_of_mass);
    const Symmetric3d I_C = rotate(rotation_matrix(X_JL.orientation), mass.inertia);
    const Symmetric3d I_J = I_C + point_inertia(mass.mass, p_JC);
    const bool turns = joint_type(links[joint].joint).turns;
    moved.value += turns ? I_J.zz : mass.mass;
    moved.scale += turns ? I_J.xx + I_J.yy + I_J.zz : mass.mass;
  }
  moved.value += links[joint].rotor_inertia;
  moved.scale += links[joint].rotor_inertia;
  return moved;
}

void check_joints(const std::vector<const language::Object*>& objects, const ChainSpec& chain,
                  Loading& loading) {
  for (std::size_t joint = 0; joint < chain.links.size(); ++joint) {
    const MovedInertia moved = moved_inertia(chain.links, joint);
    if (moved.value > 1e-12 * moved.scale) continue;
    const bool turns = joint_type(chain.links[joint].joint).turns;
    loading.error(
        place_of(*objects[joint], mass_field::mass),
        fmt::format("the joint of `{}` moves no {}: give the link, or one further out, a "
                    "mass{}",
                    chain.links[joint].body.name, turns ? "inertia about its axis" : "mass",
                    turns ? " and a shape or an `inertia`" : ""));
  }
}

}  // namespace

void add_chain_class(language::Schema& schema) {
  language::ClassSchema chain;
  chain.name = "Chain";
  chain.doc = "a leg or an arm: links in series, joined to the base at the hip";
  chain.naming = language::Naming::required;
  chain.top_level = true;
  chain.children = {"Link"};
  append(chain.children, component_families());
  chain.fields = schemas(chain_fields());
  schema.add(std::move(chain));
}

ChainSpec load_chain(const language::Object& object, std::string name, BodyIndex& next,
                     Loading& loading) {
  ChainSpec chain = load_fields(object, chain_fields());
  chain.name = std::move(name);
  const std::size_t errors_before = loading.diagnostics.error_count();
  const std::vector<const language::Object*> links = object.children_of("Link");
  for (const language::Object* link : links) {
    chain.links.push_back(load_link(*link, name_within(*link, object), loading));
    loading.bodies.emplace(link, next);
    ++next.body;
  }
  if (links.empty()) {
    loading.error(
        object.position,
        fmt::format("chain `{}` has no links; give it a Link NAME {{ ... }}", chain.name));
  }
  if (loading.diagnostics.error_count() == errors_before) check_joints(links, chain, loading);
  return chain;
}

}  // namespace hookpoint::simulation
