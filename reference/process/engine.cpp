#include "reference/process/engine.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "reference/experiment_checks.h"
#include "reference/peer.h"
#include "reference/process/pool.h"
#include "reference/process/world.h"
#include "reference/unread_constants.h"

namespace hookpoint::reference {

ProgramEngine::ProgramEngine(ProgramDefinition definition)
    : pool_(std::make_shared<ProgramPool>(std::move(definition))) {}

const ProgramDefinition& ProgramEngine::definition() const { return pool_->definition(); }

simulation::EngineDescription ProgramEngine::describe() const { return pool_->describe(); }

std::unique_ptr<simulation::Engine> ProgramEngine::make(
    const simulation::Experiment& experiment) const {
  simulation::EngineDescription engine = describe();
  if (!engine.found)
    throw simulation::ExperimentError("engine " + engine.name + ": " + engine.missing);
  check_settings(experiment, engine);
  std::vector<std::string> notices = check_supported(experiment, engine);
  std::ranges::move(notices_of_unread_constants(experiment, engine), std::back_inserter(notices));
  return make_peer_engine(
      experiment,
      {std::move(engine),
       [pool = pool_](const simulation::Experiment& of) { return make_program_world(of, pool); }},
      std::move(notices));
}

}  // namespace hookpoint::reference
