#include "studies/calibrate/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

#include "output/figures/plot.h"
#include "output/latex/latex.h"
#include "studies/calibrate/figures.h"
#include "studies/calibrate/report.h"
#include "studies/measurements/trace_residual.h"
#include "studies/run/results_csv.h"
#include "studies/search/material_text.h"
#include "text/json.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

using text::shortest;

/// Of curves.csv: hundreds of runs are millions of numbers.
constexpr int curve_digits = 7;

/// Calls `visit(subject of the plan, its result)` for each that was begun.
template <class Visit>
void for_each_subject(const CalibrationPlan& plan, const CalibrationResult& result, Visit visit) {
  for (std::size_t i = 0; i < result.subjects.size(); ++i)
    visit(plan.subjects[i], result.subjects[i]);
}

std::string constant_title(const VariedConstant& constant) {
  return output::column_title(constant.name, constant.unit.text);
}

/// Values of all constants of the plan, empty where the subject has none; its points are of
/// `fitted`.
void add_values(std::vector<std::string>& row, const CalibrationPlan& plan,
                const std::vector<FittedConstant>& fitted, const UnitPoint& point) {
  for (std::size_t constant = 0; constant < plan.varied.size(); ++constant) {
    const auto found = std::ranges::find(fitted, constant, &FittedConstant::constant);
    const auto index = static_cast<std::size_t>(found - fitted.begin());
    row.push_back(index < point.size() ? shortest(plan.varied[constant].at(point[index])) : "");
  }
}

/// The settings of all that was fitted, rounded as they are written.
std::vector<ConstantSetting> fitted_settings(const CalibrationPlan& plan,
                                             const SubjectCalibration& result) {
  std::vector<ConstantSetting> settings;
  for (const FittedConstant& constant : result.constants) {
    if (plan.offset_of(constant.constant) != nullptr) continue;
    const VariedConstant& varied = plan.varied[constant.constant];
    settings.push_back(varied.setting(varied.at(constant.share)));
  }
  return settings;
}

/// Mean length of normal errors of `parts` parts, each of standard deviation 1: the mean of the chi
/// distribution, sqrt(2) G((n + 1)/2)/G(n/2).
double mean_length(std::size_t parts) {
  const auto count = static_cast<double>(parts);
  return std::numbers::sqrt2 * std::tgamma(0.5 * (count + 1.)) / std::tgamma(0.5 * count);
}

/// Error of a model that is right, where each weight is 1 over the noise: of least squares 1, of
/// distances the mean length of the noise.
double expected_error(const CalibrationPlan& plan) {
  if (plan.method == FitMethod::least_squares) return 1.;
  double sum = 0.;
  for (const CalibrationCase& one : plan.cases) {
    double of_case = 0.;
    for (const TracePlan& trace : one.traces) of_case += mean_length(trace.residuals_a_sample());
    sum += of_case / static_cast<double>(one.traces.size());
  }
  return sum / static_cast<double>(plan.cases.size());
}

/// "more `starts` (now 16)": what a search of the plan's method may lack.
std::string wider_search(const CalibrationPlan& plan) {
  return plan.method == FitMethod::least_squares
             ? fmt::format("more `starts` (now {})", plan.starts)
             : fmt::format("more `generations` (now {})", plan.generations);
}

/// "misses its own weights: ...", with what to try; "" of a fit that does not.
std::string misfit_of(const CalibrationPlan& plan, const SubjectCalibration& found) {
  if (plan.varied.empty() || !found.error) return "";
  const double expected = expected_error(plan);
  if (!(*found.error > greatest_error_of_a_fit * expected)) return "";
  std::string ends;
  for (const FittedConstant& constant : found.constants)
    if (!range_end(constant.share).empty())
      ends += (ends.empty() ? "" : ", ") + plan.varied[constant.constant].name;
  return fmt::format(
      "misses its own weights: error {}, where {} is expected if each weight is 1 over the noise. "
      "Try {}, {}, another clock `offset`, or another law: this one may not make the measured "
      "curve",
      text::rounded(*found.error), text::rounded(expected, 2), wider_search(plan),
      ends.empty() ? "wider ranges" : "a wider range of " + ends);
}

}  // namespace

std::vector<std::string> misfits(const CalibrationPlan& plan, const CalibrationResult& result) {
  std::vector<std::string> sentences;
  for_each_subject(plan, result,
                   [&](const CalibrationSubject& subject, const SubjectCalibration& found) {
                     const std::string misfit = misfit_of(plan, found);
                     if (!misfit.empty()) sentences.push_back(subject.info.name + " " + misfit);
                   });
  return sentences;
}

std::string calibration_json(const CalibrationPlan& plan, const CalibrationResult& result) {
  text::JsonWriter json;
  json.begin_object().member("name", plan.runs.name).member("interrupted", result.interrupted);
  json.key("subjects").begin_object();
  for_each_subject(
      plan, result, [&](const CalibrationSubject& subject, const SubjectCalibration& found) {
        const auto number = [&](const char* key, const std::optional<double>& value) {
          json.key(key);
          if (value)
            json.value(*value);
          else
            json.null();
        };
        json.key(subject.info.name).begin_object().member("status", found.status);
        number("error", found.error);
        number("own_error", found.own_error);
        json.member("misfit", misfit_of(plan, found)).key("constants").begin_object();
        for (const FittedConstant& constant : found.constants) {
          const VariedConstant& varied = plan.varied[constant.constant];
          const auto value = [&](const std::optional<double>& share) {
            return share ? std::optional(varied.at(*share)) : std::nullopt;
          };
          json.key(varied.name).begin_object().member("unit", varied.unit.text);
          number("value",
                 constant.identifiable || !constant.low ? value(constant.share) : std::nullopt);
          number("low", value(constant.low));
          number("high", value(constant.high));
          json.member("identifiable", constant.identifiable).member("reason", constant.reason);
          json.end_object();
        }
        json.end_object().key("left_out").begin_object();
        for (const LeftOut& left : found.left_out)
          json.member(plan.varied[left.constant].name, left.reason);
        json.end_object().end_object();
      });
  return json.end_object().end_object().text();
}

std::string value_text(const CalibrationPlan& plan, const FittedConstant& constant, double share) {
  return shortest(plan.varied[constant.constant].at(share));
}

std::string material_file(const CalibrationPlan& plan, const CalibrationSubject& subject) {
  return "materials/" + plan.material + "_" + subject.info.name + ".hook";
}

output::CsvTable calibration_table(const CalibrationPlan& plan, const CalibrationResult& result) {
  output::CsvTable table;
  table.header = {"subject", "constant",   "unit",   "value", "low",
                  "high",    "identified", "at_end", "reason"};
  for_each_subject(
      plan, result, [&](const CalibrationSubject& subject, const SubjectCalibration& found) {
        for (std::size_t constant = 0; constant < plan.varied.size(); ++constant) {
          const VariedConstant& varied = plan.varied[constant];
          std::vector<std::string> row{subject.info.name, varied.name, varied.unit.text};
          const auto fitted =
              std::ranges::find(found.constants, constant, &FittedConstant::constant);
          const auto left = std::ranges::find(found.left_out, constant, &LeftOut::constant);
          const auto share_text = [&](const std::optional<double>& share) {
            return share ? value_text(plan, *fitted, *share) : std::string();
          };
          if (fitted != found.constants.end()) {
            // Of a constant that is not identifiable the interval stands there, the number does
            // not.
            const bool known = fitted->identifiable || !fitted->low;
            row.insert(row.end(), {known ? share_text(fitted->share) : "", share_text(fitted->low),
                                   share_text(fitted->high), fitted->identifiable ? "yes" : "no",
                                   std::string(range_end(fitted->share)), fitted->reason});
          } else {
            row.insert(row.end(),
                       {"", "", "", "no", "",
                        left != found.left_out.end() ? "left out: " + left->reason : found.status});
          }
          table.rows.push_back(std::move(row));
        }
      });
  return table;
}

output::CsvTable correlations_table(const CalibrationPlan& plan, const CalibrationResult& result) {
  output::CsvTable table;
  table.header = {"subject", "constant", "other", "correlation"};
  for_each_subject(
      plan, result, [&](const CalibrationSubject& subject, const SubjectCalibration& found) {
        for (std::size_t i = 0; i < found.correlations.size(); ++i)
          for (std::size_t j = 0; j < found.correlations.size(); ++j)
            table.rows.push_back({subject.info.name, plan.varied[found.constants[i].constant].name,
                                  plan.varied[found.constants[j].constant].name,
                                  shortest(found.correlations[i][j])});
      });
  return table;
}

output::CsvTable fits_table(const CalibrationPlan& plan, const CalibrationResult& result) {
  output::CsvTable table;
  table.header = {"subject", "stage", "number"};
  for (const VariedConstant& constant : plan.varied)
    table.header.push_back(constant_title(constant));
  table.header.insert(table.header.end(), {"error", "places", "status"});
  for_each_subject(
      plan, result, [&](const CalibrationSubject& subject, const SubjectCalibration& found) {
        for (const FitRecord& record : found.records) {
          std::vector<std::string>& row = table.rows.emplace_back();
          row = {subject.info.name, std::string(name_of(record.stage)),
                 std::to_string(record.number)};
          add_values(row, plan, found.constants, record.point);
          row.insert(row.end(),
                     {shortest(record.error), std::to_string(record.models), record.status});
        }
      });
  return table;
}

output::CsvTable folds_table(const CalibrationPlan& plan, const CalibrationResult& result) {
  output::CsvTable table;
  table.header = {"subject", "fold", "held_out"};
  for (const VariedConstant& constant : plan.varied)
    table.header.push_back(constant_title(constant));
  table.header.insert(table.header.end(), {"training_error", "held_out_error", "promised_error",
                                           "promised_low", "promised_high"});
  for_each_subject(
      plan, result, [&](const CalibrationSubject& subject, const SubjectCalibration& found) {
        for (std::size_t i = 0; i < found.folds.size(); ++i) {
          const FoldResult& fold = found.folds[i];
          std::string held;
          for (const std::size_t one : fold.held_out)
            held += (held.empty() ? "" : " ") + plan.cases[one].name;
          std::vector<std::string>& row = table.rows.emplace_back();
          row = {subject.info.name, std::to_string(i + 1), held};
          add_values(row, plan, found.constants, fold.point);
          row.insert(row.end(), {shortest(fold.training), shortest(fold.held)});
          for (double PredictionInterval::*part :
               {&PredictionInterval::error, &PredictionInterval::low, &PredictionInterval::high})
            row.push_back(fold.prediction ? text::shortest((*fold.prediction).*part) : "");
        }
      });
  return table;
}

output::CsvTable curves_table(const CalibrationPlan& plan, const CalibrationResult& result,
                              Residuals SubjectCalibration::*residuals) {
  output::CsvTable table;
  table.header = {"trace", "port", "unit", "time [s]", "measured"};
  for (std::size_t i = 0; i < result.subjects.size(); ++i)
    table.header.push_back(plan.subjects[i].info.name);
  std::size_t first = 0;
  for (const CalibrationCase& one : plan.cases) {
    for (const TracePlan& trace : one.traces) {
      for (std::size_t i = 0; i < trace.measured.time.size(); ++i) {
        std::vector<std::vector<std::string>> rows;
        const std::vector<double> values = measured(trace, i);
        for (std::size_t part = 0; part < values.size(); ++part)
          rows.push_back({trace.name, trace.parts[part], trace.port_unit,
                          text::rounded(trace.measured.time[i], curve_digits),
                          text::rounded(values[part], curve_digits)});
        for (const SubjectCalibration& found : result.subjects) {
          const auto of_trace = residuals_of(found.*residuals, trace, first);
          const std::vector<double> model =
              of_trace.empty() ? std::vector<double>() : modelled(trace, i, of_trace);
          for (std::size_t part = 0; part < rows.size(); ++part)
            rows[part].push_back(model.empty() ? "" : text::rounded(model[part], curve_digits));
        }
        std::ranges::move(rows, std::back_inserter(table.rows));
      }
      first += trace.residuals();
    }
  }
  return table;
}

std::string material_text(const CalibrationPlan& plan, const CalibrationSubject& subject,
                          const SubjectCalibration& result, const std::string& command) {
  if (result.constants.empty()) return "";
  language::Diagnostics ignored;
  const auto tree = subject.scene->compose(fitted_settings(plan, result), 1, ignored);
  if (tree == nullptr) return "";
  std::string text = comment_line(
      fmt::format("{} for {} as calibrated by `{}`{}", plan.material, subject.info.name, command,
                  result.status == "interrupted" ? ", which was interrupted" : ""));
  for (const FittedConstant& constant : result.constants) {
    const VariedConstant& varied = plan.varied[constant.constant];
    const std::string unit = varied.unit.text.empty() ? "" : " " + varied.unit.text;
    text += comment_line(constant.identifiable
                             ? fmt::format("{} = {}{}, 95 % from {} to {}", varied.name,
                                           value_text(plan, constant, constant.share), unit,
                                           value_text(plan, constant, *constant.low),
                                           value_text(plan, constant, *constant.high))
                             : fmt::format("{}: not identifiable from these data, {}", varied.name,
                                           constant.reason));
  }
  for (const LeftOut& left : result.left_out)
    text += comment_line(plan.varied[left.constant].name + ": left out, " + left.reason);
  return text + "\n" +
         material_block(subject.scene->material_of(*tree), plan.material + "_" + subject.info.name);
}

namespace {

/// The files that the report links to.
std::vector<output::ResultFile> linked_calibration_files(const CalibrationPlan& plan,
                                                         const CalibrationRun& run,
                                                         const std::string& command) {
  const CalibrationResult& result = run.result;
  std::vector<output::ResultFile> files;
  const auto add = [&](const char* name, auto table) {
    files.push_back({name, [table] {
                       const output::CsvTable made = table();
                       return made.rows.empty() ? "" : made.text();
                     }});
  };
  add("calibration.csv", [&] { return calibration_table(plan, result); });
  add("correlations.csv", [&] { return correlations_table(plan, result); });
  add("evaluations.csv", [&] { return fits_table(plan, result); });
  add("folds.csv", [&] { return folds_table(plan, result); });
  add("curves.csv", [&] { return curves_table(plan, result); });
  add("own_curves.csv", [&] {
    return plan.varied.empty() ? output::CsvTable{}
                               : curves_table(plan, result, &SubjectCalibration::own_residuals);
  });
  for (std::size_t i = 0; i < plan.subjects.size(); ++i)
    files.push_back({material_file(plan, plan.subjects[i]), [&, i] {
                       return i < result.subjects.size()
                                  ? material_text(plan, plan.subjects[i], result.subjects[i],
                                                  command)
                                  : "";
                     }});
  files.push_back({"calibration.json", [&] { return calibration_json(plan, result); }});
  files.push_back({"experiment.hook", [&] { return plan.runs.printed; }});
  files.push_back({"scene.hook", [&] { return plan.runs.scene_printed; }});
  files.push_back({"provenance.json", [&] { return provenance_json(run.provenance); }});
  return files;
}

}  // namespace

std::vector<std::string> calibration_files(const CalibrationPlan& plan) {
  std::vector<std::string> files = output::names_of(linked_calibration_files(plan, {}, {}));
  files.insert(files.end(), {store_folder, "report.html", "calibration.tex",
                             std::string(output::latex_document_name) + ".tex"});
  for (const std::string& figure : calibration_figure_names(plan))
    for (const char* type : output::figure_types) files.push_back(figure + type);
  return files;
}

std::vector<ReportFigure> write_calibration(output::ResultFolder& folder,
                                            const CalibrationPlan& plan, const CalibrationRun& run,
                                            const std::string& command) {
  folder.write(linked_calibration_files(plan, run, command));
  std::vector<ReportFigure> figures = draw_calibration_figures(plan, run.result, folder.path());
  folder.write(
      "report.html",
      calibration_html(plan, run.result,
                       {command, {}, provenance_lines(run.provenance), folder.written()}, figures));
  folder.finish();
  return figures;
}

}  // namespace hookpoint::studies
