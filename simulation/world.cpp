#include "simulation/world.h"

#include <utility>

namespace hookpoint::simulation {

World::World(const Experiment& experiment, std::unique_ptr<Engine> engine)
    : engine_(std::move(engine)), signals_(experiment, *engine_) {
  signals_.update(0);
}

StepStatus World::step() {
  if (!signals_.running()) return {};
  const StepStatus status = engine_->step();
  if (status.ok()) signals_.update(engine_->state().step);
  return status;
}

std::string World::ended() const {
  if (signals_.quit()) return "Simulator.quit is true";
  if (!signals_.running())
    return "World.running is false, and nothing can set it true again while time stands still";
  return "";
}

}  // namespace hookpoint::simulation
