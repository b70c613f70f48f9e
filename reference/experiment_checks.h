// What a peer refuses or does otherwise, in one voice: every gap is data (EngineDescription::gaps),
// and whatever an experiment needs of it is named, with what to change.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::reference {

/// Features that a gap may name.
namespace feature {
inline constexpr std::string_view chains = "robots with chains";
inline constexpr std::string_view planar = "bases that are kept in a plane";
inline constexpr std::string_view loops = "loops of links";
inline constexpr std::string_view compliant_loops = "loops with a stiffness";
inline constexpr std::string_view couplings = "coupled joints (mimic)";
inline constexpr std::string_view points = "boundary points that touch";
inline constexpr std::string_view prismatic = "prismatic joints";
inline constexpr std::string_view massless = "links without mass";
inline constexpr std::string_view no_inertia = "bodies with mass and without inertia";
inline constexpr std::string_view joint_limits = "joint limits";
inline constexpr std::string_view rotors = "rotor inertias";
inline constexpr std::string_view two_frictions = "static friction that differs from kinetic";
inline constexpr std::string_view restitution = "restitution";
inline constexpr std::string_view tile_friction = "friction of single tiles";
inline constexpr std::string_view tile_softness = "stiffness and damping of single tiles";
inline constexpr std::string_view unmatched_softness =
    "stiffness and damping of single tiles without `settings = matched`";
inline constexpr std::string_view foot_softness =
    "stiffness and damping of several foot materials at `settings = matched`";
inline constexpr std::string_view tile_restitution = "restitution of single tiles";
inline constexpr std::string_view height_field = "height fields";
inline constexpr std::string_view legcone = "the shape Legcone";
inline constexpr std::string_view cylinder = "the shape Cylinder";
inline constexpr std::string_view disc = "the shape Disc";
inline constexpr std::string_view lying_cylinder = "cylinders and wheels that roll";
inline constexpr std::string_view capsule = "the shape Capsule";
inline constexpr std::string_view hull = "the shape Hull";
inline constexpr std::string_view obstacles = "obstacles";
inline constexpr std::string_view moving_obstacles = "obstacles that move";
inline constexpr std::string_view points_on_obstacles = "boundary points on obstacles";
inline constexpr std::string_view between_robots = "robots that touch each other";
inline constexpr std::string_view wired_gravity = "gravity that a wire drives";
inline constexpr std::string_view belt = "ground whose material moves (velocity)";
inline constexpr std::string_view moving_frame = "ground that moves (frame_velocity)";
inline constexpr std::string_view law = "contact laws and integrators";
inline constexpr std::string_view surface_forces =
    "adhesion, rolling and spinning resistance, friction across";
inline constexpr std::string_view hips = "hip_force and hip_moment of a Chain";
inline constexpr std::string_view saving = "states that are saved and restored";
/// All of them.
inline constexpr std::array all{
    chains,
    planar,
    loops,
    compliant_loops,
    couplings,
    points,
    prismatic,
    massless,
    no_inertia,
    joint_limits,
    rotors,
    two_frictions,
    restitution,
    tile_friction,
    tile_softness,
    unmatched_softness,
    foot_softness,
    tile_restitution,
    height_field,
    legcone,
    cylinder,
    disc,
    lying_cylinder,
    capsule,
    hull,
    obstacles,
    moving_obstacles,
    points_on_obstacles,
    between_robots,
    wired_gravity,
    belt,
    moving_frame,
    law,
    surface_forces,
    hips,
    saving,
};
}  // namespace feature

/// A feature that an experiment needs, and where.
struct FeatureUse {
  std::string_view feature;
  std::string where;  ///< "robot 'hexapod' has chains"
};
std::vector<FeatureUse> features_used(const simulation::Experiment& experiment);

/// A gap of one engine.
struct OwnGap {
  std::string_view feature;
  simulation::EngineGap::Handling handling;
  const char* instead;  ///< what the engine does, or what to use
};
inline constexpr OwnGap single_friction_gap{
    feature::two_frictions, simulation::EngineGap::Handling::noticed,
    "this engine has one coefficient of friction, and it is the kinetic one"};

/// Of a shape that touches, the feature that an engine may lack; empty of a box and a ball, which every
/// engine has.
std::string_view feature_of(const simulation::ShapeGeometry& geometry);
/// The experiment with the samples of the shapes which `engine` lacks in their place.
simulation::Experiment with_samples(simulation::Experiment experiment,
                                    const simulation::EngineDescription& engine);

/// The gaps that every peer has (its own law and integrator, no hips, nothing to resume from), then
/// those of one engine.
std::vector<simulation::EngineGap> common_gaps_and(std::span<const OwnGap> own);
std::vector<simulation::EngineGap> common_gaps_and(std::vector<simulation::EngineGap> own);

bool has_gap(const simulation::EngineDescription& engine, std::string_view feature);

/// What the user should know of the experiment's run in that engine, one line a gap that it meets
/// and that is `noticed`. Throws ExperimentError where the gap is `refused`, or where the engine cannot
/// run the experiment: a mobile body without mass or, on a terrain, with nothing that touches.
std::vector<std::string> check_supported(const simulation::Experiment& experiment,
                                         const simulation::EngineDescription& engine);

/// Whether a shape or a point of the body has a material of its own.
bool has_material(const simulation::BodySpec& body);
/// A material by its index; the constants' defaults where the experiment has none.
contact::MaterialConstants<double> material_at(const simulation::Experiment& experiment,
                                               int material);
/// The one material of all that touches; no_material where it is of several.
int sole_foot_material(const simulation::Experiment& experiment);
/// What the ground, where no patch lies, and all that touches it make together. Where what touches is of
/// several materials, the ground's; the constants' defaults where there is no terrain.
contact::MaterialConstants<double> ground_material(const simulation::Experiment& experiment);

/// The one coefficient of friction of an engine that has no other: the kinetic one.
inline double single_friction(const contact::MaterialConstants<double>& material) {
  return material.kinetic_friction;
}

}  // namespace hookpoint::reference
