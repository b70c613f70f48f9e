// Constants of Materials that a file states for this run and that a peer does not read.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "contact/vocabulary.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::reference {

/// What a peer makes its contacts of at `settings = matched`, beside friction; at its other settings
/// contacts have the library's own softness.
inline constexpr std::array<double contact::MaterialConstants<double>::*, 4> spring_and_damper{
    &contact::MaterialConstants<double>::normal_stiffness,
    &contact::MaterialConstants<double>::normal_damping,
    &contact::MaterialConstants<double>::tangential_stiffness,
    &contact::MaterialConstants<double>::tangential_damping};

/// A notice of each material of `experiment` that states such (MaterialSpec::meant), where `engine` says
/// what it reads at the experiment's settings. Friction, restitution and what acts beside a law have gaps
/// of their own.
std::vector<std::string> notices_of_unread_constants(const simulation::Experiment& experiment,
                                                     const simulation::EngineDescription& engine);

}  // namespace hookpoint::reference
