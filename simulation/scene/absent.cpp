// What an experiment cannot say, by the names that users of other programs look for. Each row is a
// message where the name is used; docs/limits.md says more about all of them.
#include "simulation/scene/absent.h"

#include <array>

#include "language/schema/absent.h"

namespace hookpoint::simulation {
namespace {

constexpr auto absent_words = std::to_array<language::Absent>({
    {"Terrain.", "motion|conveyor",
     "a belt has a `velocity`; ground that moves as a whole has a frame_velocity and a "
     "frame_angular_velocity"},
    {"Material", "rolling_friction|torsional_friction|spinning_friction",
     "write rolling_resistance or spinning_resistance, a length: the lever of the load"},
    {"Material", "yield_pressure|yield_stress|unloading_stiffness|cohesion",
     "no contact law keeps a footprint: the ground springs back"},
    {"Material", "suction|magnet|stickiness", "write adhesion, a force on each contact point"},
    {"Material.static_friction|Material.kinetic_friction", "...",
     "it is one coefficient, along the foot; friction_across is the one across it"},
    {"ContactPoint|Shape.|Base.",
     "friction|static_friction|kinetic_friction|mu|stiffness|damping|restitution",
     "constants of contact belong to a Material: write one and name it as `material`"},
    {"Link", "kinetic_friction|dynamic_friction|coulomb_friction|frictionloss",
     "dry friction of its joint is `friction`, and static_friction where it sticks; friction of the "
     "ground belongs to a Material, which the link names as `material`"},
    {"Link", "mu|restitution",
     "constants of contact belong to a Material: write one and name it as `material`"},
    {"Base.|Link", "contact.torque|contact.wrench",
     "a body publishes contact.force, contact.moment and contact.center_of_pressure"},
    {"Link", "reaction|reaction_torque|wrench",
     "what its joint transmits is reaction_force and reaction_moment"},
    {"Link.joint", "weld|rigid|none", "a link that moves with what carries it has `joint = fixed`"},
    {"Link.joint", "ball|spherical|universal|cylindrical|screw",
     "a joint has one axis: write several Links in a row, those between without mass"},
    {"Link.joint", "free|floating|planar|mobile",
     "only the base of a Robot moves freely: Base.mobile or Base.planar"},
    {"Link|Chain", "loop|connect|constraint",
     "links form a tree; what ties two of them together is a Loop in the robot"},
    {"Link", "gear|gear_ratio|couple|follows",
     "a joint that follows another names it as `mimic`, with mimic_ratio and mimic_offset"},
    {"", "Joint|Joint.|Constraint|Constraint.|Connect|Weld|Equality|Equality.",
     "each Link has the joint that carries it; a Loop closes a chain of links, and `mimic` in a Link "
     "couples its joint to another's"},
    {"", "Gear", "joints that turn together are coupled by `mimic` in a Link"},
    {"", "Tendon", "nothing ties more than two joints together; `mimic` in a Link couples two"},
    {"", "Shape.Mesh|Mesh",
     "the convex hull of a mesh is a Shape.Hull { file = \"part.stl\"; }; meshes of a URDF come "
     "with it: Include \"robot.urdf\" (meshes = hull)"},
    {"", "Shape.Plane|Plane|Ground", "the ground is a Terrain: Terrain.Flat or Terrain.Slope"},
    {"", "Body|Object",
     "a body that moves by itself is a Robot with a Base.mobile, one that stands an Obstacle; "
     "under touch = shapes bodies touch each other"},
});

}  // namespace

void add_absent_words() { language::add_absent(absent_words); }

}  // namespace hookpoint::simulation
