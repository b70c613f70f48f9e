// What of a run is known before it starts, for the metrics and their closed forms.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "contact/terrain/terrain.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/experiment.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::studies {

/// What of a run is known before it starts: the body measured (studies/measure/measured_body.h),
/// the ground under its start and the direction in which it is driven.
struct RunContext {
  const simulation::Experiment* experiment = nullptr;
  std::optional<contact::Terrain> ground;
  int robot = 0;            ///< index of the robot measured
  std::size_t body = 0;     ///< index of its base in WorldState::bodies, where its links follow
  std::size_t watched = 0;  ///< index there of the body that Observation::body is: base or link
  double settle = 0.;       ///< [s]
  double duration = 0.;     ///< [s]
  Vector3d start;           ///< p_WB at time 0 of the body that is watched [m]
  Quaterniond start_orientation;  ///< R_WB at time 0 of the same
  Vector3d normal;                ///< of the ground under the start, unit
  Vector3d downhill;   ///< unit, in the ground's plane: steepest descent; on the level, along the
                       ///< base's initial velocity
  double weight = 0.;  ///< m |g| [N], of the whole robot
  /// Of an engine with one coefficient of friction, the kinetic one (EngineDescription::one_friction).
  bool one_friction = false;
  simulation::EngineFactory make =
      nullptr;  ///< of the run's engine, where a metric may run another

  const simulation::RobotSpec& robot_spec() const {
    return experiment->robots[static_cast<std::size_t>(robot)];
  }
};

/// `body`: the trail of the body measured, as studies/measure/measured_body.h takes it. Throws
/// simulation::ExperimentError when there is none or it cannot move.
RunContext make_context(const simulation::Experiment& experiment, double settle, double duration,
                        std::string_view body = {});

/// Along the ground's normal [m]; infinite without ground.
double height_over_ground(const RunContext& context, const Vector3d& point);

/// Calls `visit(body, state)` for the base and the links of the measured robot, chain by chain.
template <class Visit>
void for_each_body(const RunContext& context, const simulation::WorldState& world, Visit visit) {
  std::size_t index = context.body;
  simulation::for_each_body(context.robot_spec(), [&](const simulation::BodySpec& body) {
    visit(body, world.bodies[index++]);
  });
}

/// Calls `visit(force, body, arm)` for each single force of the ground on the measured robot; the
/// arm is from the body's origin to where it acts, world axes [m].
template <class Visit>
void for_each_ground_force(const RunContext& context, const simulation::WorldState& world,
                           Visit visit) {
  const std::size_t end = context.body + simulation::body_count(context.robot_spec());
  for (const simulation::GroundForce& force : world.ground_forces) {
    if (force.body < context.body || force.body >= end) continue;
    const simulation::BodyState& body = world.bodies[force.body];
    visit(force, body, rotate(body.orientation, force.point));
  }
}

/// Static friction of the ground under the start; none without ground.
std::optional<double> static_friction(const RunContext& context);

/// Kinetic energy of the bodies of the measured robot [J].
double kinetic_energy(const RunContext& context, const simulation::WorldState& world);
/// Kinetic and gravitational energy of the bodies of the measured robot [J].
double mechanical_energy(const RunContext& context, const simulation::WorldState& world);

}  // namespace hookpoint::studies
