// What a step costs with 1 to 100 free boxes under `touch = shapes`: side by side on a plane, and piled up
// in columns of ten. After the table it prints k of a time ~ n^k,
// between 10 and 100 boxes (docs/performance.md).
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/load_text.h"

namespace hookpoint::tests {
namespace {

constexpr int settled = 200;  // steps before the clock starts

/// Columns of `height` boxes, ten columns a row.
std::string boxes(int count, int height) {
  std::string text =
      "World w { gravity = 9.81; deltat = 0.1 ms; Material m { normal_stiffness = 20000; "
      "normal_damping = 60; tangential_stiffness = 20000; tangential_damping = 60; } "
      "Terrain.Flat ground { material = m; }\n";
  for (int i = 0; i < count; ++i) {
    const int column = i / height, level = i % height;
    text += "Robot b" + std::to_string(i) +
            " { Base.mobile { location = " + std::to_string(0.15 * (column % 10)) + ", " +
            std::to_string(0.15 * (column / 10)) + ", " + std::to_string(0.05 + 0.1 * level) +
            "; Shape.Box { dimensions = 0.1, 0.1, 0.1; mass = 0.5; } } }\n";
  }
  return text + "}";
}

void step(benchmark::State& state, int height) {
  const int count = static_cast<int>(state.range(0));
  const Loaded loaded = load_text(boxes(count, height));
  if (!loaded.experiment) {
    state.SkipWithError(loaded.diagnostics.c_str());
    return;
  }
  const auto engine = simulation::make_dts(*loaded.experiment);
  for (int i = 0; i < settled; ++i)
    if (!engine->step().ok()) state.SkipWithError("the step failed");
  for (auto _ : state)
    if (!engine->step().ok()) state.SkipWithError("the step failed");
  state.SetComplexityN(count);
}

void SideBySide(benchmark::State& state) { step(state, 1); }
void InColumnsOfTen(benchmark::State& state) { step(state, 10); }

BENCHMARK(SideBySide)->Arg(1)->Arg(3)->Arg(10)->Arg(30)->Arg(100)->Unit(benchmark::kMicrosecond);
BENCHMARK(InColumnsOfTen)->Arg(10)->Arg(30)->Arg(100)->Unit(benchmark::kMicrosecond);

/// Prints what every reporter on the console does, then the exponents.
class WithExponents : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const std::string name = run.run_name.function_name;
      if (run.run_type == Run::RT_Iteration || run.aggregate_name == "median")
        times_[name][std::atoi(run.run_name.args.c_str())] = run.GetAdjustedCPUTime();
    }
    ConsoleReporter::ReportRuns(runs);
  }
  void Finalize() override {
    for (const auto& [name, times] : times_) {
      if (!times.contains(10) || !times.contains(100)) continue;
      std::printf("%s: time a step ~ n^%.2f between 10 and 100 boxes\n", name.c_str(),
                  std::log10(times.at(100) / times.at(10)));
    }
  }

 private:
  std::map<std::string, std::map<int, double>> times_;
};

}  // namespace
}  // namespace hookpoint::tests

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  hookpoint::tests::WithExponents reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
