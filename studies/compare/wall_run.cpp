// Running a Wall, and its files.
#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

#include "output/file.h"
#include "output/text/csv.h"
#include "output/text/hash.h"
#include "output/text/number.h"
#include "simulation/identity.h"
#include "simulation/run/energy_watch.h"
#include "simulation/run/expectation.h"
#include "simulation/run/world.h"
#include "simulation/step_count.h"
#include "studies/compare/wall.h"
#include "studies/run/results_csv.h"
#include "studies/run/row_runner.h"
#include "studies/summary.h"

namespace hookpoint::studies {
namespace {

using simulation::ExpectationResult;
using simulation::ExpectationSpec;

/// A Wall's runs are kept under another identity than a study's: other things are looked at.
std::string wall_identity(const RowPlan& row, const EngineTable& engines) {
  const auto engine = engines.find(row.engine);
  const simulation::EngineDescription description =
      engine == engines.end() ? simulation::EngineDescription{row.engine, {}, {}, false, {}}
                              : engine->second.description;
  return output::Hash().add("expected").add(simulation::run_hash(row.hash, description)).text();
}

/// With the name of each truth that covers the run, and nothing under it.
RunRecord nothing_measured(const WallRunPlan& planned) {
  RunRecord record;
  for (const ExpectationSpec& spec : planned.expectations) record.values[spec.name];
  return record;
}

void run_scene(const simulation::Experiment& experiment, const EngineEntry& engine,
               const std::atomic<bool>& stop, RunRecord& record) {
  simulation::World world(experiment, engine.make(experiment));
  simulation::Expectations expectations(experiment, world.ports());
  const std::int64_t steps = simulation::step_count(experiment.duration, experiment.deltat);
  simulation::EnergyWatch energy(experiment, world, steps);
  expectations.observe(0.);
  for (std::int64_t step = 0; step < steps && world.ended().empty(); ++step) {
    if (stop.load(std::memory_order_relaxed)) return;
    const simulation::StepStatus status = world.step();
    if (!status.ok()) {
      record.status = fmt::format("stopped at {:.6g} s: {}", status.time, status.advice);
      break;
    }
    expectations.observe(world.state().time);
    energy.observe();
  }
  record.notices = world.state().notices;
  if (std::string finding = energy.finding(); !finding.empty())
    record.notices.push_back(std::move(finding));
  if (record.status != "ok") return;
  for (const ExpectationResult& result : expectations.results())
    record.values[result.spec->name].measured = result.measured;
}

/// A value for each truth that covers the run; nothing when `stop` was set meanwhile.
std::optional<RunRecord> run_scene(const WallPlan& plan, std::size_t row,
                                   const EngineTable& engines, const std::atomic<bool>& stop) {
  const RowPlan& planned = plan.study.rows[row];
  RunRecord record = nothing_measured(plan.runs[row]);
  const auto engine = engines.find(planned.engine);
  if (engine == engines.end() || !engine->second.description.found) {
    record.status = fmt::format("skipped: engine {} is not on this machine", planned.engine);
    return record;
  }
  try {
    run_scene(plan.study.experiment_of(planned), engine->second, stop, record);
  } catch (const simulation::ExperimentError& error) {
    record.status = fmt::format("cannot run: {}", error.what());
  }
  if (stop.load(std::memory_order_relaxed)) return std::nullopt;
  return record;
}

/// The longest scenes first, so that the last thread to finish is not far behind.
std::vector<std::size_t> by_length(const std::vector<RowPlan>& rows) {
  std::vector<std::size_t> order(rows.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto steps = [&](std::size_t i) { return rows[i].duration / rows[i].deltat; };
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

void add_record(WallResult& result, const RowPlan& row, const WallRunPlan& planned,
                RunRecord record) {
  const auto scene = static_cast<std::size_t>(row.values[0]);
  for (const ExpectationSpec& spec : planned.expectations) {
    WallCell& cell = line_of(result, scene, spec).cells[static_cast<std::size_t>(row.subject)];
    cell.expected = spec.expected;
    cell.status = record.status;
    cell.law = planned.law;
    cell.integrator = planned.integrator;
    if (record.status != "ok") continue;
    const ExpectationResult found{&spec, record.values[spec.name].measured};
    cell.measured = found.measured;
    cell.error = found.error();
    cell.ok = found.ok();
  }
}

/// Its truths counted.
RunResult wall_row(const RowPlan& row, const WallRunPlan& planned, RunRecord record) {
  RunResult run = empty_wall_row(row);
  run.status = record.status;
  if (outcome_of(run) == RunOutcome::skipped) return run;
  double held = 0.;
  for (const ExpectationSpec& spec : planned.expectations)
    if (record.status == "ok" && ExpectationResult{&spec, record.values[spec.name].measured}.ok())
      ++held;
  const auto all = static_cast<double>(planned.expectations.size());
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
int WallResult::left_out() const {
  return static_cast<int>(std::ranges::count_if(lines, [](const WallLine& line) {
    return std::ranges::all_of(
        line.cells, [](const WallCell& cell) { return cell.status.empty() || skipped(cell); });
  }));
}

std::optional<WallRun> run_wall(const WallPlan& plan, const EngineTable& engines,
                                const RunOptions& options, const std::atomic<bool>& stop) {
  const std::vector<RowPlan>& rows = plan.study.rows;
  WallRun run{{}, options.folder.empty() ? plan.study.folder() : options.folder, nullptr, {}};
  run.files = std::make_unique<output::ResultFolder>(
      run.folder, manifest_of(plan.study),
      std::vector<std::string>{store_folder, "results.csv", "experiment.hook", "provenance.json",
                               "report.html"});
  const auto store = open_store(options, run.folder);
  std::vector<std::string> identities;
  for (const RowPlan& row : rows) identities.push_back(wall_identity(row, engines));
  const auto kept = [&](std::size_t row) {
    return store->numbers(identities[row]).value_or(RunRecord{});
  };
  ProgressMeter meter(rows.size(), options);
  RowWork work{plan.study.name, identities,
               [&](std::size_t row) { return run_scene(plan, row, engines, stop); },
               [&](std::size_t row, const RunRecord& record) {
                 return std::ranges::all_of(plan.runs[row].expectations,
                                            [&](const ExpectationSpec& spec) {
                                              return record.values.contains(spec.name);
                                            });
               }};
  std::mutex telling;
  if (options.row_done)
    work.done = [&](std::size_t row) {
      const RunResult result = wall_row(rows[row], plan.runs[row], kept(row));
      const std::lock_guard lock(telling);
      options.row_done(row, result);
    };
  if (!run_rows(by_length(rows), work, options, *store, meter, stop)) return std::nullopt;
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
  Notices notices;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    RunRecord record = kept(row);
    notices.add(row, record.notices);
    add_record(result, rows[row], plan.runs[row], std::move(record));
  }
  run.notices = notices.texts([&](std::size_t row) {
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
