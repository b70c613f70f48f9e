// A small made-up study with everything that a report must cope with: zeros, negative values, a
// subject that stops, one that is not installed, failing truths, curves over time. Numbers are
// formulas, so that tests can state what must be printed.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "studies/results/result.h"

namespace hookpoint::testing {

/// Creep u0 tan(slope) [m/s] with u0 = 1 mm/s.
inline double synthetic_creep(double slope_degrees) {
  return 1e-3 * std::tan(slope_degrees * std::acos(-1.) / 180.);
}

inline studies::Trace synthetic_curve(double speed, int points) {
  studies::Trace trace;
  for (int i = 0; i < points; ++i) {
    const double t = 20. * i / (points - 1);
    trace.time.push_back(t);
    trace.value.push_back(speed * t + 1e-2 * speed * std::sin(40. * t));
  }
  return trace;
}

/// Speed, closed form and status of subject number `subject` (0 exact, 1 creeps, 2 fails above 20
/// deg, 3 creeps uphill, 4 stops at the largest step, 5 not installed).
inline studies::RunResult synthetic_row(int subject, double slope, double dt) {
  studies::RunResult row;
  row.parameters = {slope, dt};
  row.subject = subject;
  const double form = synthetic_creep(slope);
  studies::MetricValue creep, depth, speed;
  depth.measured = 1.226e-5 * std::cos(slope / 57.3);
  speed.measured = 3000. / (subject + 1.);
  switch (subject) {
    case 0:
      creep = {0., 0., true};
      break;
    case 1:
      creep = {form * 1.002, form, true};
      break;
    case 2:
      creep = {form * 0.1 * (slope > 20. ? 1.3 : 1.), form * 0.1, slope <= 20.};
      break;
    case 3:
      creep.measured = -3.1e-7 * dt;
      break;
    case 4:
      creep.measured = 6e-11 * std::sqrt(slope);
      break;
    default:
      break;
  }
  double reach = creep.measured.value_or(0.);
  if (subject == 4 && dt > 5.) {
    row.status = "not_finite at 0.37 s in block.base: reduce deltat <or> damping";
    creep = {{}, {}, false};
    depth = speed = {};
    reach = 0.;
  }
  if (subject == 5) {
    row.status = "skipped: engine mujoco is not installed";
    depth = speed = {};
  }
  row.metrics = {creep, depth, speed};
  row.traces = {{}, {}, subject == 5 ? studies::Trace{} : synthetic_curve(reach, 2001)};
  return row;
}

inline studies::PlotSpec synthetic_plot(const char* name, const char* title, const char* x,
                                        const char* x_unit) {
  studies::PlotSpec plot;
  plot.name = name;
  plot.title = title;
  plot.x = x;
  plot.x_unit = x_unit;
  plot.y = "creep_speed";
  plot.y_unit = "m/s";
  plot.log_y = true;
  return plot;
}

inline studies::StudyResult synthetic_study() {
  studies::StudyResult study;
  study.name = "creep";
  study.question =
      "Does a block creep on a slope that friction should hold, under each contact law and engine?";
  study.file = "configs/studies/creep.hook";
  study.sweeps = {{"slope", "deg", {5, 10, 15, 20, 25, 30}}, {"dt", "ms", {0.1, 1, 10}}};
  study.subjects = {{"dts_hookpoint", "dts", "hookpoint", "semi_implicit_euler", "", true},
                    {"dts_impulse", "dts", "impulse", "", "", true},
                    {"dts_hunt_crossley", "dts", "hunt_crossley", "rk4", "", true},
                    {"ode_quickstep_recommended", "ode_quickstep", "", "", "recommended", true},
                    {"bullet_default", "bullet", "", "", "default", true},
                    {"mujoco_matched", "mujoco", "", "", "matched", false}};
  study.metrics = {{"creep_speed", "m/s", false},
                   {"penetration_max", "m", false},
                   {"realtime_factor", "", true}};
  for (const double slope : study.sweeps[0].values)
    for (const double dt : study.sweeps[1].values)
      for (int subject = 0; subject < 6; ++subject)
        study.rows.push_back(synthetic_row(subject, slope, dt));
  studies::PlotSpec by_slope = synthetic_plot(
      "creep_by_slope", "Creep of a block that friction should hold", "slope", "deg");
  studies::PlotSpec by_step =
      synthetic_plot("creep_by_step", "Creep over the step size", "dt", "ms");
  studies::PlotSpec in_time = synthetic_plot("displacement", "Displacement downhill", "time", "s");
  by_slope.where = {{"dt", {1.}}};
  by_step.log_x = true;
  in_time.y = "displacement";
  in_time.y_unit = "m";
  in_time.where = {{"slope", {15.}}, {"dt", {1.}}};
  study.plots = {by_slope, by_step, in_time};
  study.truths = {{"creep", "creep_speed equals predicted within 1 %", 0, 48, 12}};
  return study;
}

}  // namespace hookpoint::testing
