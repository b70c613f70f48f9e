// Runs an experiment from the language's text, as the command does, and reads it by its trails.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulation/dts_engine/dts_engine.h"
#include "simulation/run/world.h"
#include "tests/support/load_text.h"

namespace hookpoint {

/// A world in time, under our engine unless another is given.
class Running {
 public:
  explicit Running(const Loaded& loaded, simulation::EngineFactory make = simulation::make_dts) {
    if (!loaded.experiment) throw std::runtime_error(loaded.diagnostics);
    experiment_ = std::make_unique<simulation::Experiment>(*loaded.experiment);
    world_ = std::make_unique<simulation::World>(*experiment_, make(*experiment_));
    ports_ = world_->ports();
  }
  explicit Running(const std::string& text, simulation::EngineFactory make = simulation::make_dts)
      : Running(load_text(text), make) {}

  simulation::World& world() { return *world_; }
  simulation::Port port(const std::string& trail) const {
    return simulation::find_port(*experiment_, ports_, trail);
  }
  double operator[](const std::string& trail) const { return *port(trail).value; }
  void step(int steps = 1) {
    for (int i = 0; i < steps; ++i) {
      if (!world_->step().ok()) throw std::runtime_error("the step failed");
    }
  }
  /// `trail` at steps 0 ... `steps`.
  std::vector<double> record(const std::string& trail, int steps) {
    const double* value = port(trail).value;
    std::vector<double> values{*value};
    for (int i = 0; i < steps; ++i) {
      step();
      values.push_back(*value);
    }
    return values;
  }

 private:
  std::unique_ptr<simulation::Experiment> experiment_;
  std::unique_ptr<simulation::World> world_;
  std::vector<simulation::Port> ports_;
};

}  // namespace hookpoint
