// The runner of studies with an engine of the tests' own, whose motion is known.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reference/engines.h"
#include "simulation/scene/schema.h"
#include "studies/blocks/schema.h"
#include "studies/run/run.h"
#include "tests/support/text.h"

namespace hookpoint::studies {

using simulation::Experiment;
using simulation::StepStatus;

/// Slides down its slope at 2 mm/s, plus a millimetre a second per radian of slope; breaks at 0.5 s
/// where friction is 13.
class Slider : public simulation::Engine {
 public:
  explicit Slider(const Experiment& experiment, double part = 1.)
      : context_(make_context(experiment, 0., 1.)),
        break_(experiment.materials[0].constants.static_friction == 13.) {
    const double slope = std::get<contact::SlopeSurface>(experiment.terrain->surface).angle;
    speed_ = part * (2e-3 + 1e-3 * slope);
    dt_ = experiment.deltat;
    world_.bodies.resize(1);
    place();
  }
  StepStatus step() override {
    ++steps_taken;
    if (break_ && world_.time > 0.5)
      return {StepStatus::Kind::not_finite, world_.time, "block.base", "halve deltat"};
    world_.time = static_cast<double>(++world_.step) * dt_;
    place();
    return {};
  }
  const simulation::WorldState& state() const override { return world_; }
  simulation::WorldInputs& inputs() override { return inputs_; }

  static inline std::atomic<long> steps_taken = 0;

 private:
  void place() {
    world_.bodies[0].position = context_.start + speed_ * world_.time * context_.downhill;
  }
  RunContext context_;
  bool break_;
  double speed_ = 0., dt_ = 0.;
  simulation::WorldState world_;
  simulation::WorldInputs inputs_;
};

inline constexpr const char* slider_scene = R"(
Param slope = 10 deg;
Param mu = 0.8;
Param dt = 10 ms;
World world {
  deltat = dt;
  Material surface { static_friction = mu; kinetic_friction = mu; }
  Terrain.Slope ground { angle = slope; material = surface; }
  Robot block { Base.mobile { rest_on = ground; Shape.Box { dimensions = 0.2, 0.2, 0.1; mass = 1 kg; } } }
}
)";

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

class StudyRunner : public ::testing::Test {
 protected:
  StudyRunner() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hookpoint-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    simulation::add_experiment_classes(schema_, reference::peer_choices());
    add_study_classes(schema_);
    write("scene.hook", slider_scene);
    for (const char* name : {"dts", "ode"})
      engines_.add(name, {described_as({"dts", "test", "double", true, {}, {}}), make});
    Slider::steps_taken = 0;
  }
  ~StudyRunner() override { std::filesystem::remove_all(folder_); }

  static std::unique_ptr<simulation::Engine> make(const Experiment& experiment) {
    return std::make_unique<Slider>(experiment);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string read(const std::filesystem::path& path) const {
    return hookpoint::testing::read_file(path);
  }
  std::optional<StudyPlan> plan(const std::string& text, const PlanOptions& options = {}) {
    write("study.hook", text);
    // A plan loads its scenes from it for as long as it is used.
    language::Library& library = *libraries_.emplace_back(
        std::make_unique<language::Library>(schema_, std::vector<std::filesystem::path>{}));
    diagnostics_ = {};
    const auto root = library.evaluate(folder_ / "study.hook", {}, diagnostics_);
    if (!root) return std::nullopt;
    return make_plan(*root, *root->children_of("Study").front(), (folder_ / "study.hook").string(),
                     library, engines_, options, diagnostics_);
  }
  StudyRun run(const StudyPlan& plan, const std::string& name, int jobs = 1, bool resume = false,
               std::function<void(const Progress&)> progress = {}) {
    RunOptions options{jobs, resume, folder_ / name, std::move(progress), {}};
    return run_study(plan, engines_, options, stop_);
  }
  std::string first_error() const {
    return diagnostics_.all().empty() ? "" : diagnostics_.all().front().message;
  }

  std::filesystem::path folder_;
  language::Schema schema_;
  std::vector<std::unique_ptr<language::Library>> libraries_;
  EngineTable engines_;
  language::Diagnostics diagnostics_;
  std::atomic<bool> stop_{false};
};

}  // namespace hookpoint::studies
