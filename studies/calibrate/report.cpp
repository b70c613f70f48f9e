#include "studies/calibrate/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "output/figures/plot.h"
#include "studies/calibrate/figures.h"
#include "studies/calibrate/idleness.h"
#include "studies/calibrate/outputs.h"
#include "studies/report/page_parts.h"
#include "studies/report/report_page.h"
#include "studies/report/report_tables.h"
#include "studies/results/summary.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

std::string spaced_unit(const VariedConstant& constant) {
  return constant.unit.text.empty() ? "" : " " + constant.unit.text;
}

/// Digits that show an interval: five, and more where it is narrow beside the value.
int digits_of(double low, double high) {
  constexpr int least = 5, most = 10;
  const double size = std::max(std::abs(low), std::abs(high)), width = high - low;
  if (!(width > 0.)) return least;
  return std::clamp(2 + static_cast<int>(std::ceil(std::log10(size / width))), least, most);
}

/// A value and its interval, rounded to what the interval shows; of one that the data do not
/// identify the interval alone.
std::string value_words(const CalibrationPlan& plan, const FittedConstant& constant) {
  const VariedConstant& varied = plan.varied[constant.constant];
  const auto at = [&](const std::optional<double>& share) {
    return exact_value(varied, share.value_or(constant.share));
  };
  const int digits = digits_of(at(constant.low), at(constant.high));
  const auto text = [&](double share) { return text::rounded(exact_value(varied, share), digits); };
  if (!constant.low) return text(constant.share) + spaced_unit(varied);
  if (!constant.identifiable)
    return fmt::format("not identifiable ({} to {}{})", text(*constant.low), text(*constant.high),
                       spaced_unit(varied));
  return fmt::format("{} ({} to {}){}", text(constant.share), text(*constant.low),
                     text(*constant.high), spaced_unit(varied));
}

/// What a subject's calibration says of a constant of the plan, and why when it says no number.
std::string constant_words(const CalibrationPlan& plan, const SubjectCalibration& found,
                           std::size_t constant) {
  const auto fitted = std::ranges::find(found.constants, constant, &FittedConstant::constant);
  if (fitted != found.constants.end())
    return value_words(plan, *fitted) +
           (fitted->identifiable || fitted->reason.empty() ? "" : ": " + fitted->reason);
  const auto left = std::ranges::find(found.left_out, constant, &LeftOut::constant);
  return left == found.left_out.end() ? "–" : "left out: " + left->reason;
}

std::string subject_composition(const SubjectInfo& info) {
  std::string text = "engine " + info.engine;
  for (const std::string* part : {&info.law, &info.integrator, &info.settings})
    if (!part->empty()) text += ", " + *part;
  return text;
}

std::optional<double> expected_error_of_fold(const FoldResult& fold) {
  return fold.prediction ? std::optional(fold.prediction->error) : std::nullopt;
}

/// Means of the folds' errors, weighed alike; `error` is a part of a FoldResult or a function of
/// it.
template <typename Error>
std::optional<double> mean_error(const std::vector<FoldResult>& folds, Error error) {
  if (folds.empty()) return std::nullopt;
  double sum = 0.;
  for (const FoldResult& fold : folds) {
    const std::optional<double> one = std::invoke(error, fold);
    if (!one) return std::nullopt;
    sum += *one * *one;
  }
  return std::sqrt(sum / static_cast<double>(folds.size()));
}

std::string subjects_table(const CalibrationPlan& plan, const CalibrationResult& result) {
  HtmlTable table({"subject", "error", "with the scene's constants", "training, folds",
                   "expected, folds", "held out, folds", "status"},
                  1);
  for (std::size_t i = 0; i < result.subjects.size(); ++i) {
    const SubjectCalibration& found = result.subjects[i];
    const SubjectInfo& info = plan.subjects[i].info;
    table.row({html(info.name) + "<small> " + html(subject_composition(info)) + "</small>",
               text::rounded(found.error, "–"), text::rounded(found.own_error, "–"),
               text::rounded(mean_error(found.folds, &FoldResult::training), "–"),
               text::rounded(mean_error(found.folds, expected_error_of_fold), "–"),
               text::rounded(mean_error(found.folds, &FoldResult::held), "–"), html(found.status)});
  }
  return table.text();
}

std::string constants_of_subjects(const CalibrationPlan& plan, const CalibrationResult& result) {
  HtmlTable table({"subject", "constant", "value (95 % interval)", "range searched"}, 2);
  for (std::size_t i = 0; i < result.subjects.size(); ++i) {
    for (std::size_t constant = 0; constant < plan.varied.size(); ++constant) {
      const VariedConstant& varied = plan.varied[constant];
      table.row({html(plan.subjects[i].info.name), html(varied.name),
                 html(constant_words(plan, result.subjects[i], constant)),
                 html(fmt::format("{} to {}{}{}", text::rounded(varied.from, 6),
                                  text::rounded(varied.to, 6), spaced_unit(varied),
                                  varied.logarithmic ? ", log" : ""))});
    }
  }
  return table.text();
}

/// What it means that a constant stands at the end of its range; "" where none does.
std::string range_ends_note(const CalibrationResult& result) {
  const auto at_end = [](const FittedConstant& one) { return !range_end(one.share).empty(); };
  const bool any = std::ranges::any_of(result.subjects, [&](const SubjectCalibration& found) {
    return std::ranges::any_of(found.constants, at_end);
  });
  if (!any) return "";
  return text_block(
      "note soft",
      "A fit that ends at the end of a range would continue beyond it. Either the range "
      "is too narrow, or the model lacks what the data show and the constant stands "
      "in for it: its value says where the range ends, not what the ground is, and "
      "the other constants of that subject are fitted around it.");
}

std::string correlations_of_subjects(const CalibrationPlan& plan, const CalibrationResult& result) {
  HtmlTable table({"subject", "constant", "with", "correlation"}, 3);
  bool any = false;
  for (std::size_t subject = 0; subject < result.subjects.size(); ++subject) {
    const SubjectCalibration& found = result.subjects[subject];
    for (std::size_t i = 0; i < found.correlations.size(); ++i) {
      for (std::size_t j = i + 1; j < found.correlations.size(); ++j) {
        any = true;
        table.row({html(plan.subjects[subject].info.name),
                   html(plan.varied[found.constants[i].constant].name),
                   html(plan.varied[found.constants[j].constant].name),
                   text::rounded(found.correlations[i][j], 3)});
      }
    }
  }
  if (!any) return "";
  return section("Correlations") + table.text() +
         text_block("note soft",
                    "Over the samples of the bootstrap. Near 1 or -1 the data identify a "
                    "combination of the two, not each; 0 also where a constant does not change "
                    "anything nearby.");
}

/// How intervals are found, whatever the method.
constexpr const char* interval_words =
    "each constant is moved to the ends of its range, the others refitted (profile likelihood), and "
    "separate valleys are searched for. A constant is identifiable unless its interval spans more "
    "than half of its range or reaches an end of it, or separate values explain the data.";

std::string search_words(const CalibrationPlan& plan) {
  return fmt::format(
      "The same for every subject: CMA-ES, {} generations of {} places, the scene's own constants "
      "and the analytic guess among the first, over {} cases. What is made least, and reported as "
      "the error, is the mean over cases of the mean weighted distance of model and measurement. "
      "A quadratic surface over the best places says where to look further, and answers {} "
      "bootstrap samples over those cases without a run. Each fold is a search of its own over as many of "
      "the cases that it may see{}. Points whose mean distance is not greater than the best "
      "one's by more than chance makes it, case by case or sample by sample, are in an interval: "
      "{}",
      plan.generations, plan.population,
      plan.most_cases == 0 ? plan.cases.size() : std::min(plan.most_cases, plan.cases.size()),
      plan.resamples,
      folds_search_whole_box(plan)
          ? ""
          : ", from where the first search ended, whose cases none holds out",
      interval_words);
}

std::string method_words(const CalibrationPlan& plan, const CalibrationResult& result) {
  if (plan.method == FitMethod::cmaes) return search_words(plan);
  const std::string refits = plan.bootstrap == Bootstrap::refits
                                 ? "fitted again from the optimum on"
                                 : "solved with the model linearised at the optimum";
  std::string drawn = "over whole cases";
  if (!plan.resamples_cases()) {
    std::size_t least = 0, most = 0;
    for (const SubjectCalibration& found : result.subjects) {
      if (found.block == 0) continue;
      least = least == 0 ? found.block : std::min(least, found.block);
      most = std::max(most, found.block);
    }
    drawn = least == 0 ? "over the samples of each trace"
            : least == most
                ? fmt::format("of blocks of {} residuals of a trace", least)
                : fmt::format("of blocks of {} to {} residuals of a trace", least, most);
  }
  return fmt::format(
      "The same for every subject: the scene's own constants, the analytic guess where there is "
      "one, and {} points all over the ranges; the best {} of them refined by "
      "Levenberg-Marquardt; {} bootstrap samples {}, each {}. The error is the root mean square "
      "of weight (model - measured): 1 where the weight is 1 over the noise and the model is "
      "right. Points whose error is not greater than the best one's by more than noise makes it are "
      "in an interval: {} An interval is of the data's noise alone: of a subject with an error "
      "well above 1 it is about a constant of a model that does not make this curve.",
      plan.starts, refined_starts, plan.resamples, drawn, refits, interval_words);
}

std::string traces_table(const CalibrationPlan& plan) {
  HtmlTable table({"trace", "file", "column", "port", "samples", "until [s]"}, 4);
  std::size_t rows = 0;
  for (const CalibrationCase& one : plan.cases) {
    for (const TracePlan& trace : one.traces) {
      if (++rows > most_trace_figures) continue;
      table.row({html(trace.name), html(trace.file.filename().string()), html(trace.column),
                 html(trace.port), std::to_string(trace.measured.time.size()),
                 text::rounded(trace.measured.time.back())});
    }
  }
  std::string text = section("What was measured") + table.text();
  if (rows > most_trace_figures)
    text += text_block("note soft", fmt::format("The first {} of {} traces, here and in the "
                                                "figures; curves.csv has all.",
                                                most_trace_figures, rows));
  return text;
}

/// The sentences of all subjects that miss their own weights, as notes.
std::string misfit_notes(const CalibrationPlan& plan, const CalibrationResult& result) {
  std::string notes;
  for (const std::string& misfit : misfits(plan, result))
    notes += text_block("note bad", html(misfit));
  return notes;
}

std::string verdict_words(const CalibrationPlan& plan, const CalibrationResult& result) {
  if (result.interrupted)
    return text_block("verdict bad", "Interrupted: this is what was known by then.");
  const SubjectCalibration* best = nullptr;
  std::size_t index = 0;
  for (std::size_t i = 0; i < result.subjects.size(); ++i) {
    const SubjectCalibration& found = result.subjects[i];
    if (!found.error || (best != nullptr && !(*found.error < *best->error))) continue;
    best = &found;
    index = i;
  }
  if (best == nullptr) return text_block("verdict bad", "✗ No subject has a fit.");
  const std::vector<IdleBlock> idle = idle_blocks(plan, result);
  const std::string words = idle_words(idle);
  return text_block(
      has_fault(idle) ? "verdict bad" : "verdict good",
      html(fmt::format("Least error: {}, {}{}.", plan.subjects[index].info.name,
                       text::rounded(best->error, "–"), words.empty() ? "" : "; " + words)));
}

/// "1 case", "2 cases".
std::string counted(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string calibration_title(const CalibrationPlan& plan) {
  return plan.runs.title.empty() ? spoken(plan.runs.name) : plan.runs.title;
}

}  // namespace

std::string calibration_html(const CalibrationPlan& plan, const CalibrationResult& result,
                             const ReportContext& context,
                             const std::vector<ReportFigure>& figures) {
  std::string page = page_start(calibration_title(plan));
  page += text_block("kicker", "Calibration · " + html(plan.runs.file));
  page += "<h1>" + html(calibration_title(plan)) + "</h1>\n";
  if (!plan.runs.question.empty()) page += text_block("question", html(plan.runs.question));
  page += verdict_words(plan, result) + misfit_notes(plan, result);
  page += text_block(
      "facts", html(fmt::format("{}, {}, {} samples{}.", counted(plan.subjects.size(), "subject"),
                                counted(plan.cases.size(), "case"), plan.residuals(),
                                plan.runs.quick ? ", quick" : "")));
  page += "<pre>" + html(context.command) + "</pre>\n";
  std::string links;
  for (const std::string& file : context.files)
    links +=
        (links.empty() ? "" : " · ") + ("<a href=\"" + html(file) + "\">" + html(file) + "</a>");
  page += text_block("facts", links);
  page += section("The constants") + constants_of_subjects(plan, result) + range_ends_note(result);
  page += section("How well each fits") + subjects_table(plan, result) +
          text_block("note soft", html(method_words(plan, result)));
  page += figures_of(figures);
  page += idle_table(idle_blocks(plan, result));
  page += correlations_of_subjects(plan, result) + traces_table(plan);
  page += provenance_table(context.provenance);
  return page + page_end_with_script();
}

std::string calibration_terminal_text(const CalibrationPlan& plan,
                                      const CalibrationResult& result) {
  std::string text = plan.runs.name + "\n";
  for (std::size_t i = 0; i < result.subjects.size(); ++i) {
    const SubjectCalibration& found = result.subjects[i];
    text += fmt::format("  {}: ", plan.subjects[i].info.name);
    text += found.error
                ? fmt::format("error {}, with the scene's own constants {}",
                              text::rounded(found.error, "–"), text::rounded(found.own_error, "–"))
                : std::string("no fit");
    text += (found.status == "ok" ? "" : "; " + found.status) + "\n";
    for (std::size_t constant = 0; constant < plan.varied.size(); ++constant)
      text += fmt::format("    {:<22} {}\n", plan.varied[constant].name,
                          constant_words(plan, found, constant));
    const auto held = mean_error(found.folds, &FoldResult::held);
    if (held)
      text +=
          fmt::format("    {:<22} {}, training {}\n", "held-out error", text::rounded(held, "–"),
                      text::rounded(mean_error(found.folds, &FoldResult::training), "–"));
  }
  for (const std::string& misfit : misfits(plan, result)) text += "  " + misfit + "\n";
  for (const IdleBlock& block : idle_blocks(plan, result)) text += "  " + line_of(block) + "\n";
  return text;
}

}  // namespace hookpoint::studies
