#include "studies/run/results_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/figures/plot.h"
#include "output/files/file.h"
#include "output/latex/latex.h"
#include "studies/results/matched_grounds.h"
#include "studies/results/pivot.h"
#include "studies/results/selection.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

/// No value where it is none: after an overflow, as in a smaller unit.
std::string field(double value) { return std::isfinite(value) ? text::shortest(value) : ""; }
std::string field(const std::optional<double>& value) { return value ? field(*value) : ""; }
std::string field(const std::optional<bool>& value) {
  return value ? (*value ? "true" : "false") : std::string();
}

/// What a row's run is made of, a column each.
struct Composed {
  const char* name;
  std::string SubjectInfo::*word;
};

/// Those that are no swept column already.
std::vector<Composed> composed_columns(const StudyResult& result) {
  std::vector<Composed> columns{{"engine", &SubjectInfo::engine},
                                {"law", &SubjectInfo::law},
                                {"integrator", &SubjectInfo::integrator},
                                {"settings", &SubjectInfo::settings}};
  std::erase_if(columns, [&](const Composed& column) {
    return sweep_index(result, column.name).has_value();
  });
  return columns;
}

std::vector<std::string> header(const StudyResult& result, bool timing) {
  std::vector<std::string> names;
  for (const SweepColumn& sweep : result.sweeps)
    names.push_back(output::column_title(sweep.name, sweep.unit));
  names.emplace_back("subject");
  for (const Composed& column : composed_columns(result)) names.emplace_back(column.name);
  for (const MetricColumn& metric : result.metrics) {
    if (metric.timing != timing) continue;
    names.push_back(output::column_title(metric.name, metric.unit));
    names.push_back(output::column_title(metric.name + "_predicted", metric.unit));
    names.push_back(metric.name + "_ok");
  }
  names.emplace_back("status");
  return names;
}

std::vector<std::string> table_row(const StudyResult& result, const RunResult& run, bool timing) {
  std::vector<std::string> fields;
  for (std::size_t i = 0; i < run.parameters.size(); ++i)
    fields.push_back(exact_label_of(result.sweeps[i], run.parameters[i]));
  fields.push_back(result.subjects[static_cast<std::size_t>(run.subject)].name);
  const SubjectInfo& composed = composition_of(result, run);
  for (const Composed& column : composed_columns(result)) fields.push_back(composed.*column.word);
  for (std::size_t i = 0; i < result.metrics.size(); ++i) {
    if (result.metrics[i].timing != timing) continue;
    fields.push_back(field(run.metrics[i].measured));
    fields.push_back(field(run.metrics[i].predicted));
    fields.push_back(field(run.metrics[i].ok));
  }
  fields.push_back(run.status);
  return fields;
}

std::string trace_file(const std::string& plot, std::size_t row) {
  return fmt::format("traces/{}_{:05}.csv", plot, row);
}

/// traces/<plot>_<row>.csv: a time column and the signal.
void write_traces(const std::filesystem::path& folder, const StudyResult& result) {
  for (std::size_t row = 0; row < result.rows.size(); ++row) {
    for (std::size_t i = 0; i < result.plots.size(); ++i) {
      const Trace trace = result.rows[row].traces[i].read();
      const PlotSpec& plot = result.plots[i];
      if (trace.time.empty()) continue;
      output::CsvTable table;
      table.header = {output::column_title(plot.x_label.empty() ? "time" : plot.x_label, "s"),
                      output::column_title(plot.y, plot.y_unit)};
      for (std::size_t k = 0; k < trace.time.size(); ++k)
        table.rows.push_back({field(trace.time[k]), field(trace.value[k])});
      output::write_csv(folder / trace_file(plot.name, row), table);
    }
  }
}

/// peer_distance.csv: a row a pair of subjects at equal swept values.
void write_distances(output::ResultFolder& folder, const StudyResult& result) {
  if (result.peer_distances.empty()) return;
  output::CsvTable table;
  for (const SweepColumn& sweep : result.sweeps)
    table.header.push_back(output::column_title(sweep.name, sweep.unit));
  for (const char* name : {"subject", "other", "peer_distance [m]"})
    table.header.emplace_back(name);
  const std::size_t subjects = result.subjects.size();
  for (const PeerDistances& matrix : result.peer_distances) {
    std::vector<std::string> swept;
    for (std::size_t i = 0; i < matrix.parameters.size(); ++i)
      swept.push_back(exact_label_of(result.sweeps[i], matrix.parameters[i]));
    for (std::size_t cell = 0; cell < matrix.distances.size(); ++cell) {
      const std::size_t subject = cell / subjects, other = cell % subjects;
      if (subject == other || !matrix.distances[cell]) continue;
      table.rows.push_back(swept);
      table.rows.back().insert(table.rows.back().end(),
                               {result.subjects[subject].name, result.subjects[other].name,
                                field(*matrix.distances[cell])});
    }
  }
  folder.write("peer_distance.csv", table.text());
}

/// <table>.csv: a row a cell of the Table, down and then across.
void write_pivot(output::ResultFolder& folder, const StudyResult& result, const TableSpec& spec) {
  const Pivot pivot = pivot_of(result, spec);
  output::CsvTable table;
  table.header = {pivot.down, pivot.across, pivot.metric};
  for (const char* name : {"least", "largest", "predicted"})
    table.header.push_back(output::column_title(name, pivot.unit));
  for (const char* name : {"runs", "values", "passed", "failed"}) table.header.emplace_back(name);
  for (const char* name : {"half_width", "difference", "difference_half_width"})
    if (pivot.seeds > 0) table.header.push_back(output::column_title(name, pivot.unit));
  for (std::size_t row = 0; row < pivot.rows.size(); ++row)
    for (std::size_t column = 0; column < pivot.columns.size(); ++column) {
      const PivotCell& cell = pivot.at(row, column);
      if (cell.rows == 0) continue;
      const bool told = cell.values > 0;
      table.rows.push_back({pivot.rows[row], pivot.columns[column], field(cell.mean),
                            told ? field(cell.least) : "", told ? field(cell.largest) : "",
                            field(cell.predicted)});
      for (const int count : {cell.rows, cell.values, cell.passed, cell.failed})
        table.rows.back().push_back(std::to_string(count));
      if (pivot.seeds == 0) continue;
      const auto& difference = cell.difference;
      table.rows.back().push_back(cell.interval ? field(cell.interval->half_width) : "");
      table.rows.back().push_back(difference ? field(difference->mean) : "");
      table.rows.back().push_back(difference ? field(difference->half_width) : "");
    }
  folder.write(spec.name + ".csv", table.text());
}

}  // namespace

output::CsvTable results_table(const StudyResult& result, bool timing) {
  output::CsvTable table;
  table.header = header(result, timing);
  for (const RunResult& run : result.rows) table.rows.push_back(table_row(result, run, timing));
  return table;
}

std::vector<std::string> study_files(const StudyPlan& plan) {
  std::vector<std::string> files{store_folder, cluster_folder,    "experiment.hook",
                                 "scene.hook", "provenance.json", "report.html"};
  for (const std::string_view name : output::latex_names)
    files.push_back(std::string(name) + ".tex");
  for (const std::string_view table : table_names) files.push_back(std::string(table) + ".csv");
  for (const TableSpec& table : plan.tables)
    for (const char* type : output::table_types) files.push_back(table.name + type);
  for (const PlotPlan& plot : plan.plots) {
    for (const char* type : output::figure_types) files.push_back(plot.spec.name + type);
    for (std::size_t row = 0; row < plan.rows.size(); ++row)
      if (plan.records(plot, plan.rows[row])) files.push_back(trace_file(plot.spec.name, row));
  }
  return files;
}

void write_origin(output::ResultFolder& folder, const StudyPlan& plan,
                  const Provenance& provenance) {
  folder.write("experiment.hook", plan.printed);
  if (!plan.scene_printed.empty()) folder.write("scene.hook", plan.scene_printed);
  folder.write("provenance.json", provenance_json(provenance));
}

void write_study_files(output::ResultFolder& folder, const StudyPlan& plan,
                       const StudyResult& result, const Provenance& provenance) {
  folder.write("results.csv", results_table(result, false).text());
  if (std::any_of(result.metrics.begin(), result.metrics.end(),
                  [](const MetricColumn& m) { return m.timing; }))
    folder.write("timing.csv", results_table(result, true).text());
  write_distances(folder, result);
  for (const TableSpec& table : result.tables) write_pivot(folder, result, table);
  write_origin(folder, plan, provenance);
  write_traces(folder.path(), result);
  if (!result.matched.empty())
    output::write_csv(folder.path() / "matched.csv", matched_table(result));
}

}  // namespace hookpoint::studies
