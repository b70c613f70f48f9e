#include "reference/unread_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "contact/laws/surface_forces.h"
#include "simulation/experiment/material_fields.h"

namespace hookpoint::reference {
namespace {

using Constants = contact::MaterialConstants<double>;
using Constant = double Constants::*;

bool has_a_gap_of_its_own(Constant constant) {
  constexpr std::array told{&Constants::static_friction, &Constants::kinetic_friction,
                            &Constants::restitution};
  return std::ranges::count(told, constant) > 0 ||
         std::ranges::count(contact::surface_constants, constant) > 0;
}

/// Those of `constants` that the engine reads at a setting.
std::vector<Constant> read_at(const simulation::EngineDescription& engine,
                              const std::string& settings, std::span<const Constant> constants) {
  std::vector<Constant> read;
  const auto reads = engine.reads.find(settings);
  if (reads == engine.reads.end()) return read;
  for (const Constant constant : constants)
    if (std::ranges::count(reads->second, simulation::field_of(constant).name) > 0)
      read.push_back(constant);
  return read;
}

/// "; `settings = matched` reads `normal_stiffness`": of the first setting that reads some of them.
std::string what_reads(const simulation::EngineDescription& engine,
                       std::span<const Constant> constants) {
  for (const std::string& settings : engine.settings) {
    const std::vector<Constant> read = read_at(engine, settings, constants);
    if (!read.empty())
      return fmt::format("; `settings = {}` reads {}", settings, simulation::quoted_fields(read));
  }
  return "";
}

}  // namespace

std::vector<std::string> notices_of_unread_constants(const simulation::Experiment& experiment,
                                                     const simulation::EngineDescription& engine) {
  std::vector<std::string> notices;
  if (!engine.reads.contains(experiment.settings)) return notices;
  for (const simulation::MaterialSpec& material : experiment.materials) {
    std::vector<Constant> unread = material.meant;
    std::erase_if(unread, has_a_gap_of_its_own);
    for (const Constant read : read_at(engine, experiment.settings, unread))
      std::erase(unread, read);
    if (unread.empty()) continue;
    notices.push_back(fmt::format("engine {}: {} of material '{}' {} not read at `settings = {}`{}",
                                  engine.name, simulation::quoted_fields(unread), material.name,
                                  unread.size() == 1 ? "is" : "are", experiment.settings,
                                  what_reads(engine, unread)));
  }
  return notices;
}

}  // namespace hookpoint::reference
