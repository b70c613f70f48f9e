// Calibrations of constants that are known, of a body in free flight that is pushed by functions of
// them: a run is ten steps. Curves with normal noise; with a direction that no curve sees, or
// without one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "studies/calibrate/calibration.h"
#include "tests/support/command.h"
#include "tests/support/normal_noise.h"
#include "tests/support/planned.h"

namespace hookpoint::testing {

/// What pushes the body, of the constants a and b, and which of these the curves identify.
struct SyntheticPush {
  const char *name, *along_x, *along_y;
  bool identifies_a, identifies_b;
};

/// With a = 2 and b = 3 between 0.5 and 6: of the first four either constant reaches an end of its
/// range; b acts from 4 on; sin 4 a has one value at seven places.
inline constexpr std::array pushes_with_a_flat_direction{
    SyntheticPush{"sum", "a + b", "0", false, false},
    SyntheticPush{"product", "a*b", "0", false, false},
    SyntheticPush{"ratio", "6*a/b", "0", false, false},
    SyntheticPush{"power", "0.1*a^2*b^3", "0", false, false},
    SyntheticPush{"squares", "a^2 + b^2", "0", false, false},
    SyntheticPush{"threshold", "2*a", "5*max(0, b - 4)", true, false},
    SyntheticPush{"periodic", "5*sin(4*a)", "2*b", false, true}};
inline constexpr std::array pushes_without_one{
    SyntheticPush{"apart", "2*a", "2*b", true, true},
    SyntheticPush{"sum and ratio", "a + b", "6*a/b", true, true},
    SyntheticPush{"product and square", "a*b", "a^2", true, true},
    SyntheticPush{"ratio and sum", "4*a/b", "a + 2*b", true, true},
    SyntheticPush{"power and root", "0.3*a^2*b", "5*b^0.5", true, true}};

/// Counts over the constants of many calibrations.
struct SyntheticCounts {
  int calibrations = 0;
  int identified = 0, wrongly_identified = 0;
  int intervals = 0, holding = 0;  ///< of constants that the curves identify
  std::size_t models = 0;          ///< points at which the cases were run
  std::array<int, 2> holding_by_method{}, intervals_by_method{};  ///< least squares, cmaes
  std::string faults{};  ///< the calibrations with a wrongly identified constant
};

class SyntheticCalibrations {
 public:
  static constexpr double a = 2., b = 3., from = 0.5, to = 6.;

  SyntheticCalibrations() : application_({}, [](const language::Diagnostics&) {}) {}

  /// Calibration `number` of these pushes: pushes, scales and methods in turn, each with noise of
  /// its own.
  template <std::size_t Count>
  void add(const std::array<SyntheticPush, Count>& pushes, std::size_t number,
           SyntheticCounts& counts) {
    const SyntheticPush& push = pushes[number % Count];
    const std::size_t variant = number / Count;
    const bool logarithmic = variant % 2 == 1, cmaes = variant / 2 % 2 == 1;
    const std::string name = "n" + std::to_string(++files_);
    place_.file(
        name + "_scene.hook",
        "Param a = 1.5; Param b = 2;\nWorld w { gravity = 0; deltat = 0.05 s; integrator = rk4; Material floor { normal_stiffness = 10 N/m; "
        "normal_damping = 1 N.s/m; } Terrain.Flat ground { material = floor; } Robot p { Base.mobile { location = 0, "
        "0, 100; mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0; ContactPoint tip { } } } Force "
        "push { body = p.base; force = (" +
            std::string(push.along_x) + ") * 1 N, (" + push.along_y + ") * 1 N, 0; } }\n");
    measure(name, push, 1000 + number);
    const std::string scale = logarithmic ? " scale = log;" : "";
    const auto plans = studies::planned_calibrations(
        application_,
        place_.file(name + ".hook",
                    "Calibrate c { scene = \"" + name + "_scene.hook\"; " + trace(name, "x") +
                        trace(name, "y") + "Vary a { from = 0.5; to = 6;" + scale +
                        " } Vary b { from = 0.5; to = 6;" + scale + " } " +
                        (cmaes ? "method = cmaes; generations = 15; " : "") +
                        "resamples = 1; folds = 0; seed = " + std::to_string(number + 1) +
                        "; }\n"));
    if (plans.size() != 1) {
      counts.faults += name + ": no plan; ";
      ++counts.wrongly_identified;
      return;
    }
    const std::atomic<bool> stop = false;
    studies::CalibrationOptions options;
    options.run.jobs = 2;
    options.run.folder = place_.folder() / name;
    const auto result =
        studies::run_calibration(plans.front(), application_.engines(), options, stop).result;
    count(push, plans.front(), result.subjects.front(),
          name + " " + push.name + (logarithmic ? " log" : "") + (cmaes ? " cmaes" : ""), counts);
  }

 private:
  static constexpr int samples = 20;
  static constexpr double noise = 0.02;  // [m]

  static double force(const std::string& along) {
    static const std::vector<std::pair<std::string, double>> at_truth{
        {"0", 0.},
        {"a + b", a + b},
        {"a*b", a * b},
        {"6*a/b", 6. * a / b},
        {"0.1*a^2*b^3", 0.1 * a * a * b * b * b},
        {"a^2 + b^2", a * a + b * b},
        {"2*a", 2. * a},
        {"5*max(0, b - 4)", 0.},
        {"5*sin(4*a)", 5. * std::sin(4. * a)},
        {"2*b", 2. * b},
        {"a^2", a * a},
        {"4*a/b", 4. * a / b},
        {"a + 2*b", a + 2. * b},
        {"0.3*a^2*b", 0.3 * a * a * b},
        {"5*b^0.5", 5. * std::sqrt(b)}};
    return std::ranges::find(at_truth, along, &std::pair<std::string, double>::first)->second;
  }

  /// Under a constant force Runge and Kutta's steps are exact: x = F t^2/2.
  void measure(const std::string& name, const SyntheticPush& push, std::size_t seed) const {
    std::seed_seq seeds{static_cast<unsigned>(seed)};
    std::mt19937_64 random(seeds);
    std::string text = "t [s],x [m],y [m]\n";
    for (int i = 1; i <= samples; ++i) {
      const double time = 0.05 * i;
      text += std::to_string(time);
      for (const char* along : {push.along_x, push.along_y})
        text +=
            "," + std::to_string(0.5 * force(along) * time * time + noise * normal_number(random));
      text += "\n";
    }
    place_.file(name + ".csv", text);
  }

  static std::string trace(const std::string& name, const std::string& axis) {
    return "Trace " + axis + " { file = \"" + name + ".csv\"; column = " + axis +
           "; of = w.p.position." + axis + "; weight = 1/(20 mm); } ";
  }

  static void count(const SyntheticPush& push, const studies::CalibrationPlan& plan,
                    const studies::SubjectCalibration& found, const std::string& name,
                    SyntheticCounts& counts) {
    ++counts.calibrations;
    for (const studies::FitRecord& record : found.records) counts.models += record.models;
    for (const studies::FittedConstant& constant : found.constants) {
      const bool of_a = plan.varied[constant.constant].name == "a";
      const bool known = of_a ? push.identifies_a : push.identifies_b;
      if (constant.identifiable) ++counts.identified;
      if (constant.identifiable && !known) {
        ++counts.wrongly_identified;
        counts.faults += name + (of_a ? " a; " : " b; ");
      }
      if (!known || !constant.low) continue;
      const double truth = plan.varied[constant.constant].share_of(of_a ? a : b);
      const int holds = *constant.low <= truth && truth <= *constant.high ? 1 : 0;
      ++counts.intervals;
      counts.holding += holds;
      const std::size_t method = plan.method == studies::FitMethod::cmaes ? 1 : 0;
      ++counts.intervals_by_method[method];
      counts.holding_by_method[method] += holds;
    }
  }

  Workplace place_;
  application::Application application_;
  int files_ = 0;
};

}  // namespace hookpoint::testing
