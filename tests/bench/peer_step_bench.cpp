// The standing hexapod, one step of 1 ms, in every engine: 19 bodies, 18 joints, six feet on the
// ground (docs/reference_engines.md).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "reference/engines.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"

namespace hookpoint {
namespace {

simulation::Experiment standing_hexapod() {
  const auto file =
      std::filesystem::path(testing::source_folder()) / "configs/scenes/standing_hexapod.hook";
  simulation::Experiment experiment = load_file(file).experiment.value();
  experiment.deltat = 1e-3;
  return experiment;
}

/// The same on six points, the tips of its tibiae, with no other point of its bodies to look after.
simulation::Experiment six_points() {
  simulation::Experiment experiment = standing_hexapod();
  simulation::RobotSpec& robot = experiment.robots[0];
  robot.base.boundary_points.clear();
  for (simulation::ChainSpec& leg : robot.chains)
    for (simulation::LinkSpec& link : leg.links) {
      std::vector<Vector3d>& points = link.body.boundary_points;
      if (link.body.name == "tibia")
        points = {*std::ranges::max_element(points, {}, &Vector3d::x)};
      else
        points.clear();
    }
  return experiment;
}

void step(benchmark::State& state, simulation::EngineFactory make,
          simulation::Experiment (*scene)()) {
  const auto engine = make(scene());
  for (int i = 0; i < 1000; ++i) engine->step();
  for (auto _ : state)
    if (!engine->step().ok()) state.SkipWithError("the step failed");
}

}  // namespace
}  // namespace hookpoint

int main(int argc, char** argv) {
  using namespace hookpoint;
  const auto add = [](const std::string& name, simulation::EngineFactory make) {
    benchmark::RegisterBenchmark(name.c_str(), step, make, standing_hexapod);
    benchmark::RegisterBenchmark((name + ", six points").c_str(), step, make, six_points);
  };
  add("dts", simulation::make_dts);
  for (const auto& peer : reference::peers())
    if (peer.found()) add(std::string(peer.name), peer.make);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
