// What an experiment cannot say, by the names that users of other programs look for. Each row is a
// message where the name is used; docs/limits.md says more about all of them.
#include "simulation/scene/absent.h"

#include <array>

#include "language/schema/absent.h"

namespace hookpoint::simulation {
namespace {

constexpr auto absent_words = std::to_array<language::Absent>({
    {"Terrain.", "velocity|angular_velocity|motion|conveyor",
     "the ground does not move; in the ground's own frame a Force on each body stands for its "
     "acceleration"},
    {"World.gravity", "input",
     "gravity is constant during a run; a Force on a body, wired, stands for its changes"},
    {"Material", "rolling_friction|rolling_resistance|torsional_friction|spinning_friction",
     "no contact law resists rolling or spinning; a Force whose torque an Expression wires "
     "against the spin does"},
    {"Material", "yield_pressure|yield_stress|unloading_stiffness|cohesion",
     "no contact law keeps a footprint: the ground springs back"},
    {"Material", "adhesion|suction|magnet|stickiness",
     "no contact law pulls; a Force that an Expression switches by `contact.count` does"},
    {"Material.static_friction|Material.kinetic_friction", "...",
     "friction is the same in all directions"},
    {"ContactPoint|Shape.|Base.|Link",
     "material|friction|static_friction|kinetic_friction|mu|stiffness|damping|restitution",
     "constants of contact belong to the ground: a Material of the Terrain, or of a Patch of it"},
    {"Base.|Link", "contact.moment|contact.torque|contact.center_of_pressure|contact.wrench",
     "a body publishes contact.force and contact.count; named ContactPoints publish position and "
     "force each, for an Expression to add up"},
    {"Link", "reaction|reaction_force|reaction_torque|wrench",
     "of joints, the first of a Chain publishes its reaction: hip_force and hip_moment"},
    {"Link.joint", "fixed|weld",
     "what is fixed to a link is part of it: give that link the shapes, and mass, center_of_mass "
     "and inertia of both"},
    {"Link.joint", "ball|spherical|universal|cylindrical|screw",
     "a joint has one axis: write several Links in a row, those between without mass"},
    {"Link.joint", "free|floating|planar|mobile",
     "only the base of a Robot moves freely: Base.mobile or Base.planar"},
    {"Link|Chain|Robot", "loop|connect|constraint|mimic|gear",
     "links form a tree: nothing ties two of them together"},
    {"", "Joint|Joint.|Constraint|Constraint.|Connect|Weld|Equality|Equality.|Tendon|Gear",
     "links form a tree, each Link with the joint that carries it: nothing ties two of them "
     "together"},
    {"", "Shape.Capsule|Capsule", "write a Shape.Cylinder and two Shape.Spheres"},
    {"", "Shape.Mesh|Mesh", "meshes come with a URDF: Include \"robot.urdf\" (meshes = hull)"},
    {"", "Shape.Plane|Plane|Ground", "the ground is a Terrain: Terrain.Flat or Terrain.Slope"},
    {"", "Body|Object",
     "a body that moves by itself is a Robot with a Base.mobile; bodies of two Robots do not "
     "meet"},
});

}  // namespace

void add_absent_words() { language::add_absent(absent_words); }

}  // namespace hookpoint::simulation
