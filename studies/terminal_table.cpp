#include "studies/terminal_table.h"

#include <algorithm>
#include <vector>

#include "output/csv.h"
#include "output/number.h"
#include "studies/summary.h"

namespace hookpoint::studies {
namespace {

constexpr std::size_t listed_failures = 10;
constexpr const char* gap = "  ";

enum class Tone { plain, good, bad, faint };

struct Cell {
  std::string text;
  Tone tone = Tone::plain;
  bool right = true;  ///< alignment
};

using Row = std::vector<Cell>;

/// Columns of one metric: a title over its sub-columns.
struct Group {
  std::string title;
  std::vector<Row> rows;  ///< header first
  std::vector<std::size_t> widths;

  std::size_t width() const {
    std::size_t sum = 2 * (widths.size() - 1);
    for (const std::size_t one : widths) sum += one;
    return std::max(sum, title.size());
  }
};

std::string toned(const std::string& text, Tone tone, bool color) {
  if (!color || tone == Tone::plain) return text;
  const char* code = tone == Tone::good ? "\033[32m" : tone == Tone::bad ? "\033[1;31m" : "\033[2m";
  return code + text + "\033[0m";
}

std::string padded(const Cell& cell, std::size_t width, bool color) {
  const std::string space(width - std::min(width, cell.text.size()), ' ');
  const std::string text = toned(cell.text, cell.tone, color);
  return cell.right ? space + text : text + space;
}

void measure(Group& group) {
  group.widths.assign(group.rows.front().size(), 0);
  for (const Row& row : group.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      group.widths[i] = std::max(group.widths[i], row[i].text.size());
}

Cell verdict_cell(const MetricSummary& metric) {
  const int all = metric.passed + metric.failed;
  if (all == 0) return {"-", Tone::faint};
  const std::string word = metric.failed == 0 ? "pass" : "FAIL";
  const Tone tone = metric.failed == 0 ? Tone::good : Tone::bad;
  return {all == 1 ? word : word + " " + std::to_string(metric.passed) + "/" + std::to_string(all),
          tone};
}

Cell number_cell(const std::optional<double>& value) {
  return value ? Cell{output::rounded(*value)} : Cell{"-", Tone::faint};
}

/// Which sub-columns a metric needs over all subjects.
struct Shape {
  bool predicted = false, verdict = false, several = false;
};

Shape shape_of(const StudyResult& study, const StudySummary& summary, std::size_t metric) {
  Shape shape;
  for (const RunResult& row : study.rows)
    shape.predicted |= metric < row.metrics.size() && row.metrics[metric].predicted.has_value();
  for (const SubjectSummary& subject : summary.subjects) {
    shape.verdict |= subject.metrics[metric].passed + subject.metrics[metric].failed > 0;
    shape.several |= subject.metrics[metric].values > 1;
  }
  return shape;
}

Row metric_row(const StudyResult& study, const MetricSummary& summary, std::size_t metric,
               Shape shape) {
  const MetricValue* worst =
      summary.worst < 0 ? nullptr
                        : &study.rows[static_cast<std::size_t>(summary.worst)].metrics[metric];
  Row row;
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
  if (shape.verdict) row.push_back(verdict_cell(summary));
  return row;
}

Group metric_group(const StudyResult& study, const StudySummary& summary, std::size_t metric) {
  const Shape shape = shape_of(study, summary, metric);
  Group group;
  group.title = output::column_title(study.metrics[metric].name, study.metrics[metric].unit);
  Row header;
  if (shape.predicted || !shape.several) {
    header.push_back({shape.several ? "worst" : "measured", Tone::faint});
  } else {
    header.push_back({"median", Tone::faint});
    header.push_back({"largest", Tone::faint});
  }
  if (shape.predicted) header.push_back({"predicted", Tone::faint});
  if (shape.verdict) header.push_back({"truth", Tone::faint});
  group.rows.push_back(header);
  for (const SubjectSummary& subject : summary.subjects)
    group.rows.push_back(metric_row(study, subject.metrics[metric], metric, shape));
  measure(group);
  return group;
}

Cell finished_cell(const SubjectSummary& subject) {
  if (subject.skipped == subject.rows()) return {"skipped", Tone::faint};
  const std::string text = std::to_string(subject.finished) + "/" + std::to_string(subject.rows());
  return {text, subject.stopped > 0 ? Tone::bad : Tone::plain};
}

Group subject_group(const StudyResult& study, const StudySummary& summary) {
  Group group;
  group.rows.push_back({{"subject", Tone::faint, false}, {"runs", Tone::faint}});
  for (std::size_t i = 0; i < study.subjects.size(); ++i)
    group.rows.push_back(
        {{study.subjects[i].name, Tone::plain, false}, finished_cell(summary.subjects[i])});
  measure(group);
  return group;
}

std::string without_trailing_spaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string print_table(const std::vector<const Group*>& groups, bool color) {
  std::string titles, text;
  for (const Group* group : groups)
    titles += padded({group->title, Tone::plain, false}, group->width(), color) + gap + " ";
  text += without_trailing_spaces(titles);
  for (std::size_t row = 0; row < groups.front()->rows.size(); ++row) {
    std::string line;
    for (const Group* group : groups) {
      std::string part;
      std::size_t used = 0;
      for (std::size_t i = 0; i < group->widths.size(); ++i) {
        part += (i > 0 ? gap : "") + padded(group->rows[row][i], group->widths[i], color);
        used += group->widths[i] + (i > 0 ? 2 : 0);
      }
      line += part + std::string(group->width() - used, ' ') + gap + " ";
    }
    text += without_trailing_spaces(line);
  }
  return text;
}

std::string tables(const StudyResult& study, const StudySummary& summary, const TableStyle& style) {
  const Group subjects = subject_group(study, summary);
  std::vector<Group> metrics;
  for (std::size_t i = 0; i < study.metrics.size(); ++i)
    metrics.push_back(metric_group(study, summary, i));
  std::string text;
  for (std::size_t next = 0; next < metrics.size();) {
    std::vector<const Group*> side_by_side = {&subjects};
    std::size_t used = subjects.width();
    do {
      used += metrics[next].width() + 3;
      side_by_side.push_back(&metrics[next++]);
    } while (next < metrics.size() && used + metrics[next].width() + 3 <= style.width);
    text += print_table(side_by_side, style.color) + "\n";
  }
  return text;
}

std::string clipped(std::string line, std::size_t width) {
  if (line.size() > width) line = line.substr(0, width - 3) + "...";
  return line + "\n";
}

std::string failure_list(const StudyResult& study, const TableStyle& style) {
  const std::vector<Failure> failures = failures_of(study);
  std::string text;
  for (std::size_t i = 0; i < std::min(failures.size(), listed_failures); ++i) {
    const RunResult& row = study.rows[static_cast<std::size_t>(failures[i].row)];
    const auto metric = static_cast<std::size_t>(failures[i].metric);
    const MetricValue& value = row.metrics[metric];
    std::string line = study.subjects[static_cast<std::size_t>(row.subject)].name;
    const std::string parameters = parameters_text(study, row);
    if (!parameters.empty()) line += " at " + parameters;
    line += ": " + study.metrics[metric].name + " ";
    line += value.measured ? output::rounded(*value.measured) : "not measured";
    if (value.predicted) line += ", predicted " + output::rounded(*value.predicted);
    if (outcome_of(row) != RunOutcome::finished) line += "; " + row.status;
    text += toned("fails", Tone::bad, style.color) + "  " + clipped(line, style.width - 7);
  }
  if (failures.size() > listed_failures)
    text += "       and " + std::to_string(failures.size() - listed_failures) +
            " more, all in report.html\n";
  return text;
}

std::string counts(const StudySummary& summary, const TableStyle& style) {
  const auto& total = summary.total;
  std::string text =
      std::to_string(total.rows()) + " runs: " + std::to_string(total.finished) + " finished";
  if (total.stopped > 0) text += ", " + std::to_string(total.stopped) + " stopped on the way";
  if (total.skipped > 0) text += ", " + std::to_string(total.skipped) + " skipped";
  if (summary.passed + summary.failed == 0) return text + "; no truth to hold\n";
  const std::string verdict = std::to_string(summary.passed) + " of " +
                              std::to_string(summary.passed + summary.failed) + " verdicts hold";
  return text + "; " + toned(verdict, summary.failed == 0 ? Tone::good : Tone::bad, style.color) +
         "\n";
}

}  // namespace

std::string terminal_table(const StudyResult& study, const TableStyle& style) {
  const StudySummary summary = summarise(study);
  return tables(study, summary, style) + failure_list(study, style) + counts(summary, style);
}

}  // namespace hookpoint::studies
