// What the language's wires, controllers, lines and records cost a run: the walking hexapod with 18
// wired PD controllers, 18 sampled and delayed lines and 24 recorded channels, beside the same
// robot under the same control written in C++ against the engine alone (docs/performance.md).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "control/registry.h"
#include "simulation/dts_engine/dts_engine.h"
#include "simulation/run/records.h"
#include "simulation/run/world.h"
#include "tests/support/load_text.h"

namespace hookpoint::tests {
namespace {

constexpr std::array links{"coxa", "femur", "tibia"};
constexpr double pconstant = 60., dconstant = 0.3;
constexpr double deltat = 0.5e-3;

std::string link_trail(int joint) {
  return "hexapod.leg[" + std::to_string(joint / 3) + "]." + links[joint % 3];
}

/// 18 PD controllers, their goals over lines of 200 Hz and 5 ms, and a record of 24 channels.
std::string signals(const std::string& format, const std::string& rate) {
  std::string text;
  for (int joint = 0; joint < 18; ++joint) {
    const std::string link = link_trail(joint);
    text += "Controller.PD pd[" + std::to_string(joint) +
            "] { pconstant = 60; dconstant = 0.3; Wire FROM gait.goal[" + std::to_string(joint) +
            "] TO goal { rate = 200 Hz; delay = 5 ms; } Wire FROM " + link +
            ".angle TO current; Wire FROM " + link + ".rate TO rate_in; Wire TO " + link +
            ".torque FROM output; }\n";
  }
  if (format.empty()) return text;
  text += "Record walk { format = " + format + "; " + rate + " trails = ";
  for (int joint = 0; joint < 18; ++joint) text += link_trail(joint) + ".angle, ";
  text +=
      "hexapod.base.location.x, hexapod.base.location.y, hexapod.base.location.z, "
      "hexapod.base.velocity.x, hexapod.base.velocity.y, hexapod.base.velocity.z; }\n";
  return text;
}

simulation::Experiment experiment(const std::string& format, const std::string& rate = "",
                                  bool wired = true) {
  const std::string text =
      "World world { gravity = 9.81; deltat = 0.5 ms; duration = 20 s;\n"
      "Include \"materials/rigid_floor.hook\" (load = 7 N, allowance = 0.7 mm, damping_ratio = "
      "0.1);\nTerrain.Flat ground { material = rigid_floor; }\n"
      "Include \"robots/hexapod18.hook\" (height = 0.1 m);\n"
      "Include \"controllers/tripod.hook\";\n" +
      (wired ? signals(format, rate) : "") + "}\n";
  const Loaded loaded = load_text(text);
  if (!loaded.experiment) throw std::runtime_error(loaded.diagnostics);
  return *loaded.experiment;
}

/// The run that the file describes.
class Wired {
 public:
  Wired(const std::string& format, const std::string& rate)
      : experiment_(experiment(format, rate)),
        world_(experiment_, simulation::make_dts(experiment_)),
        folder_(std::filesystem::temp_directory_path() / "hookpoint_overhead"),
        records_(experiment_, world_.ports(), folder_, {}) {}
  ~Wired() {
    records_.close();
    std::filesystem::remove_all(folder_);
  }
  void step() {
    if (!world_.step().ok()) throw std::runtime_error("the wired run failed");
    records_.row(world_.state().step, world_.state().time);
  }
  double walked() const { return world_.state().bodies[0].position.x; }

 private:
  simulation::Experiment experiment_;
  simulation::World world_;
  std::filesystem::path folder_;
  simulation::Records records_;
};

/// The same robot and control, by hand: the gait object and eighteen lines of C++.
class Plain {
 public:
  Plain()
      : experiment_(experiment("", "", false)),
        engine_(simulation::make_dts(experiment_)),
        gait_(control::Registry::instance().find("Controller.TripodGait")->make()) {
    for (const auto& [index, value] : experiment_.components[0].values)
      gait_->values()[index] = value;
    goals_ = *control::find_value(*gait_, "goal[0]");
    gait_->start(deltat);
  }
  void step() {
    const simulation::WorldState& state = engine_->state();
    gait_->update({state.time, deltat, state.step});
    std::vector<double>& torques = engine_->inputs().joint_torques;
    for (std::size_t i = 0; i < torques.size(); ++i)
      torques[i] = pconstant * (gait_->values()[goals_ + i] - state.joints[i].angle) -
                   dconstant * state.joints[i].rate;
    if (!engine_->step().ok()) throw std::runtime_error("the plain run failed");
  }
  double walked() const { return engine_->state().bodies[0].position.x; }

 private:
  simulation::Experiment experiment_;
  std::unique_ptr<simulation::Engine> engine_;
  std::unique_ptr<control::Component> gait_;
  std::size_t goals_ = 0;
};

/// Processor time: wall time counts whoever else uses the machine.
template <class Run>
double microseconds_a_step(Run& run, int steps) {
  const std::clock_t start = std::clock();
  for (int i = 0; i < steps; ++i) run.step();
  return 1e6 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / steps;
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
  return values[values.size() / 2];
}

/// Both in turn, so that what the machine does meanwhile falls on both.
void overhead(benchmark::State& state, const std::string& format, const std::string& rate) {
  for (auto _ : state) {
    Wired wired(format, rate);
    Plain plain;
    std::vector<double> with, without, ratio;
    for (int repetition = 0; repetition < 21; ++repetition) {
      with.push_back(microseconds_a_step(wired, 500));
      without.push_back(microseconds_a_step(plain, 500));
      ratio.push_back(with.back() / without.back());
    }
    state.counters["with_us"] = median(with);
    state.counters["without_us"] = median(without);
    state.counters["ratio"] = median(ratio);
    state.counters["walked_with_m"] = wired.walked();
    state.counters["walked_without_m"] = plain.walked();
  }
}

BENCHMARK_CAPTURE(overhead, wires_only, "", "")->Iterations(1);
BENCHMARK_CAPTURE(overhead, hdf5_1000_Hz, "hdf5", "rate = 1000 Hz;")->Iterations(1);
BENCHMARK_CAPTURE(overhead, hdf5_every_step, "hdf5", "")->Iterations(1);
BENCHMARK_CAPTURE(overhead, csv_1000_Hz, "csv", "rate = 1000 Hz;")->Iterations(1);
BENCHMARK_CAPTURE(overhead, csv_every_step, "csv", "")->Iterations(1);

}  // namespace
}  // namespace hookpoint::tests
