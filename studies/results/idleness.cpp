#include "studies/results/idleness.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "studies/results/claims.h"
#include "studies/results/selection.h"
#include "studies/results/summary.h"

namespace hookpoint::studies {
namespace {

using Rows = std::vector<const RunResult*>;

Rows rows_of(const StudyResult& study, const RunSelection& selection) {
  Rows rows;
  for (const RunResult& row : study.rows) {
    const bool named =
        selection.subjects.empty() || std::ranges::count(selection.subjects, row.subject) > 0;
    const bool admitted = std::ranges::all_of(
        selection.where, [&](const SweepValues* where) { return admits(study, *where, row); });
    if (named && admitted) rows.push_back(&row);
  }
  return rows;
}

/// "slope = 4 deg or 12 deg".
std::string words_of(const StudyResult& study,
                     const std::pair<std::string, std::vector<double>>& fixed) {
  std::string text = fixed.first + " = ";
  const auto sweep = sweep_index(study, fixed.first);
  for (std::size_t i = 0; i < fixed.second.size() && sweep; ++i) {
    const SweepColumn& column = study.sweeps[*sweep];
    text += (i > 0 ? " or " : "") + label_of(column, fixed.second[i]);
    if (!column.unit.empty()) text += " " + column.unit;
  }
  return text;
}

std::string names_of(const StudyResult& study, const std::vector<int>& subjects) {
  std::string names;
  for (const int subject : subjects)
    names += (names.empty() ? "" : ", ") + study.subjects[static_cast<std::size_t>(subject)].name;
  return names;
}

/// Rows whose plot over time has a curve, or a metric the value.
Idleness why_none(const StudyResult& study, const RunSelection& selection, const auto& has,
                  const auto& why) {
  const Rows rows = rows_of(study, selection);
  if (rows.empty()) return why_no_run(study, selection);
  if (std::ranges::any_of(rows, [&](const RunResult* row) { return has(*row); })) return {};
  const auto ran = std::ranges::find_if(
      rows, [](const RunResult* row) { return outcome_of(*row) != RunOutcome::skipped; });
  if (ran == rows.end()) return {Idle::left_out, rows.front()->status};
  if (outcome_of((*ran)->status) != RunOutcome::finished) return {Idle::fault, (*ran)->status};
  return {Idle::fault, why(**ran)};
}

Idleness idleness_of_plot(const StudyResult& study, std::size_t index) {
  const PlotSpec& plot = study.plots[index];
  const RunSelection selection{plot.subjects, {&plot.where}};
  if (plot.x == "time")
    return why_none(
        study, selection,
        [&](const RunResult& row) {
          const RunOutcome outcome = outcome_of(row.status);
          return outcome == RunOutcome::finished || outcome == RunOutcome::stopped;
        },
        [](const RunResult&) { return std::string("no run has a curve"); });
  if (plot.color.empty() && plot.y.empty()) return {};
  for (const std::string& name : {plot.color.empty() ? plot.y : plot.color, plot.x}) {
    const auto metric = metric_index(study, name);
    if (!metric) continue;  // a sweep
    const Idleness found = why_no_value(study, selection, {*metric, false});
    if (found.idle != Idle::no) return found;
  }
  if (plot.outline.empty()) return {};
  return why_no_value(study, selection, {*metric_index(study, plot.outline), true});
}

Idleness idleness_of_table(const StudyResult& study, const TableSpec& table) {
  return why_no_value(study, {table.subjects, {&table.where}},
                      {*metric_index(study, table.value), false});
}

void add(std::vector<IdleBlock>& blocks, const char* kind, const std::string& name,
         bool may_be_empty, Idleness idleness) {
  if (idleness.idle == Idle::no) return;
  blocks.push_back({kind, name, allowed_by(may_be_empty, std::move(idleness))});
}

/// Whether blocks of the kind show something; others judge.
bool shows(std::string_view kind) { return kind == "Claim" || kind == "Table" || kind == "Plot"; }

/// Kinds in the order in which they first appear.
std::vector<std::string_view> kinds_of(const std::vector<IdleBlock>& blocks) {
  std::vector<std::string_view> kinds;
  for (const IdleBlock& block : blocks)
    if (std::ranges::count(kinds, std::string_view(block.kind)) == 0) kinds.push_back(block.kind);
  return kinds;
}

}  // namespace

Idleness why_no_run(const StudyResult& study, const RunSelection& selection) {
  std::string words;
  for (const SweepValues* where : selection.where)
    for (const auto& fixed : *where) {
      // The plan has no Only without a value of its Sweep.
      if (fixed.second.empty())
        return {Idle::left_out,
                "--quick leaves out the values of " + fixed.first + " that it is about"};
      words += (words.empty() ? "" : " and ") + words_of(study, fixed);
    }
  std::vector<int> subjects = selection.subjects;
  if (subjects.empty())
    for (std::size_t i = 0; i < study.subjects.size(); ++i) subjects.push_back(static_cast<int>(i));
  const bool unselected = std::ranges::any_of(
      subjects, [&](int subject) { return std::ranges::count(study.unselected, subject) > 0; });
  if (unselected) return {Idle::left_out, "--only leaves out " + names_of(study, study.unselected)};
  if (study.quick) return {Idle::left_out, "--quick leaves out the runs that it is about"};
  std::string why = "no run";
  if (!selection.subjects.empty()) why += " of " + names_of(study, selection.subjects);
  return {Idle::fault, why + (words.empty() ? " is planned" : " has " + words)};
}

Idleness unless_left_out(const StudyResult& study, const RunSelection& selection,
                         Idleness idleness) {
  const bool others = std::ranges::any_of(study.unselected, [&](int subject) {
    return selection.subjects.empty() || std::ranges::count(selection.subjects, subject) > 0;
  });
  if (!others || idleness.idle != Idle::fault) return idleness;
  return {Idle::left_out,
          "--only leaves out " + names_of(study, study.unselected) + "; " + idleness.why};
}

Idleness why_no_value(const StudyResult& study, const RunSelection& selection,
                      const NeededValue& needed) {
  const std::string& name = study.metrics[needed.metric].name;
  Idleness idleness = why_none(
      study, selection,
      [&](const RunResult& row) {
        const MetricValue& value = row.metrics[needed.metric];
        return needed.predicted ? value.predicted.has_value() : value.measured.has_value();
      },
      [&](const RunResult& row) {
        if (!needed.predicted) return "no run has a value of " + name;
        const std::string& why = row.metrics[needed.metric].no_form;
        return why.empty() ? "no closed form of " + name : "no closed form: " + why;
      });
  const std::string& left_out = study.metrics[needed.metric].left_out;
  if (idleness.idle == Idle::fault && !left_out.empty()) return {Idle::left_out, left_out};
  return unless_left_out(study, selection, std::move(idleness));
}

Idleness allowed_by(bool may_be_empty, Idleness idleness) {
  if (may_be_empty && idleness.idle == Idle::fault) idleness.idle = Idle::allowed;
  return idleness;
}

std::vector<IdleBlock> idle_blocks(const StudyResult& study) {
  if (study.runs != nullptr) return idle_blocks(*study.runs);
  std::vector<IdleBlock> blocks;
  for (const TruthResult& truth : study.truths)
    add(blocks, "Truth", truth.name, false, truth.idleness);
  for (const ClaimSpec& claim : study.claims)
    add(blocks, "Claim", claim.name, claim.may_be_empty, idleness_of(study, claim));
  for (const TableSpec& table : study.tables)
    add(blocks, "Table", table.name, table.may_be_empty, idleness_of_table(study, table));
  for (std::size_t i = 0; i < study.plots.size(); ++i)
    add(blocks, "Plot", study.plots[i].name, study.plots[i].may_be_empty,
        idleness_of_plot(study, i));
  return blocks;
}

bool has_fault(const std::vector<IdleBlock>& blocks) {
  return std::ranges::any_of(
      blocks, [](const IdleBlock& block) { return block.idleness.idle == Idle::fault; });
}

std::string idle_words(const std::vector<IdleBlock>& blocks) {
  std::string text;
  for (const Idle idle : {Idle::fault, Idle::allowed, Idle::left_out})
    for (const std::string_view kind : kinds_of(blocks)) {
      const auto count = std::ranges::count_if(blocks, [&](const IdleBlock& block) {
        return block.idleness.idle == idle && block.kind == kind;
      });
      if (count == 0) continue;
      const bool one = count == 1;
      const std::string nothing = shows(kind) ? (one ? " shows nothing" : " show nothing")
                                              : (one ? " judges nothing" : " judge nothing");
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + std::string(kind) +
              (one ? "" : "s") +
              (idle == Idle::left_out  ? std::string(one ? " is left out" : " are left out")
               : idle == Idle::allowed ? nothing + (one ? ", as it may" : ", as they may")
                                       : nothing);
    }
  return text;
}

std::string verdict_words(int passed, int failed, const std::vector<IdleBlock>& blocks) {
  const int all = passed + failed;
  std::string text = all == 0
                         ? std::string("no verdict")
                         : std::to_string(passed) + " of " + std::to_string(all) + " verdicts hold";
  const std::string idle = idle_words(blocks);
  if (all == 0 && idle.empty()) return "no truth to hold";
  return text + (idle.empty() ? "" : ", " + idle);
}

std::string line_of(const IdleBlock& block) {
  return std::string(block.kind) + " " + block.name + ": " + block.idleness.why;
}

std::vector<std::string> fault_lines(const std::vector<IdleBlock>& blocks) {
  std::vector<std::string> lines;
  for (const IdleBlock& block : blocks)
    if (block.idleness.idle == Idle::fault) lines.push_back(line_of(block));
  return lines;
}

std::string not_judged_words(const TruthResult& truth) {
  if (truth.idleness.idle == Idle::left_out) return "; left out: " + truth.idleness.why;
  if (truth.idleness.idle != Idle::no) return "; judges nothing: " + truth.idleness.why;
  if (truth.unjudged == 0) return "";
  return "; " + std::to_string(truth.unjudged) + (truth.unjudged == 1 ? " run" : " runs") +
         " not judged: " + truth.unjudged_why;
}

std::vector<MissingForm> missing_forms(const StudyResult& study) {
  std::vector<MissingForm> missing;
  for (std::size_t metric = 0; metric < study.metrics.size(); ++metric)
    for (const RunResult& row : study.rows) {
      const MetricValue& value = row.metrics[metric];
      const bool missing_here = row.status == "ok" && study.metrics[metric].may_be_predicted &&
                                !value.predicted && !value.no_form.empty();
      if (!missing_here) continue;
      auto known = std::ranges::find_if(missing, [&](const MissingForm& one) {
        return one.metric == metric && one.why == value.no_form;
      });
      if (known == missing.end())
        known = missing.insert(missing.end(), {metric, value.no_form, {}, 0});
      if (std::ranges::count(known->subjects, row.subject) == 0)
        known->subjects.push_back(row.subject);
      ++known->runs;
    }
  return missing;
}

std::string line_of(const StudyResult& study, const MissingForm& missing) {
  return study.metrics[missing.metric].name + " of " + names_of(study, missing.subjects) + " (" +
         std::to_string(missing.runs) + (missing.runs == 1 ? " run" : " runs") +
         "): " + missing.why;
}

}  // namespace hookpoint::studies
