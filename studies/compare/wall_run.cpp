// Running a Wall, and its files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/force_law.h"
#include "output/file.h"
#include "output/text/csv.h"
#include "output/text/number.h"
#include "simulation/run/energy_watch.h"
#include "simulation/run/expectation.h"
#include "simulation/run/world.h"
#include "studies/compare/wall.h"
#include "studies/run/row_runner.h"
#include "studies/summary.h"

namespace hookpoint::studies {
namespace {

using simulation::ExpectationResult;
using simulation::ExpectationSpec;

std::vector<const ExpectationSpec*> covering(const RowPlan& row) {
  std::vector<const ExpectationSpec*> specs;
  for (const ExpectationSpec& spec : row.experiment.expectations) {
    if (spec.covers(row.experiment)) specs.push_back(&spec);
  }
  return specs;
}

/// A value for each truth that covers the run; nothing when `stop` was set meanwhile.
std::optional<RowOutcome> run_scene(const RowPlan& row, const EngineTable& engines,
                                    const std::atomic<bool>& stop) {
  RowOutcome outcome;
  outcome.measured.resize(covering(row).size());
  const auto engine = engines.find(row.experiment.engine);
  if (engine == engines.end() || !engine->second.description.found) {
    outcome.status =
        fmt::format("skipped: engine {} is not on this machine", row.experiment.engine);
    return outcome;
  }
  try {
    const simulation::Experiment experiment = row.whole();
    simulation::World world(experiment, engine->second.make(experiment));
    simulation::Expectations expectations(experiment, world.ports());
    const std::int64_t steps = std::llround(experiment.duration / experiment.deltat);
    simulation::EnergyWatch energy(experiment, world, steps);
    expectations.observe(0.);
    for (std::int64_t step = 0; step < steps && world.ended().empty(); ++step) {
      if (stop.load(std::memory_order_relaxed)) return std::nullopt;
      const simulation::StepStatus status = world.step();
      if (!status.ok()) {
        outcome.status = fmt::format("stopped at {:.6g} s: {}", status.time, status.advice);
        break;
      }
      expectations.observe(world.state().time);
      energy.observe();
    }
    outcome.notices = world.state().notices;
    if (std::string finding = energy.finding(); !finding.empty())
      outcome.notices.push_back(std::move(finding));
    if (outcome.status != "ok") return outcome;
    const std::vector<ExpectationResult> results = expectations.results();
    for (std::size_t i = 0; i < results.size(); ++i) outcome.measured[i] = results[i].measured;
  } catch (const simulation::ExperimentError& error) {
    outcome.status = fmt::format("cannot run: {}", error.what());
  }
  return outcome;
}

/// The longest scenes first, so that the last thread to finish is not far behind.
std::vector<std::size_t> by_length(const std::vector<RowPlan>& rows) {
  std::vector<std::size_t> order(rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto steps = [&](std::size_t i) {
    return rows[i].experiment.duration / rows[i].experiment.deltat;
  };
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return steps(a) > steps(b); });
  return order;
}

std::string allowed_difference(const ExpectationSpec& spec) {
  std::string text;
  if (spec.tolerance > 0.) text = output::rounded(100. * spec.tolerance) + " %";
  if (spec.within > 0.)
    text += (text.empty() ? "" : " or ") + output::rounded(spec.within) +
            (spec.unit.empty() ? "" : " " + spec.unit);
  return text;
}

/// The line of that truth among those of its scene, made when it is new.
WallLine& line_of(WallResult& result, std::size_t scene, const ExpectationSpec& spec) {
  for (WallLine& line : result.lines) {
    if (line.scene == scene && line.name == spec.name) return line;
  }
  WallLine line{scene,
                spec.name,
                spec.formula,
                spec.source,
                spec.unit,
                allowed_difference(spec),
                spec.tolerance > 0. && spec.expected != 0.,
                {}};
  line.cells.resize(result.subjects.size());
  result.lines.push_back(std::move(line));
  return result.lines.back();
}

void add_outcome(WallResult& result, const RowPlan& row, const RowOutcome& outcome) {
  const auto scene = static_cast<std::size_t>(row.values[0]);
  const std::vector<const ExpectationSpec*> specs = covering(row);
  for (std::size_t i = 0; i < specs.size(); ++i) {
    WallCell& cell = line_of(result, scene, *specs[i]).cells[static_cast<std::size_t>(row.subject)];
    cell.expected = specs[i]->expected;
    cell.status = outcome.status;
    cell.law = row.experiment.terrain ? row.experiment.contact : "";
    cell.integrator =
        contact::find_force_law(row.experiment.contact) ? row.experiment.integrator : "";
    if (outcome.status != "ok") continue;
    const ExpectationResult found{specs[i], outcome.measured[i]};
    cell.measured = found.measured;
    cell.error = found.error();
    cell.ok = found.ok();
  }
}

/// Its truths counted.
RunResult wall_row(const RowPlan& row, const RowOutcome& outcome) {
  RunResult run = empty_wall_row(row);
  run.status = outcome.status;
  if (outcome_of(run) == RunOutcome::skipped) return run;
  const std::vector<const ExpectationSpec*> specs = covering(row);
  double held = 0.;
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (outcome.status == "ok" && ExpectationResult{specs[i], outcome.measured[i]}.ok()) ++held;
  const auto all = static_cast<double>(specs.size());
  run.metrics[0] = {held, all, held == all};
  return run;
}

bool skipped(const WallCell& cell) { return cell.status.starts_with("skipped"); }

int count_cells(const WallResult& result, bool ok) {
  int count = 0;
  for (const WallLine& line : result.lines)
    count += static_cast<int>(std::ranges::count_if(line.cells, [&](const WallCell& cell) {
      return !cell.status.empty() && !skipped(cell) && cell.ok == ok;
    }));
  return count;
}

}  // namespace

RunResult empty_wall_row(const RowPlan& row) {
  RunResult run;
  run.parameters = {static_cast<double>(row.values[0])};
  run.subject = row.subject;
  run.metrics.resize(1);
  return run;
}

int WallResult::passed() const { return count_cells(*this, true); }
int WallResult::failed() const { return count_cells(*this, false); }

std::optional<WallRun> run_wall(const WallPlan& plan, const EngineTable& engines,
                                const RunOptions& options, const std::atomic<bool>& stop) {
  const std::vector<RowPlan>& rows = plan.study.rows;
  WallRun run{{}, options.folder.empty() ? plan.study.folder() : options.folder, nullptr, {}};
  run.files = std::make_unique<output::ResultFolder>(
      run.folder, manifest_of(plan.study),
      std::vector<std::string>{"rows/", "results.csv", "experiment.hook", "provenance.json",
                               "report.html"});
  const RowStore store(run.folder / "rows", options.resume);
  std::vector<RowOutcome> outcomes(rows.size());
  ProgressMeter meter(rows.size(), options);
  const RowWork work{[&](std::size_t row) { return run_scene(rows[row], engines, stop); },
                     [&](std::size_t row) { return plan.study.identity_of(rows[row], engines); },
                     [&](std::size_t row) { return covering(rows[row]).size(); }, 0,
                     tell_rows(options, [&](std::size_t row, const RowOutcome& outcome) {
                       return wall_row(rows[row], outcome);
                     })};
  if (!run_rows(by_length(rows), work, options, store, meter, outcomes)) return std::nullopt;
  WallResult& result = run.result;
  result = {plan.study.name,
            plan.study.title,
            plan.study.question,
            plan.study.file,
            plan.scenes,
            {},
            {},
            plan.study.warnings};
  for (const SubjectPlan& subject : plan.study.subjects) result.subjects.push_back(subject.info);
  for (std::size_t i = 0; i < outcomes.size(); ++i) add_outcome(result, rows[i], outcomes[i]);
  run.notices = collect_notices(outcomes, [&](std::size_t row) {
    const auto scene = static_cast<std::size_t>(rows[row].values[0]);
    const auto subject = static_cast<std::size_t>(rows[row].subject);
    return plan.scenes[scene].name + " under " + plan.study.subjects[subject].info.name;
  });
  return run;
}

output::CsvTable wall_results_table(const WallResult& result) {
  output::CsvTable table;
  table.header = {"scene",    "truth", "subject", "engine",  "law", "integrator", "measured",
                  "expected", "unit",  "error",   "allowed", "ok",  "status"};
  const auto number = [](const std::optional<double>& value) {
    return value ? output::shortest(*value) : std::string();
  };
  for (const WallLine& line : result.lines) {
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
      const WallCell& cell = line.cells[i];
      if (cell.status.empty()) continue;
      const SubjectInfo& subject = result.subjects[i];
      table.rows.push_back({result.scenes[line.scene].name, line.name, subject.name, subject.engine,
                            cell.law, cell.integrator, number(cell.measured), number(cell.expected),
                            line.unit, number(cell.error), line.allowed,
                            skipped(cell) ? ""
                            : cell.ok     ? "true"
                                          : "false",
                            cell.status});
    }
  }
  return table;
}

void write_wall_files(const WallRun& run, const WallPlan& plan, const Provenance& provenance) {
  output::write_csv(run.folder / "results.csv", wall_results_table(run.result));
  output::write_file(run.folder / "experiment.hook", plan.study.printed);
  output::write_file(run.folder / "provenance.json", provenance_json(provenance));
}

}  // namespace hookpoint::studies
