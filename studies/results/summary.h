// A study's rows condensed to one line a subject: what the terminal and the top of the report show.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/results/result.h"

namespace hookpoint::studies {

/// What became of a run. Expected: it stopped on the way, as the Truths about it say that it does.
enum class RunOutcome { finished, expected, stopped, skipped, refused };

/// A row of status "ok" finished; one whose status begins with "skipped" (the engine is not on this
/// machine) or "refused" (a peer cannot run the scene, and says why) never ran; any other stopped
/// on the way, as expected where it has Truths and all of them hold. Of a status alone, nothing is
/// expected.
RunOutcome outcome_of(const RunResult& row);
RunOutcome outcome_of(const std::string& status);

/// One subject, one metric, over all rows of the sweep.
struct MetricSummary {
  int values = 0;      ///< rows with a finite measurement; the three numbers below are theirs
  double median = 0.;  ///< the lower of the middle two for an even count, so that it is a value
                       ///< that was measured
  double least = 0., largest = 0.;
  /// Row (index into StudyResult::rows) to look at first: one whose Truth fails before one whose
  /// Truth holds, then the one farthest from its closed form; without a closed form the largest
  /// magnitude. -1 when nothing was measured.
  int worst = -1;
  int passed = 0, failed = 0;  ///< verdicts
};

struct SubjectSummary {
  int finished = 0, expected = 0, stopped = 0, skipped = 0, refused = 0;  ///< rows
  std::vector<MetricSummary> metrics;  ///< one a StudyResult::metrics
  int rows() const { return finished + expected + stopped + skipped + refused; }
};

struct StudySummary {
  std::vector<SubjectSummary> subjects;  ///< one a StudyResult::subjects
  SubjectSummary total;  ///< over all subjects; its metrics hold counts of verdicts only
  int passed = 0, failed = 0;
};

/// Over the rows of `regime`, or over all. Cost O(rows log rows) a metric.
StudySummary summarise(const StudyResult& study, std::optional<Regime> regime = {});

/// One table: the runs of a regime.
struct RegimeTable {
  Regime regime = Regime::none;
  std::string heading;                ///< "" when it is the study's only one
  StudySummary summary;               ///< of its rows
  std::vector<std::size_t> subjects;  ///< those with a row in it
  std::vector<std::size_t> metrics;   ///< those that say something in it, or that a Truth judges
};

/// One a regime that occurs, where friction holds first.
std::vector<RegimeTable> regime_tables(const StudyResult& study);

/// Rows that stopped on the way: indices into StudyResult::rows.
std::vector<std::size_t> stopped_rows(const StudyResult& study);

/// A verdict of a finished run that does not hold: row and metric. A run that stopped is among
/// `stopped_rows`.
struct Failure {
  int row = 0, metric = 0;
};
std::vector<Failure> failures_of(const StudyResult& study);

/// "mu = 0.8, slope = 20 deg": the row's sweep values.
std::string parameters_text(const StudyResult& study, const RunResult& row);

/// "30 deg, 0.8": the same without names.
std::string values_text(const StudyResult& study, const RunResult& row);

/// "creep_speed" as a reader writes it: "creep speed".
std::string spoken(std::string name);

/// "dts, hookpoint, semi_implicit_euler" or "ode, recommended settings": what the subject is made
/// of.
std::string composition(const SubjectInfo& subject);

}  // namespace hookpoint::studies
