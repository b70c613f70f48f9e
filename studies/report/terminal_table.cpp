#include "studies/report/terminal_table.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "language/names.h"
#include "output/files/csv.h"
#include "studies/report/terminal_blocks.h"
#include "studies/report/terminal_pivot.h"
#include "studies/results/claims.h"
#include "studies/results/idleness.h"
#include "studies/results/matched_grounds.h"
#include "studies/results/seed_means.h"
#include "studies/results/summary.h"
#include "text/display.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

constexpr std::size_t listed_runs = 10;

Cell judged_cell(const MetricSummary& metric) {
  const int all = metric.passed + metric.failed;
  if (all == 0) return {"-", Tone::faint};
  const std::string word = metric.failed == 0 ? "pass" : "FAIL";
  const Tone tone = metric.failed == 0 ? Tone::good : Tone::bad;
  return {all == 1 ? word : word + " " + std::to_string(metric.passed) + "/" + std::to_string(all),
          tone};
}

Cell number_cell(const std::optional<double>& value) {
  return value ? Cell{text::rounded(*value)} : Cell{"-", Tone::faint};
}

/// Which sub-columns a metric needs over all subjects.
struct Shape {
  bool predicted = false, verdict = false, several = false;
};

Shape shape_of(const StudyResult& study, const RegimeTable& table, std::size_t metric) {
  Shape shape;
  for (const RunResult& row : study.rows)
    shape.predicted |= row.regime == table.regime && metric < row.metrics.size() &&
                       row.metrics[metric].predicted.has_value();
  for (const SubjectSummary& subject : table.summary.subjects) {
    shape.verdict |= subject.metrics[metric].passed + subject.metrics[metric].failed > 0;
    shape.several |= subject.metrics[metric].values > 1;
  }
  return shape;
}

CellRow metric_row(const StudyResult& study, const MetricSummary& summary, std::size_t metric,
                   Shape shape) {
  const MetricValue* worst =
      summary.worst < 0 ? nullptr
                        : &study.rows[static_cast<std::size_t>(summary.worst)].metrics[metric];
  CellRow row;
  const auto if_any = [&](double value) {
    return summary.values > 0 ? std::optional(value) : std::nullopt;
  };
  if (shape.predicted || !shape.several) {
    row.push_back(number_cell(worst ? worst->measured : std::nullopt));
  } else {
    row.push_back(number_cell(if_any(summary.median)));
    row.push_back(number_cell(if_any(summary.largest)));
  }
  if (shape.predicted) row.push_back(number_cell(worst ? worst->predicted : std::nullopt));
  if (shape.verdict) row.push_back(judged_cell(summary));
  return row;
}

ColumnGroup metric_group(const StudyResult& study, const RegimeTable& table, std::size_t metric) {
  const Shape shape = shape_of(study, table, metric);
  ColumnGroup group;
  group.title = output::column_title(study.metrics[metric].name, study.metrics[metric].unit);
  CellRow header;
  if (shape.predicted || !shape.several) {
    header.push_back({shape.several ? "worst" : "measured", Tone::faint});
  } else {
    header.push_back({"median", Tone::faint});
    header.push_back({"largest", Tone::faint});
  }
  if (shape.predicted) header.push_back({"predicted", Tone::faint});
  if (shape.verdict) header.push_back({"truth", Tone::faint});
  group.rows.push_back(header);
  for (const std::size_t subject : table.subjects)
    group.rows.push_back(
        metric_row(study, table.summary.subjects[subject].metrics[metric], metric, shape));
  group.measure();
  return group;
}

Cell finished_runs(const SubjectSummary& subject) {
  if (subject.skipped == subject.rows()) return {"skipped", Tone::faint};
  if (subject.refused == subject.rows()) return {"refused", Tone::faint};
  const std::string text = std::to_string(subject.finished) + "/" + std::to_string(subject.rows());
  return {text, subject.stopped > 0 ? Tone::bad : Tone::plain};
}

ColumnGroup subject_group(const StudyResult& study, const RegimeTable& table) {
  ColumnGroup group;
  group.rows.push_back({{"subject", Tone::faint, false}, {"runs", Tone::faint}});
  for (const std::size_t i : table.subjects)
    group.rows.push_back(
        {{study.subjects[i].name, Tone::plain, false}, finished_runs(table.summary.subjects[i])});
  group.measure();
  return group;
}

/// Where each subject's worst value of the metric was measured.
ColumnGroup place_group(const StudyResult& study, const RegimeTable& table, std::size_t metric) {
  std::string names;
  for (const SweepColumn& sweep : study.sweeps) names += (names.empty() ? "" : ", ") + sweep.name;
  ColumnGroup group;
  group.rows.push_back({{"at " + names, Tone::faint, false}});
  for (const std::size_t subject : table.subjects) {
    const int worst = table.summary.subjects[subject].metrics[metric].worst;
    const std::string text =
        worst < 0 ? "" : values_text(study, study.rows[static_cast<std::size_t>(worst)]);
    group.rows.push_back({{text, Tone::faint, false}});
  }
  group.measure();
  return group;
}

/// The first metric by itself, with the place of its worst value; then the others, as many side by
/// side as fit.
std::string print_table(const StudyResult& study, const RegimeTable& table,
                        const TableStyle& style) {
  if (table.metrics.empty()) return "";  // none says anything in this regime
  const ColumnGroup subjects = subject_group(study, table);
  std::vector<ColumnGroup> metrics;
  for (const std::size_t metric : table.metrics)
    metrics.push_back(metric_group(study, table, metric));
  const ColumnGroup places = place_group(study, table, table.metrics.front());
  std::string text = table.heading.empty() ? "" : table.heading + "\n";
  for (std::size_t next = 0; next < metrics.size();) {
    std::vector<const ColumnGroup*> row = {&subjects};
    const bool first = next == 0;
    do row.push_back(&metrics[next++]);
    while (!first && next < metrics.size() &&
           printed_width(row) + printed_width({&subjects, &metrics[next]}) - subjects.width() <=
               style.width);
    if (first) row.push_back(&places);
    if (printed_width(row) > style.width && row.back() == &places) row.pop_back();
    text += print_groups(row, style.color) + "\n";
  }
  return text;
}

std::string run_name(const StudyResult& study, const RunResult& row) {
  const std::string parameters = parameters_text(study, row);
  return study.subjects[static_cast<std::size_t>(row.subject)].name +
         (parameters.empty() ? "" : " at " + parameters);
}

/// What the status of a run that was refused begins with; the reason follows.
constexpr std::string_view refused_word = "refused: ";

/// A word in front of each line, which goes on under itself.
std::string listed(const char* word, const std::vector<std::string>& lines,
                   const TableStyle& style) {
  constexpr std::size_t indent = 9;
  std::string text;
  const std::string start = word + std::string(indent - std::string(word).size(), ' ');
  for (std::size_t i = 0; i < std::min(lines.size(), listed_runs); ++i)
    text += toned(start, Tone::bad, style.color) + wrapped(lines[i], style.width, indent);
  if (lines.size() > listed_runs)
    text += std::string(indent, ' ') + "and " + std::to_string(lines.size() - listed_runs) +
            " more, all in report.html\n";
  return text.empty() ? "" : text + "\n";
}

std::string stopped_list(const StudyResult& study, const TableStyle& style) {
  std::vector<std::string> lines;
  for (const std::size_t i : stopped_rows(study))
    lines.push_back(run_name(study, study.rows[i]) + ": " + study.rows[i].status);
  return listed("stopped", lines, style);
}

/// Each reason why engines refused runs, with the first of these and how many others there are.
std::string refused_list(const StudyResult& study, const TableStyle& style) {
  std::vector<std::pair<const RunResult*, std::size_t>> reasons;
  for (const RunResult& row : study.rows) {
    if (outcome_of(row) != RunOutcome::refused) continue;
    const auto known = std::ranges::find_if(reasons, [&](const auto& reason) {
      return reason.first->status == row.status && reason.first->subject == row.subject;
    });
    if (known == reasons.end())
      reasons.emplace_back(&row, 0);
    else
      ++known->second;
  }
  std::vector<std::string> lines;
  for (const auto& [row, others] : reasons) {
    const std::string why = row->status.substr(std::min(row->status.size(), refused_word.size()));
    lines.push_back(run_name(study, *row) +
                    (others > 0 ? " and " + std::to_string(others) + " more" : "") + ": " + why);
  }
  return listed("refused", lines, style);
}

std::string failure_list(const StudyResult& study, const TableStyle& style) {
  std::vector<std::string> lines;
  for (const Failure& failure : failures_of(study)) {
    const RunResult& row = study.rows[static_cast<std::size_t>(failure.row)];
    const auto metric = static_cast<std::size_t>(failure.metric);
    const MetricValue& value = row.metrics[metric];
    std::string line = run_name(study, row) + ": " + study.metrics[metric].name + " ";
    line += text::rounded(value.measured, "not measured");
    if (value.predicted) line += ", predicted " + text::rounded(*value.predicted);
    lines.push_back(std::move(line));
  }
  return listed("fails", lines, style);
}

/// Each sentence with what became of it.
std::string claim_list(const StudyResult& study, const TableStyle& style) {
  constexpr std::size_t indent = 2;
  std::string text;
  for (const ClaimSpec& claim : study.claims) {
    const SaidClaim said = said_of(study, claim);
    const bool faint = said.verdict == ClaimVerdict::unjudged || said.excused;
    const Tone tone = said.verdict == ClaimVerdict::holds ? Tone::good
                      : faint                             ? Tone::faint
                                                          : Tone::bad;
    text += wrapped(text::printable(said.text), style.width) + std::string(indent, ' ') +
            toned("(" + text::printable(said.why) + ")", tone, style.color) + "\n";
  }
  return text.empty() ? "" : text + "\n";
}

/// Each Truth with the number of values that agree.
std::string truth_list(const StudyResult& study, const TableStyle& style) {
  constexpr std::size_t indent = 15;
  std::string text;
  for (const TruthResult& truth : study.truths) {
    const int all = truth.passed + truth.failed;
    const bool fault = truth.failed > 0 || truth.idleness.idle == Idle::fault;
    const char* word = all == 0 ? (fault ? "NONE" : "-   ") : fault ? "FAIL" : "pass";
    const Tone tone = fault ? Tone::bad : all == 0 ? Tone::faint : Tone::good;
    std::string count = " " + std::to_string(truth.passed) + "/" + std::to_string(all);
    count.resize(std::max(count.size() + 1, indent - 4), ' ');
    text += toned(word, tone, style.color) + count +
            wrapped(truth.name + ": " + truth.words + not_judged_words(truth), style.width, indent);
  }
  return text.empty() ? "" : text + "\n";
}

/// What shows nothing, each with its reason; Truths have theirs beside them.
std::string idle_list(const std::vector<IdleBlock>& blocks, const TableStyle& style) {
  std::vector<std::string> lines;
  for (const IdleBlock& block : blocks)
    if (block.kind != std::string_view("Truth")) lines.push_back(line_of(block));
  return listed("empty", lines, style);
}

/// Each reason why a metric that may have a closed form has none.
std::string no_form_list(const StudyResult& study, const TableStyle& style) {
  std::vector<std::string> lines;
  for (const MissingForm& missing : missing_forms(study)) lines.push_back(line_of(study, missing));
  return listed("no form", lines, style);
}

/// What `match` chose, a subject and material a line.
std::string matched_list(const StudyResult& study, const TableStyle& style) {
  constexpr std::size_t indent = 4;
  std::string text;
  for (const MatchedLine& line : matched_lines(study))
    text +=
        std::string(2, ' ') + wrapped(line.subject + " on " + line.material + ", " + line.under +
                                          ": " + constants_text(line) + " (" + line.matched + ")",
                                      style.width, indent);
  return text.empty() ? "" : "Ground matched to hookpoint's\n" + text + "\n";
}

std::string counts(const StudySummary& summary, const std::vector<IdleBlock>& idle,
                   const TableStyle& style) {
  const auto& total = summary.total;
  std::string text = language::count_of(static_cast<std::size_t>(total.rows()), "run") + ": " +
                     std::to_string(total.finished) + " finished";
  if (total.expected > 0) text += ", " + std::to_string(total.expected) + " broke off as expected";
  if (total.stopped > 0)
    text +=
        ", " + toned(std::to_string(total.stopped) + " stopped on the way", Tone::bad, style.color);
  if (total.skipped > 0) text += ", " + std::to_string(total.skipped) + " skipped";
  if (total.refused > 0) text += ", " + std::to_string(total.refused) + " refused";
  const bool bad = summary.failed > 0 || has_fault(idle);
  const Tone tone = bad ? Tone::bad : summary.passed > 0 ? Tone::good : Tone::plain;
  return text + "; " +
         toned(verdict_words(summary.passed, summary.failed, idle), tone, style.color) + "\n";
}

}  // namespace

std::string terminal_table(const StudyResult& study, const TableStyle& style) {
  if (study.seed_sweep) return terminal_table(over_seeds(study), style);
  std::string text;
  if (!study.question.empty()) text += wrapped(study.question, style.width) + "\n";
  text += claim_list(study, style);
  text += matched_list(study, style);
  for (const TableSpec& table : shown_tables(study))
    text += terminal_pivot(pivot_of(study, table), style) + "\n";
  for (const RegimeTable& table : regime_tables(study)) text += print_table(study, table, style);
  const std::vector<IdleBlock> idle = idle_blocks(study);
  return text + truth_list(study, style) + failure_list(study, style) + idle_list(idle, style) +
         no_form_list(study, style) + stopped_list(study, style) + refused_list(study, style) +
         counts(summarise(study), idle, style) +
         (study.runs == nullptr ? "" : seeds_words(study) + "\n");
}

}  // namespace hookpoint::studies
