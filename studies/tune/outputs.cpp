#include "studies/tune/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "output/figures/plot.h"
#include "output/latex/latex.h"
#include "studies/results/statistics.h"
#include "studies/run/results_csv.h"
#include "studies/search/material_text.h"
#include "studies/tune/figures.h"
#include "studies/tune/report.h"
#include "text/json.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

using text::shortest;

void add_constant_titles(output::CsvTable& table, const TunePlan& plan) {
  for (const VariedConstant& constant : plan.varied)
    table.header.push_back(output::column_title(constant.name, constant.unit.text));
}

void add_constants(std::vector<std::string>& row, const Candidate& candidate) {
  for (const auto& value : candidate.values) row.push_back(shortest(value));
}

/// "ok", or what the first run that did not finish says.
std::string status_of(const Candidate& candidate) {
  const auto failed = std::ranges::find_if(
      candidate.statuses, [](const std::string& status) { return status != "ok"; });
  return failed == candidate.statuses.end() ? "ok" : *failed;
}

/// "sink_distance": of an objective with a target, what is minimised.
std::string distance_column(const TunePlan& plan, const ObjectivePlan& objective) {
  return plan.name_of(objective) + "_distance";
}

void add_titles(output::CsvTable& table, const std::string& name, std::string_view unit,
                std::initializer_list<const char*> parts) {
  for (const char* part : parts) table.header.push_back(output::column_title(name + part, unit));
}

/// A value made of the seeds and its standard error; empty without.
void add_mean(std::vector<std::string>& row, const std::optional<double>& value,
              const std::optional<std::vector<double>>& seeds) {
  row.push_back(shortest(value));
  row.push_back(seeds ? shortest(standard_error(*seeds)) : "");
}

void add_objective(std::vector<std::string>& row, const ObjectivePlan& objective,
                   const Candidate& candidate) {
  add_mean(row, value_of(objective, candidate), objective_of_seeds(objective, candidate));
}

/// Mean, standard error and "1.5 2.5", the seeds' values, of one metric.
void add_metric(std::vector<std::string>& row, const Candidate& candidate, std::size_t metric) {
  const auto values = values_of_seeds(candidate, metric);
  add_mean(row, values ? std::optional(mean(*values)) : std::nullopt, values);
  std::string each;
  for (const auto& measured : candidate.measured)
    each += (each.empty() ? "" : " ") + shortest(measured[metric], "-");
  row.push_back(each);
}

std::string number_text(std::size_t index) { return std::to_string(index + 1); }

void write_value(text::JsonWriter& json, std::string_view key, const std::optional<double>& value) {
  json.key(key);
  if (value)
    json.value(*value);
  else
    json.null();
}

void write_constants(text::JsonWriter& json, const TunePlan& plan, const Candidate& candidate) {
  json.key("constants").begin_object();
  for (std::size_t i = 0; i < plan.varied.size(); ++i) {
    json.key(plan.varied[i].name).begin_object();
    write_value(json, "value", candidate.values[i]);
    json.member("unit", plan.varied[i].unit.text).end_object();
  }
  json.end_object();
}

void write_requirements(text::JsonWriter& json, const TunePlan& plan, const TuneResult& result) {
  json.key("requirements").begin_array();
  for (const RequirementPlan& required : plan.requirements) {
    json.begin_object()
        .member("words", required.words)
        .member("met", meets(result.best(), required));
    if (result.fresh)
      json.member("met_with_fresh_seeds", meets(result.candidates[*result.fresh], required));
    json.end_object();
  }
  json.end_array();
}

void write_reference(text::JsonWriter& json, const TunePlan& plan, const TuneResult& result,
                     const TuneReference& reference) {
  const Candidate& candidate = result.candidates[reference.candidate];
  json.key(reference.key).begin_object().member("evaluation", reference.candidate + 1);
  json.member("feasible", is_feasible(plan, candidate));
  write_constants(json, plan, candidate);
  json.key("objectives").begin_object();
  for (std::size_t i = 0; i < reference.comparisons.size(); ++i) {
    const ObjectiveComparison& comparison = reference.comparisons[i];
    json.key(plan.name_of(plan.objectives[i])).begin_object();
    if (plan.objectives[i].target) json.member("of", plan.label_of(plan.objectives[i]));
    write_value(json, "recommended", comparison.tuned);
    write_value(json, reference.key, comparison.other);
    json.member("difference", comparison.difference).member("margin_95", comparison.margin);
    json.member("verdict", words_of(comparison.verdict)).end_object();
  }
  json.end_object().end_object();
}

const char* direction_of(const ObjectivePlan& objective) {
  return objective.target ? "target" : objective.maximise ? "maximise" : "minimise";
}

void write_objectives(text::JsonWriter& json, const TunePlan& plan, const TuneResult& result) {
  json.key("objectives").begin_object();
  for (const ObjectivePlan& objective : plan.objectives) {
    json.key(plan.name_of(objective)).begin_object();
    json.member("unit", plan.unit_of(objective));
    json.member("direction", direction_of(objective));
    const auto values = values_of_seeds(result.best(), objective.metric);
    const auto error_of = [](const std::optional<std::vector<double>>& seeds) {
      return seeds ? std::optional(standard_error(*seeds)) : std::nullopt;
    };
    if (objective.target) {
      json.member("target", *objective.target);
      write_value(json, "value", values ? std::optional(mean(*values)) : std::nullopt);
      write_value(json, "distance", value_of(objective, result.best()));
      write_value(json, "distance_error", error_of(objective_of_seeds(objective, result.best())));
    } else {
      write_value(json, "value", value_of(objective, result.best()));
    }
    write_value(json, "standard_error", error_of(values));
    json.end_object();
  }
  json.end_object();
}

}  // namespace

std::string_view words_of(ObjectiveComparison::Verdict verdict) {
  switch (verdict) {
    case ObjectiveComparison::Verdict::better:
      return "better";
    case ObjectiveComparison::Verdict::worse:
      return "worse";
    case ObjectiveComparison::Verdict::within_noise:
      return "within the noise";
    case ObjectiveComparison::Verdict::undecided:
      return "not decided";
  }
  return "";
}

std::vector<ConstantSetting> settings_of(const TunePlan& plan, const Candidate& candidate) {
  std::vector<double> values;
  if (candidate.stage != CandidateStage::own)
    for (const auto& value : candidate.values) values.push_back(*value);
  return plan.settings(values);
}

std::string material_file(const TunePlan& plan) {
  return "materials/" + plan.scene->material() + "_tuned.hook";
}

output::CsvTable evaluations_table(const TunePlan& plan, const TuneResult& result) {
  output::CsvTable table;
  table.header = {"evaluation", "stage", "generation"};
  add_constant_titles(table, plan);
  table.header.insert(table.header.end(), {"feasible", "violation"});
  for (const MetricDefinition* metric : plan.runs.metric_definitions())
    add_titles(table, std::string(metric->name), metric->unit, {"", "_error", "_seeds"});
  for (const ObjectivePlan& objective : plan.objectives)
    if (objective.target)
      add_titles(table, distance_column(plan, objective), plan.unit_of(objective), {"", "_error"});
  table.header.insert(table.header.end(), {"first_seed", "seeds", "status"});
  for (std::size_t i = 0; i < result.candidates.size(); ++i) {
    const Candidate& candidate = result.candidates[i];
    const double violation = violation_of(plan, candidate);
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {number_text(i), std::string(name_of(candidate.stage)),
           candidate.generation > 0 ? std::to_string(candidate.generation) : ""};
    add_constants(row, candidate);
    row.insert(row.end(), {violation > 0. ? "no" : "yes", shortest(violation)});
    for (std::size_t metric = 0; metric < plan.runs.metrics.size(); ++metric)
      add_metric(row, candidate, metric);
    for (const ObjectivePlan& objective : plan.objectives)
      if (objective.target) add_objective(row, objective, candidate);
    row.insert(row.end(), {std::to_string(candidate.first_seed), std::to_string(candidate.seeds()),
                           status_of(candidate)});
  }
  return table;
}

output::CsvTable pareto_table(const TunePlan& plan, const TuneResult& result) {
  output::CsvTable table;
  table.header = {"evaluation"};
  add_constant_titles(table, plan);
  for (const ObjectivePlan& objective : plan.objectives) {
    const std::string unit = plan.unit_of(objective);
    add_titles(table, plan.name_of(objective), unit, {"", "_error"});
    if (objective.target) add_titles(table, distance_column(plan, objective), unit, {"", "_error"});
  }
  table.header.emplace_back("recommended");
  for (const std::size_t member : result.pareto) {
    const Candidate& candidate = result.candidates[member];
    std::vector<std::string>& row = table.rows.emplace_back();
    row.push_back(number_text(member));
    add_constants(row, candidate);
    for (const ObjectivePlan& objective : plan.objectives) {
      const auto values = values_of_seeds(candidate, objective.metric);
      if (objective.target)
        add_mean(row, values ? std::optional(mean(*values)) : std::nullopt, values);
      add_objective(row, objective, candidate);
    }
    row.emplace_back(member == result.recommended->candidate ? "yes" : "");
  }
  return table;
}

output::CsvTable indices_table(const TunePlan& plan, const TuneResult& result) {
  output::CsvTable table;
  table.header = {"objective", "constant"};
  for (const std::string order : {"first_order", "total_order"})
    table.header.insert(table.header.end(), {order, order + "_low", order + "_high"});
  table.header.emplace_back("samples");
  for (std::size_t i = 0; i < result.indices.size(); ++i) {
    if (!result.indices[i]) continue;
    const SobolIndices& indices = *result.indices[i];
    for (std::size_t c = 0; c < plan.varied.size(); ++c) {
      const IndexInterval &first = indices.first_interval[c], &total = indices.total_interval[c];
      table.rows.push_back({plan.name_of(plan.objectives[i]), plan.varied[c].name,
                            shortest(indices.first[c]), shortest(first.low), shortest(first.high),
                            shortest(indices.total[c]), shortest(total.low), shortest(total.high),
                            std::to_string(indices.used)});
    }
  }
  return table;
}

std::string recommended_json(const TunePlan& plan, const TuneResult& result) {
  text::JsonWriter json;
  json.begin_object().member("tune", plan.label).member("material", plan.scene->material());
  json.member("complete", !result.interrupted);
  json.member("evaluations", result.candidates.size());
  if (!result.recommended) return json.end_object().text();
  json.member("evaluation", result.recommended->candidate + 1);
  json.member("feasible", result.recommended->feasible);
  json.member("reason", result.recommended->reason);
  write_constants(json, plan, result.best());
  write_objectives(json, plan, result);
  write_requirements(json, plan, result);
  json.member("seeds", plan.seeds);
  json.member("fresh_seeds", result.fresh ? fresh_seeds(plan) : 0);
  json.member("analytic_guess", result.analytic_words);
  json.key("compared_with").begin_object();
  for (const TuneReference& reference : result.references)
    write_reference(json, plan, result, reference);
  return json.end_object().end_object().text();
}

std::string material_text(const TunePlan& plan, const TuneResult& result,
                          const std::string& command) {
  language::Diagnostics unreported;
  const auto tree = plan.scene->compose(settings_of(plan, result.best()), 1, unreported);
  if (tree == nullptr) return "";
  std::string text = comment_line(plan.scene->material() + " as tuned by `" + command + "`" +
                                  (result.interrupted ? ", which was interrupted" : ""));
  std::string values;
  for (std::size_t i = 0; i < plan.varied.size(); ++i)
    if (const auto& value = result.best().values[i])
      values += (values.empty() ? "" : ", ") + plan.varied[i].name + " = " +
                plan.varied[i].unit.with_unit(*value);
  text += comment_line("with " + values + ": " + result.recommended->reason + ".") + "\n";
  return text + material_block(plan.scene->material_of(*tree), plan.scene->material() + "_tuned");
}

namespace {

/// The scene with the recommended constants.
std::string scene_text(const TunePlan& plan, const TuneResult& result) {
  language::Diagnostics unreported;
  const auto scene = plan.scene->compose(settings_of(plan, result.best()), 1, unreported);
  return scene == nullptr ? "" : language::print(*scene);
}

/// The files that the report links to.
std::vector<output::ResultFile> linked_tune_files(const TunePlan& plan, const TuneRun& run,
                                                  const std::string& command) {
  const TuneResult& result = run.result;
  const auto if_recommended = [&result](std::function<std::string()> text) {
    return [&result, text = std::move(text)] { return result.recommended ? text() : ""; };
  };
  return {
      {"evaluations.csv", [&] { return evaluations_table(plan, result).text(); }},
      {"recommended.json", [&] { return recommended_json(plan, result); }},
      {"experiment.hook", [&] { return plan.runs.printed; }},
      {"provenance.json", [&] { return provenance_json(run.provenance); }},
      {"sobol.csv",
       [&] { return result.indices.empty() ? "" : indices_table(plan, result).text(); }},
      {"pareto.csv", if_recommended([&] { return pareto_table(plan, result).text(); })},
      {material_file(plan), if_recommended([&] { return material_text(plan, result, command); })},
      {"scene.hook", if_recommended([&] { return scene_text(plan, result); })}};
}

}  // namespace

std::vector<std::string> tune_files(const TunePlan& plan) {
  std::vector<std::string> files = output::names_of(linked_tune_files(plan, {}, {}));
  files.insert(files.end(), {store_folder, "report.html", "pareto.tex", "sobol.tex",
                             std::string(output::latex_document_name) + ".tex"});
  for (const std::string& figure : tune_figure_names(plan))
    for (const char* type : output::figure_types) files.push_back(figure + type);
  return files;
}

std::vector<ReportFigure> write_tuning(output::ResultFolder& folder, const TunePlan& plan,
                                       const TuneRun& run, const std::string& command) {
  folder.write(linked_tune_files(plan, run, command));
  std::vector<ReportFigure> figures = draw_tune_figures(plan, run.result, folder.path());
  folder.write(
      "report.html",
      tune_html(plan, run.result, {command, {}, provenance_lines(run.provenance), folder.written()},
                figures));
  folder.finish();
  return figures;
}

}  // namespace hookpoint::studies
