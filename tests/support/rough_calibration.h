// Calibrations of a point that drops and lands on whole steps, so that their error is rough: noisy
// curves of the program's own runs.
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>

#include "output/files/csv.h"
#include "studies/calibrate/calibration.h"
#include "tests/support/command.h"
#include "tests/support/normal_noise.h"
#include "tests/support/planned.h"

namespace hookpoint::testing {

struct RoughResult {
  studies::CalibrationPlan plan;
  studies::SubjectCalibration found;

  double low(std::size_t i) const { return plan.varied[i].at(*found.constants[i].low); }
  double high(std::size_t i) const { return plan.varied[i].at(*found.constants[i].high); }
};

class RoughCalibrations {
 public:
  static constexpr const char* cmaes = "method = cmaes; population = 12; generations = 12; ";

  RoughCalibrations() : application_({}, [](const language::Diagnostics&) {}) {}

  /// A drop of 50 mm under a lift of `seen` * 0.1 N, with a = 2 and b = 3, which are fitted from 0
  /// to 6; noise of 0.2 mm. `world`: more of the World; `block`: more of the Calibrate.
  std::optional<RoughResult> lifted_drop(const std::string& seen, const std::string& world,
                                         const std::string& block, unsigned seed) {
    const std::string name = "lift" + std::to_string(++files_);
    place_.file(name + "_scene.hook",
                "Param a = 2; Param b = 3; Param k = 20 kN/m;\nWorld w { gravity = 9.81; deltat = "
                "0.1 ms; duration = 0.3 s; " +
                    world +
                    " Material floor { normal_stiffness = k; normal_damping = 60 N.s/m; } "
                    "Terrain.Flat ground { material = floor; } Robot p { Base.mobile { location = "
                    "0, 0, 0.05; mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { } } } "
                    "Force lift { body = p.base; force = 0, 0, " +
                    seen + " * 0.1 N; } }\n");
    std::mt19937_64 random(seed);
    place_.file(name + ".csv", "t [s],z [m]\n" + noisy_rows(name + "_scene.hook", 30, "", random));
    return calibrate(name, "Calibrate c { scene = \"" + name +
                               "_scene.hook\"; Trace d { file = \"" + name +
                               ".csv\"; column = z; of = w.p.position.z; weight = 1/(0.2 mm); } "
                               "Vary a { from = 0; to = 6; } Vary b { from = 0; to = 6; } " +
                               block + "}\n");
  }

  /// Eight drops from 0.05 m to 0.12 m onto ground of damping c a b/6, stiffness k.
  std::optional<RoughResult> eight_drops(unsigned seed) {
    place_.file("drops_scene.hook",
                "Param height = 0.1; Param a = 2; Param b = 3; Param k = 20 kN/m; Param c = 60 "
                "N.s/m;\nWorld w { gravity = 9.81; deltat = 0.1 ms; duration = 0.5 s; Material f { "
                "normal_stiffness = k; normal_damping = c*(a*b)/6; } Terrain.Flat g { material = "
                "f; } Robot p { Base.mobile { location = 0, 0, height; mass = 1; inertia = "
                "1, 1, 1, 0, 0, 0; ContactPoint { } } } }\n");
    std::string cases = "n,height\n", curves = "n,t [s],z [m]\n";
    std::mt19937_64 random(seed);
    for (int i = 0; i < 8; ++i) {
      const std::string number = std::to_string(i), height = std::to_string(0.05 + 0.01 * i);
      cases += number + "," + height + "\n";
      curves += noisy_rows("drops_scene.hook --set height=" + height, 50, number + ",", random);
    }
    place_.file("cases.csv", cases);
    place_.file("curves.csv", curves);
    return calibrate("drops",
                     "Calibrate c { scene = \"drops_scene.hook\"; Cases n { file = \"cases.csv\"; "
                     "case = n; Trace d { file = \"curves.csv\"; column = \"z [m]\"; time = \"t\"; "
                     "of = w.p.position.z; weight = 1/(0.2 mm); } } Vary k { from = 1 kN/m; to = "
                     "200 kN/m; scale = log; } Vary a { from = 0.5; to = 6; } Vary b { from = 0.5; "
                     "to = 6; } resamples = 100; folds = 0; " +
                         std::string(cmaes) + "}\n");
  }

 private:
  /// Every `each`th row of the height of a run, with noise.
  std::string noisy_rows(const std::string& run, std::size_t each, const std::string& before,
                         std::mt19937_64& random) const {
    const CommandResult recorded =
        place_.hookpoint("run " + run + " --record w.p.position.z --out recorded");
    const auto table = output::parse_csv(place_.read("recorded/trace.csv"));
    if (recorded.status != 0 || !table) throw std::runtime_error(recorded.err);
    std::string text;
    for (std::size_t row = 0; row < table->rows.size(); row += each) {
      text += before + table->rows[row][0] + "," +
              std::to_string(std::stod(table->rows[row][1]) + 2e-4 * normal_number(random)) + "\n";
    }
    return text;
  }

  std::optional<RoughResult> calibrate(const std::string& name, const std::string& text) {
    auto plans = studies::planned_calibrations(application_, place_.file(name + ".hook", text));
    if (plans.size() != 1) return std::nullopt;
    const std::atomic<bool> stop = false;
    studies::CalibrationOptions options;
    options.run.jobs = 2;
    options.run.folder = place_.folder() / name;
    auto result = studies::run_calibration(plans.front(), application_.engines(), options, stop);
    return RoughResult{std::move(plans.front()), std::move(result.result.subjects.front())};
  }

  Workplace place_;
  application::Application application_;
  int files_ = 0;
};

}  // namespace hookpoint::testing
