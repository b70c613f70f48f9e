#include "studies/tune/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "studies/report/page_parts.h"
#include "studies/report/report_page.h"
#include "studies/report/report_tables.h"
#include "studies/results/statistics.h"
#include "studies/results/summary.h"
#include "studies/tune/idleness.h"
#include "studies/tune/outputs.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

using Verdict = ObjectiveComparison::Verdict;

std::string number_with(double value, const std::string& unit) {
  return text::rounded(value) + (unit.empty() ? "" : " " + unit);
}

/// "0.02 ± 0.001 m" of what is made of the seeds' values.
std::string seeds_text(double value, std::span<const double> seeds, const std::string& unit) {
  if (seeds.size() < 2) return number_with(value, unit);
  return text::rounded(value) + " ± " + number_with(standard_error(seeds), unit);
}

/// "0.02 ± 0.001 m"; of an objective with a target "2.9 ± 0.1 mm, 0.1 ± 0.1 mm off", in the unit
/// that the target is written in. `unit`: shown_unit_of the objective, or "" where it stands
/// elsewhere.
std::string with_error(const ObjectivePlan& objective, const Candidate& candidate,
                       const std::string& unit) {
  auto values = values_of_seeds(candidate, objective.metric);
  if (!values) return "no value";
  auto wanted = *objective_of_seeds(objective, candidate);
  for (std::vector<double>* numbers : {&*values, &wanted})
    for (double& number : *numbers) number *= objective.in_written_unit;
  const std::string text = seeds_text(take_of(objective, wanted), wanted, unit);
  return objective.target ? seeds_text(mean(*values), *values, unit) + ", " + text + " off" : text;
}

/// "minimise foot_slip", "sink = 3 mm".
std::string goal_text(const TunePlan& plan, const ObjectivePlan& objective) {
  const std::string name = plan.name_of(objective);
  if (objective.target) return name + " = " + objective.target_text;
  return (objective.maximise ? "maximise " : "minimise ") + name;
}

std::string constant_text(const VariedConstant& constant, const std::optional<double>& value) {
  return value ? text::rounded(*value, 6) +
                     (constant.unit.text.empty() ? "" : " " + constant.unit.text)
               : "not decided";
}

std::string range_text(const VariedConstant& constant) {
  return fmt::format("{} to {}{}{}", text::rounded(constant.from, 6), text::rounded(constant.to, 6),
                     constant.unit.text.empty() ? "" : " " + constant.unit.text,
                     constant.logarithmic ? ", log" : "");
}

std::string constants_table(const TunePlan& plan, const TuneResult& result) {
  std::vector<std::string> head{"constant", "range", "recommended"};
  for (const TuneReference& reference : result.references) head.push_back(html(reference.name));
  HtmlTable table(head, 2);
  for (std::size_t i = 0; i < plan.varied.size(); ++i) {
    const VariedConstant& constant = plan.varied[i];
    std::vector<std::string> row{html(constant.name), html(range_text(constant)),
                                 html(constant_text(constant, result.best().values[i]))};
    for (const TuneReference& reference : result.references)
      row.push_back(
          html(constant_text(constant, result.candidates[reference.candidate].values[i])));
    table.row(row);
  }
  return table.text();
}

/// "better by 0.01 ± 0.002"
std::string comparison_text(const ObjectiveComparison& comparison) {
  std::string text(words_of(comparison.verdict));
  if (comparison.verdict == Verdict::undecided || !comparison.other) return text;
  return fmt::format("{} ({} ± {})", text, text::rounded(comparison.difference, 3),
                     text::rounded(comparison.margin, 2));
}

std::string comparison_cell(const ObjectiveComparison& comparison) {
  const char* style = comparison.verdict == Verdict::better  ? "good"
                      : comparison.verdict == Verdict::worse ? "bad"
                                                             : "soft";
  return fmt::format("<span class=\"{}\">{}</span>", style, html(comparison_text(comparison)));
}

/// On fresh seeds where they were run.
std::string comparison_table(const TunePlan& plan, const TuneResult& result) {
  const bool checked = result.fresh.has_value();
  std::vector<std::string> head{"objective", "recommended"};
  for (const TuneReference& reference : result.references) {
    head.push_back(html(reference.name));
    if (checked) head.push_back("the recommended is");
  }
  HtmlTable table(head, 1);
  const Candidate& tuned = checked ? result.candidates[*result.fresh] : result.best();
  for (std::size_t i = 0; i < plan.objectives.size(); ++i) {
    const ObjectivePlan& objective = plan.objectives[i];
    const std::string unit = plan.shown_unit_of(objective);
    std::vector<std::string> row{html(goal_text(plan, objective)),
                                 html(with_error(objective, tuned, unit))};
    for (const TuneReference& reference : result.references) {
      const std::size_t other = checked ? *reference.fresh : reference.candidate;
      row.push_back(html(with_error(objective, result.candidates[other], unit)));
      if (checked) row.push_back(comparison_cell(reference.comparisons[i]));
    }
    table.row(row);
  }
  return table.text();
}

/// The least and the greatest of the seeds' values.
std::string range_of_seeds(const Candidate& candidate, std::size_t metric,
                           const std::string& unit) {
  const auto values = values_of_seeds(candidate, metric);
  if (!values) return "no value";
  const auto [least, greatest] = std::ranges::minmax(*values);
  if (least == greatest) return number_with(least, unit);
  return text::rounded(least) + " to " + number_with(greatest, unit);
}

std::string requirements_table(const TunePlan& plan, const TuneResult& result) {
  if (plan.requirements.empty()) return "";
  std::vector<std::string> head{"required of every seed", "recommended"};
  if (result.fresh) head.emplace_back("on fresh seeds");
  for (const TuneReference& reference : result.references) head.push_back(html(reference.name));
  HtmlTable table(head, 1);
  for (const RequirementPlan& required : plan.requirements) {
    const std::string unit(plan.runs.metrics[required.metric].definition->unit);
    const auto cell = [&](const Candidate& candidate) {
      const bool met = meets(candidate, required);
      return fmt::format("<span class=\"{}\">{} {}</span>", met ? "good" : "bad", met ? "✓" : "✗",
                         html(range_of_seeds(candidate, required.metric, unit)));
    };
    std::vector<std::string> row{html(required.words), cell(result.best())};
    if (result.fresh) row.push_back(cell(result.candidates[*result.fresh]));
    for (const TuneReference& reference : result.references)
      row.push_back(cell(result.candidates[reference.candidate]));
    table.row(row);
  }
  return table.text();
}

std::string front_table(const TunePlan& plan, const TuneResult& result) {
  if (plan.objectives.size() < 2) return "";
  constexpr std::size_t most = 40;
  std::vector<std::string> head{"evaluation"};
  for (const VariedConstant& constant : plan.varied)
    head.push_back(html(output::column_title(constant.name, constant.unit.text)));
  for (const ObjectivePlan& objective : plan.objectives)
    head.push_back(
        html(output::column_title(plan.label_of(objective), plan.shown_unit_of(objective))));
  HtmlTable table(head, 0);
  for (std::size_t i = 0; i < std::min(most, result.pareto.size()); ++i) {
    const std::size_t member = result.pareto[i];
    const Candidate& candidate = result.candidates[member];
    const bool chosen = member == result.recommended->candidate;
    std::vector<std::string> row{(chosen ? "<b>" : "") + std::to_string(member + 1) +
                                 (chosen ? " recommended</b>" : "")};
    for (const auto& value : candidate.values) row.push_back(text::rounded(value, "", 6));
    for (const ObjectivePlan& objective : plan.objectives)
      row.push_back(html(with_error(objective, candidate, "")));
    table.row(row);
  }
  std::string text = section("The Pareto set") + table.text();
  if (result.pareto.size() > most)
    text += text_block("note soft", fmt::format("The first {} of {}; all are in pareto.csv.", most,
                                                result.pareto.size()));
  return text;
}

/// "0.72 (0.5 to 0.9)"
std::string index_text(double value, const IndexInterval& interval) {
  return fmt::format("{} ({} to {})", text::rounded(value, 3), text::rounded(interval.low, 2),
                     text::rounded(interval.high, 2));
}

std::string indices_rows(const TunePlan& plan, const TuneResult& result) {
  if (result.indices.empty()) return "";
  HtmlTable table({"objective", "constant", "first order (95 % interval)",
                   "total order (95 % interval)", "samples"},
                  2);
  for (std::size_t i = 0; i < result.indices.size(); ++i) {
    const std::string name = html(plan.label_of(plan.objectives[i]));
    if (!result.indices[i]) {
      table.row(
          {name, "nothing to tell: it never changes, or too many runs have no value", "", "", ""});
      continue;
    }
    const SobolIndices& indices = *result.indices[i];
    for (std::size_t c = 0; c < plan.varied.size(); ++c)
      table.row(
          {name, html(plan.varied[c].name), index_text(indices.first[c], indices.first_interval[c]),
           index_text(indices.total[c], indices.total_interval[c]), std::to_string(indices.used)});
  }
  return section("Which constants matter") + table.text() +
         text_block("note soft",
                    "Sobol's indices over the whole box, infeasible candidates with a value "
                    "included; intervals by a bootstrap over the samples. With few samples an "
                    "estimate may lie below 0 or above 1, and a first-order index above the "
                    "total-order one, which it cannot exceed: what lies within the intervals is no "
                    "finding. Four times the `samples` halve them.");
}

std::size_t run_count(const TuneResult& result) {
  std::size_t runs = 0;
  for (const Candidate& candidate : result.candidates) runs += candidate.seeds();
  return runs;
}

/// Whether every candidate's seeds all gave the same.
bool seeds_make_no_difference(const TuneResult& result) {
  return std::ranges::all_of(result.candidates, [](const Candidate& candidate) {
    return std::ranges::all_of(candidate.measured, [&](const auto& measured) {
      return measured == candidate.measured.front();
    });
  });
}

std::string verdict_paragraph(const TunePlan& plan, const TuneResult& result) {
  if (result.interrupted)
    return text_block("verdict bad", "Interrupted: this is what was known by then.");
  if (!result.recommended->feasible)
    return text_block("verdict bad", "✗ No candidate meets the requirements.");
  if (!result.holds(plan))
    return text_block("verdict bad",
                      "✗ The recommended constants miss a requirement on fresh seeds.");
  const std::vector<IdleBlock> idle = idle_blocks(plan, result);
  const std::string words = idle_words(idle);
  return text_block(has_fault(idle) ? "verdict bad" : "verdict good",
                    html(std::string(has_fault(idle) ? "✗" : "✓") +
                         " The recommended constants meet all requirements" +
                         (words.empty() ? "" : "; " + words) + "."));
}

std::string opening_of(const TunePlan& plan, const TuneResult& result,
                       const ReportContext& context) {
  std::string text = text_block("kicker", "Tuning · " + html(plan.runs.file));
  text += "<h1>" + html(plan.title.empty() ? spoken(plan.label) : plan.title) + "</h1>\n";
  if (!plan.question.empty()) text += text_block("question", html(plan.question));
  text += verdict_paragraph(plan, result);
  const SubjectInfo& subject = plan.runs.subjects.front().info;
  text += text_block(
      "facts",
      html(fmt::format(
          "{} candidates, {} runs of {} s; {} with {} candidates a generation, {} generations, {} "
          "seeds; engine {}{}{}.",
          result.candidates.size(), run_count(result), text::rounded(plan.runs.duration),
          plan.method == SearchMethod::nsga2 ? "NSGA-II" : "CMA-ES", plan.population,
          plan.generations, plan.seeds, subject.engine,
          subject.law.empty() ? "" : ", law " + subject.law,
          subject.settings.empty() ? "" : ", settings " + subject.settings)));
  text += "<pre>" + html(context.command) + "</pre>\n";
  std::string links;
  for (const std::string& file : context.files)
    links +=
        (links.empty() ? "" : " · ") + ("<a href=\"" + html(file) + "\">" + html(file) + "</a>");
  return text + text_block("facts", links);
}

std::string comparison_note(const TunePlan& plan, const TuneResult& result) {
  std::string text;
  if (result.fresh)
    text = fmt::format(
        "On {} fresh seeds, which the search never saw; ± is the standard error of the mean. "
        "Better and worse: the mean difference, seed by seed, beyond its 95 % interval (Student's "
        "t), which stands in brackets.",
        fresh_seeds(plan));
  if (seeds_make_no_difference(result))
    text +=
        " Seeds make no difference in this scene: it draws no random number, and neither the "
        "scene nor the terrain has a Param `seed`.";
  return text_block("note soft", html(text));
}

}  // namespace

std::string tune_html(const TunePlan& plan, const TuneResult& result, const ReportContext& context,
                      const std::vector<ReportFigure>& figures) {
  std::string page = page_start(plan.title.empty() ? spoken(plan.label) : plan.title);
  if (!result.recommended) {
    page += text_block("verdict bad", "Interrupted before the first candidate was done.");
    return page + page_end_with_script();
  }
  page += opening_of(plan, result, context);
  page += section("The recommended constants") + constants_table(plan, result);
  page += text_block("note soft", "Chosen: " + html(result.recommended->reason) + ".");
  page += text_block("note soft", "The analytic guess: " + html(result.analytic_words) + ".");
  page += section("How much better") + comparison_table(plan, result) +
          comparison_note(plan, result) + requirements_table(plan, result);
  page += figures_of(figures);
  page += indices_rows(plan, result) + front_table(plan, result);
  page += provenance_table(context.provenance);
  return page + page_end_with_script();
}

std::string tune_terminal_text(const TunePlan& plan, const TuneResult& result) {
  if (!result.recommended) return plan.label + ": no candidate is done\n";
  std::string text = plan.label + "\n";
  for (std::size_t i = 0; i < plan.varied.size(); ++i) {
    text += fmt::format("  {:<22} {:>18}", plan.varied[i].name,
                        constant_text(plan.varied[i], result.best().values[i]));
    for (const TuneReference& reference : result.references)
      text += fmt::format(
          "   {}: {}", reference.key,
          constant_text(plan.varied[i], result.candidates[reference.candidate].values[i]));
    text += "\n";
  }
  const Candidate& tuned = result.fresh ? result.candidates[*result.fresh] : result.best();
  for (std::size_t i = 0; i < plan.objectives.size(); ++i) {
    const ObjectivePlan& objective = plan.objectives[i];
    const std::string unit = plan.shown_unit_of(objective);
    text +=
        fmt::format("  {:<22} {:>18}", plan.name_of(objective), with_error(objective, tuned, unit));
    for (const TuneReference& reference : result.references) {
      const std::size_t other = reference.fresh.value_or(reference.candidate);
      text += fmt::format("   {}: {}", reference.key,
                          with_error(objective, result.candidates[other], unit));
      if (!reference.comparisons.empty())
        text += ", " + std::string(words_of(reference.comparisons[i].verdict));
    }
    text += "\n";
  }
  for (const RequirementPlan& required : plan.requirements)
    text += "  required: " + required.words + "\n";
  if (!result.holds(plan)) text += "  the requirements are not met\n";
  for (const IdleBlock& block : idle_blocks(plan, result)) text += "  " + line_of(block) + "\n";
  return text + "  " + result.recommended->reason + "\n";
}

}  // namespace hookpoint::studies
