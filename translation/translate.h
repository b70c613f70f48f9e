// A material as parameters of an engine, and an engine's parameters as a material.
#pragma once

#include <string>
#include <vector>

#include "contact/force_law.h"
#include "translation/targets.h"

namespace hookpoint::translation {

/// One engine's parameters, and what they do.
struct Translation {
  const Target* target;
  Parameters parameters;
  Behaviour behaviour;
  std::vector<std::string> cannot;
};

/// What a contact should do of `material` under `law` at the load: its static depth as a linear
/// spring, and damper, tangential spring and damper linearised there. Throws ParameterError where
/// nothing holds the load.
DesiredContact desired_of(const contact::LawDescription& law, const contact::Constants& material,
                          const Situation& at);
/// What hookpoint's own law does, in closed form: no creep but the law's own, and the largest step
/// of semi-implicit Euler.
Behaviour behaviour_of(const contact::LawDescription& law, const contact::Constants& material,
                       const Situation& at);

Translation translate_to(const Target& target, const DesiredContact& desired, const Situation& at);

/// An engine's parameters from "key=value" settings, those not given at the engine's defaults, and
/// the contact that they make. Throws ParameterError.
struct Reading {
  Translation from;
  /// The spring and damper with the same depth, damping (of other than a linear damper: rebound), creep
  /// and friction; the damper along the ground of a contact that does not creep is the normal's.
  DesiredContact desired;
};
Reading read_from(const Target& target, const std::vector<std::string>& settings,
                  const Situation& at);

}  // namespace hookpoint::translation
