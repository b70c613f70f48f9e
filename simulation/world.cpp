#include "simulation/world.h"

#include <utility>

namespace hookpoint::simulation {

World::World(const Experiment& experiment, std::unique_ptr<Engine> engine)
    : experiment_(experiment), engine_(std::move(engine)), signals_(experiment, *engine_) {
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

Resumable& World::resumable() const {
  if (Resumable* resumable = engine_->resumable()) return *resumable;
  throw ExperimentError("engine `" + experiment_.engine +
                        "` cannot be saved and resumed exactly: its library keeps what its solver "
                        "remembers to itself; with `engine = dts` a run can");
}

std::vector<StateSection> World::state_layout() const {
  const Resumable& engine = resumable();
  std::vector<StateSection> sections{
      {"engine " + experiment_.engine, engine.state_layout(), engine.state_size()}};
  for (StateSection& section : signals_.state_layout()) sections.push_back(std::move(section));
  return sections;
}

std::size_t World::state_size() const { return resumable().state_size() + signals_.state_size(); }

void World::save(std::span<double> numbers) const {
  const Resumable& engine = resumable();
  const std::size_t size = engine.state_size();
  engine.save(numbers.first(size));
  signals_.save(numbers.subspan(size));
}

void World::restore(std::span<const double> numbers) {
  Resumable& engine = resumable();
  const std::size_t size = engine.state_size();
  engine.restore(numbers.first(size));
  signals_.restore(numbers.subspan(size));
}

}  // namespace hookpoint::simulation
