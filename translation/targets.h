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
  /// Those nearest to what is wanted.
  Parameters (*nearest)(const Wanted& wanted, const Situation& at) = nullptr;
  /// What they do, whatever they are.
  Behaviour (*behaviour)(const Parameters& parameters, const Situation& at) = nullptr;
  /// Static and kinetic coefficient of friction that they make of two like surfaces.
  Wanted (*friction)(const Parameters& parameters) = nullptr;
  /// To paste, in the engine's own syntax.
  std::string (*snippet)(const Parameters& parameters, const Situation& at) = nullptr;
  /// What the engine cannot express of what is wanted, and how it may differ.
  std::vector<std::string> (*cannot)(const Wanted& wanted, const Situation& at) = nullptr;
};

/// In the order of the manual.
std::span<const Target* const> targets();
/// Null for an unknown name.
const Target* find_target(std::string_view name);
/// Of an engine with one coefficient: it is both.
Wanted one_friction(double friction);
/// The note of an engine with one coefficient, where two are wanted; "" where they are alike.
std::string one_friction_note(const Wanted& wanted);
/// `note`, unless it is empty, at the end of `notes`.
void add_note(std::vector<std::string>& notes, std::string note);

extern const Target mujoco_target, ode_target, gazebo_target, bullet_target, pybullet_target,
    dart_target, simbody_target, drake_target, drake_hydroelastic_target, newton_target,
    physx_target, genesis_target, raisim_target;

}  // namespace hookpoint::translation
