// Running a Wall, and its files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "language/names.h"
#include "output/files/csv.h"
#include "output/files/file.h"
#include "simulation/run/expectation.h"
#include "studies/compare/score_card.h"
#include "studies/compare/wall.h"
#include "studies/results/summary.h"
#include "studies/run/results_csv.h"
#include "studies/run/rows.h"
#include "studies/run/verdict.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

using simulation::ExpectationResult;
using simulation::ExpectationSpec;

std::string allowed_difference(const ExpectationSpec& spec) {
  std::string text;
  if (spec.tolerance > 0.) text = text::rounded(100. * spec.tolerance) + " %";
  if (spec.within > 0.)
    text += (text.empty() ? "" : " or ") + text::rounded(spec.within) +
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
                spec.scale.value_or(std::abs(spec.expected)),
                {}};
  line.cells.resize(result.subjects.size());
  result.lines.push_back(std::move(line));
  return result.lines.back();
}

void add_record(WallResult& result, const WallPlan& plan, std::size_t index, RunRecord record) {
  const RowPlan& row = plan.study.rows[index];
  const auto scene = static_cast<std::size_t>(row.values[0]);
  const SubjectInfo& composed = plan.study.compositions[static_cast<std::size_t>(row.composition)];
  for (const ExpectationSpec& spec : plan.expectations[index]) {
    WallCell& cell = line_of(result, scene, spec).cells[static_cast<std::size_t>(row.subject)];
    cell.expected = spec.expected;
    cell.status = record.status;
    cell.law = composed.law;
    cell.integrator = composed.integrator;
    if (record.status != "ok") continue;
    const ExpectationResult found{&spec, record.values[expectation_key(spec.name)].measured};
    cell.measured = found.measured;
    cell.error = found.error();
    cell.decades = found.decades();
    cell.ok = found.ok();
  }
}

/// Expects that cover no run, with the reason: a fault where a scene has no other. A scene is
/// shared by many Walls, and says of each law what it expects.
std::vector<IdleBlock> idle_expects(const WallPlan& plan, const WallResult& result) {
  std::vector<IdleBlock> idle;
  for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
    std::vector<std::string> judged;
    for (const WallLine& line : result.lines)
      if (line.scene == i) judged.push_back(line.name);
    const WallScene& scene = plan.scenes[i];
    for (const std::string& name : scene.expects) {
      if (language::contains(judged, name)) continue;
      Idleness idleness{Idle::fault, "it covers neither law nor integrator of any run"};
      if (!plan.unselected.empty())
        idleness = {Idle::left_out, "--only leaves out " + language::join(plan.unselected, ", ")};
      idle.push_back(
          {"Expect", scene.name + "." + name, allowed_by(!judged.empty(), std::move(idleness))});
    }
  }
  return idle;
}

/// The row with its truths counted.
RunResult counted(RunResult run, const std::vector<ExpectationSpec>& expectations,
                  RunRecord record) {
  run.status = record.status;
  if (outcome_of(run) == RunOutcome::skipped) return run;
  double held = 0.;
  for (const ExpectationSpec& spec : expectations)
    if (record.status == "ok" &&
        ExpectationResult{&spec, record.values[expectation_key(spec.name)].measured}.ok())
      ++held;
  const auto all = static_cast<double>(expectations.size());
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

StudyResult empty_wall_table(const WallPlan& plan) {
  StudyResult table = empty_table(plan.study);
  table.metrics = {{"truths_held", ""}};
  for (RunResult& row : table.rows) row.metrics.resize(1);
  return table;
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
  std::vector<std::string> names = study_files(plan.study);
  if (plan.score_card) {
    for (const char* type : output::table_types)
      names.push_back(std::string(score_table_name) + type);
    for (const char* type : output::figure_types)
      names.push_back(std::string(score_card_name) + type);
  }
  run.files = std::make_unique<output::ResultFolder>(run.folder, manifest_of(plan.study), names);
  CachedRuns runs(plan.study.name, options, run.folder, rows.size(), stop);
  const StudyRows kept(plan.study, engines, runs.store());
  RunBatch batch = kept.batch(stop);
  batch.length = [&](std::size_t row) { return rows[row].duration / rows[row].deltat; };
  std::mutex telling;
  const StudyResult empty = empty_wall_table(plan);
  if (options.row_done)
    batch.done = [&](std::size_t row) {
      const RunResult result = counted(empty.rows[row], plan.expectations[row], kept.numbers(row));
      const std::lock_guard lock(telling);
      options.row_done(row, result);
    };
  if (!runs.run(batch)) return std::nullopt;
  WallResult& result = run.result;
  result = {plan.study.name,
            plan.study.title,
            plan.study.question,
            plan.study.file,
            plan.scenes,
            {},
            {},
            plan.study.warnings,
            {},
            plan.score_card};
  for (const SubjectPlan& subject : plan.study.subjects) result.subjects.push_back(subject.info);
  Notices notices;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    RunRecord record = kept.numbers(row);
    notices.add(row, record.notices);
    add_record(result, plan, row, std::move(record));
  }
  result.idle = idle_expects(plan, result);
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
  for (const WallLine& line : result.lines) {
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
      const WallCell& cell = line.cells[i];
      if (cell.status.empty()) continue;
      const SubjectInfo& subject = result.subjects[i];
      table.rows.push_back({result.scenes[line.scene].name, line.name, subject.name, subject.engine,
                            cell.law, cell.integrator, text::shortest(cell.measured),
                            text::shortest(cell.expected), line.unit, text::shortest(cell.error),
                            line.allowed,
                            skipped(cell) ? ""
                            : cell.ok     ? "true"
                                          : "false",
                            cell.status});
    }
  }
  return table;
}

void write_wall_files(output::ResultFolder& folder, const WallResult& result, const WallPlan& plan,
                      const Provenance& provenance) {
  folder.write("results.csv", wall_results_table(result).text());
  write_origin(folder, plan.study, provenance);
}

}  // namespace hookpoint::studies
