// Advice in place of trial and error: the ground's constants from the weight that it carries, a
// penetration that the user allows and a rebound that the user wants, the steps that they permit,
// and which constant to change (docs/advice.md derives the numbers).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/vocabulary.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

struct AdviceWishes {
  std::optional<double> penetration;  ///< at rest [m]; none: the material's nominal_penetration
  std::optional<double> rebound;      ///< rebound speed over impact speed; none: the
                                      ///< material's restitution, or 0.1 where that is 0
  double impact_speed = 0.1;          ///< [m/s], for laws whose rebound depends on it
};

/// A constant of a material, as it is and as it should be. SI.
struct ConstantAdvice {
  /// What it is advised for: the depth at rest, the rebound, or friction that suits them.
  enum class Aim { depth, rebound, friction };
  Aim aim = Aim::friction;
  std::string name, unit;
  double present = 0., advised = 0.;
  std::string reason;
};

/// A material under a robot.
struct GroundAdvice {
  std::string robot, material;
  std::size_t points = 0;         ///< that carry the robot, on this material
  double load = 0.;               ///< on each, the weight shared evenly [N]
  double mass = 0.;               ///< above each, load / g [kg]
  double least_mass = 0.;         ///< effective mass of an impact at one, joints free [kg]
  double depth = 0.;              ///< at rest with the present constants [m]
  double wanted_depth = 0.;       ///< [m]
  std::optional<double> rebound;  ///< with the present constants; none for a law without one
  double wanted_rebound = 0.;
  std::vector<ConstantAdvice> constants;
  contact::MaterialConstants<double> advised;
  /// The highest vertical speed at which the robot may bob without a foot losing its hook [m/s], by
  /// the energy that the law's spring holds at rest: sqrt(g depth) for a linear spring, so g
  /// sqrt(m/k), for `nominal` sqrt(g d0); with the present and with the advised constants.
  double survival_present = 0., survival_advised = 0.;
};

/// The largest stable step of an integrator [s].
struct StepAdvice {
  std::string integrator;
  double present = 0., advised = 0.;
  std::string not_computed = {};  ///< StabilityBound::not_computed of the first; both are infinite
};

struct Advice {
  std::vector<GroundAdvice> grounds;
  std::vector<StepAdvice> steps;         ///< of every integrator with a fixed step
  std::vector<std::string> controllers;  ///< of joints, whose loops are in the steps
  std::vector<std::string> left_out;     ///< feedback that is not, with the reason
  std::vector<std::string> changes;      ///< which constant to change, and why; empty: none
};

/// Of an experiment under engine dts and a force law, at its initial state. Points carry a robot if
/// they touch then; of a robot that does not touch, those within 1 mm of its lowest. Throws
/// ExperimentError where there is nothing to advise on (no ground, an impulse law, a peer). A few
/// eigenvalue problems of size 3 points each.
Advice advise(const Experiment& experiment, const AdviceWishes& wishes);

}  // namespace hookpoint::simulation
