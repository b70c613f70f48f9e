// The engines that constants are translated to, one row each.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "translation/parameters.h"
#include "translation/situation.h"

namespace hookpoint::translation {

/// How the predictions of an engine are known to hold.
enum class Basis {
  measured,  ///< a test gives the parameters to the engine itself and measures
  formula    ///< from its source or manual alone: not run here
};

/// One row: an engine, its parameters, and what they do. targets/NAME.cpp has it.
struct Target {
  std::string_view name;   ///< as in `--to mujoco`
  std::string_view title;  ///< "MuJoCo"
  Basis basis = Basis::formula;
  std::string_view source;  ///< where the formulas come from
  std::span<const Parameter> parameters;
  /// Those nearest to what is desired.
  Parameters (*nearest)(const DesiredContact& desired, const Situation& at) = nullptr;
  /// What they do, whatever they are.
  Behaviour (*behaviour)(const Parameters& parameters, const Situation& at) = nullptr;
  /// Which of the parameters are its coefficients of friction; one of an engine that has one.
  std::string_view static_friction, kinetic_friction;
  /// To paste, in the engine's own syntax.
  std::string (*snippet)(const Parameters& parameters, const Situation& at) = nullptr;
  /// What the engine cannot express of what is desired, and how it may differ.
  std::vector<std::string> (*cannot)(const DesiredContact& desired, const Situation& at) = nullptr;
};

/// In the order of the manual.
std::span<const Target* const> targets();
/// Null for an unknown name.
const Target* find_target(std::string_view name);
/// What there is to say of an engine with one coefficient of friction where two are desired.
std::vector<std::string> notes_on_friction(const DesiredContact& desired);

extern const Target mujoco_target, ode_target, gazebo_target, bullet_target, pybullet_target,
    dart_target, simbody_target, drake_target, drake_hydroelastic_target, newton_target,
    physx_target, genesis_target, raisim_target;

}  // namespace hookpoint::translation
