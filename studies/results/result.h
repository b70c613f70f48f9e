// What a study produced: the table that results.csv, the terminal and the report all print. Plain
// values.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulation/analysis/matched_ground.h"
#include "studies/measure/regime.h"

namespace hookpoint::studies {

/// One thing that the study varied.
struct SweepColumn {
  std::string name;            ///< the scene's Param: "slope"
  std::string unit;            ///< as in results.csv, SI or the unit the study wrote ("deg")
  std::vector<double> values;  ///< in `unit`, in order; of words 0, 1, 2 ...
  std::vector<std::string> words = {};  ///< the words or strings that were varied; empty: numbers
};

/// Sweeps and the values that are meant ("mu" = 0.8).
using SweepValues = std::vector<std::pair<std::string, std::vector<double>>>;

/// A Reference block: a line at a value, where a panel has a run with these values.
struct ReferenceLine {
  std::string label;
  double value = 0.;  ///< in the unit of y
  SweepValues where;
};

struct SubjectInfo {
  std::string name;        ///< "dts_hookpoint"
  std::string engine;      ///< "dts"
  std::string law;         ///< "hookpoint"; "" for a peer, whose contact is its own
  std::string integrator;  ///< "semi_implicit_euler"; "" for a peer
  std::string settings;    ///< "default" ... for a peer; "" for ours
  bool available = true;   ///< false: the engine is not on this machine; its rows are "skipped"
};

struct MetricColumn {
  std::string name;              ///< "creep_speed"
  std::string unit;              ///< "m/s"
  bool timing = false;           ///< goes to timing.csv, not to results.csv
  Regime regime = Regime::none;  ///< the only one in which it says something; none: any
  /// Of a metric between subjects, why some of these have no runs here; "" where all have.
  std::string left_out = {};
  bool may_be_predicted = false;  ///< there are runs in which it has a closed form
};

struct MetricValue {
  std::optional<double> measured;         ///< empty: does not apply, or the run failed before
  std::optional<double> predicted;        ///< the closed form, where there is one
  std::optional<bool> ok;                 ///< verdict of the Truth that covers it, if any
  std::optional<double> half_width = {};  ///< of a mean over seeds: of its 95 % interval
  std::string no_form = {};               ///< why there is no closed form, where that is known
};

/// A recorded curve of one run: displacement over time.
struct Trace {
  std::vector<double> time;  ///< [s]
  std::vector<double> value;
};

/// A curve that is read on request: those of 100,000 runs do not fit into memory.
class RecordedTrace {
 public:
  /// Nothing was recorded.
  RecordedTrace() = default;
  RecordedTrace(Trace trace) : read_([trace = std::move(trace)] { return trace; }) {}
  explicit RecordedTrace(std::function<Trace()> read) : read_(std::move(read)) {}
  Trace read() const { return read_ ? read_() : Trace{}; }

 private:
  std::function<Trace()> read_;
};

struct RunResult {
  std::vector<double> parameters;  ///< one a sweep, in the sweep's unit
  int subject = 0;                 ///< index into StudyResult::subjects
  int composition = -1;            ///< index into StudyResult::compositions; -1: the subject's own
  Regime regime = Regime::none;
  std::vector<MetricValue> metrics;  ///< one a metric
  std::string status = "ok";  ///< "ok", or what stopped the run, with its time: never a missing row
  std::vector<RecordedTrace> traces;  ///< one a PlotSpec, empty for those not over time
};

/// How far the trajectories of subjects at equal swept values are from each other.
struct PeerDistances {
  std::vector<double> parameters;  ///< one a sweep, in the sweep's unit
  /// Greatest distance of the bodies' origins [m], subjects x subjects, row by row; nothing for a
  /// run that is not there or did not finish.
  std::vector<std::optional<double>> distances;
};

/// A Plot block.
struct PlotSpec {
  std::string name;  ///< file name of its SVG
  std::string title;
  std::string x, y;  ///< a sweep or "time"; a metric or a trail
  std::string x_unit, y_unit;
  std::string x_label, y_label;    ///< of the axes; "" for the names
  std::string series = "subject";  ///< what makes a curve
  /// Of a map, where x and y are sweeps: the metric that colours it, and one whose closed form
  /// divides it; "" for none.
  std::string color, color_unit, outline;
  /// Sweeps whose values make a panel each; of two the first runs down, the second across.
  std::vector<std::string> panels;
  bool own_axes = false;  ///< each panel has its own y axis
  std::vector<ReferenceLine> references;
  bool log_x = false, log_y = false;
  double floor = 1e-16;        ///< what counts as zero on a logarithmic y axis, in its unit
  bool show_predicted = true;  ///< dashed line of the closed form beside the points
  std::vector<int> subjects;   ///< that are drawn, indices; empty: all
  SweepValues where;           ///< other rows are left out
  bool may_be_empty = false;   ///< it may show nothing
};

/// A Table block: a metric over two of what the study varied.
struct TableSpec {
  std::string name;  ///< file name of its CSV
  std::string title;
  std::string rows, columns;  ///< a sweep or "subject"
  std::string value;          ///< a metric
  std::vector<int> subjects;  ///< that enter, indices; empty: all
  SweepValues where;          ///< other rows are left out
  bool may_be_empty = false;  ///< it may show nothing
};

/// What a number in a Claim is of the runs that it speaks of; of the last two the name of a
/// subject.
enum class ClaimTake {
  nothing,
  mean,
  least,
  largest,
  predicted,
  subject_of_least,
  subject_of_largest
};

struct ClaimValue {
  ClaimTake take = ClaimTake::mean;
  std::size_t metric = 0;  ///< index
  int subject = -1;        ///< index; -1: all
  SweepValues where = {};  ///< other rows are left out
};

/// Plain text, or a number, which may be a ratio.
struct ClaimPart {
  std::string text;
  std::optional<ClaimValue> value = {}, divisor = {};
};

/// A Claim block: the sentence that answers the study's question.
struct ClaimSpec {
  std::string name;
  std::vector<ClaimPart> parts;
  std::vector<int> truths;    ///< that it stands and falls with, indices
  SweepValues where;          ///< other rows are left out
  bool may_be_empty = false;  ///< it may lack a number
};

/// Whether a block of a study judges or shows nothing.
enum class Idle {
  no,        ///< it judges or shows some run
  fault,     ///< it is about no run, or the runs that it is about lack what it needs
  allowed,   ///< the same, which the file allows
  left_out,  ///< its runs were left out here: by --quick, by --only, or for want of an engine
};

struct Idleness {
  Idle idle = Idle::no;
  std::string why = {};  ///< in one line
};

/// A Truth and how many of the values that it covers agree.
struct TruthResult {
  std::string name;
  std::string words;              ///< "creep_speed equals predicted within 1 %"
  int metric = 0;                 ///< index into StudyResult::metrics
  int passed = 0, failed = 0;     ///< rows
  int first_failure = -1;         ///< index into StudyResult::rows
  Idleness idleness = {};         ///< where it judges no run
  int unjudged = 0;               ///< rows that ran, which it is about and cannot judge
  std::string unjudged_why = {};  ///< of the first of these
};

/// What `match` chose for one run.
struct MatchedRun {
  std::vector<double> parameters;  ///< one a sweep, in the sweep's unit
  int subject = 0;                 ///< index into StudyResult::subjects
  std::vector<simulation::MatchedMaterial> materials;
};

/// Names of a study's own tables, which no figure may have.
inline constexpr std::array<std::string_view, 4> table_names{"results", "timing", "peer_distance",
                                                             "matched"};

struct StudyResult {
  std::string name;
  std::string title;     ///< heading of the report; "" for the name
  std::string question;  ///< one or two sentences, first thing in the report
  std::string file;      ///< the study's file as the user named it
  std::vector<SweepColumn> sweeps;
  std::vector<SubjectInfo> subjects;
  std::vector<SubjectInfo> compositions;  ///< engine, law, integrator, settings that a row may have
  std::vector<MetricColumn> metrics;
  std::vector<RunResult> rows;  ///< sweep values outermost first, subjects innermost
  std::vector<PlotSpec> plots;
  std::vector<TableSpec> tables;
  std::vector<ClaimSpec> claims;
  std::vector<TruthResult> truths;
  std::vector<PeerDistances> peer_distances;  ///< where `peer_distance` is measured
  std::vector<MatchedRun> matched;            ///< where the study has `match`, of our engine
  std::vector<std::string> warnings;          ///< the plan's
  bool quick = false;
  std::vector<int> unselected = {};            ///< subjects that --only leaves out, indices
  std::optional<std::size_t> seed_sweep = {};  ///< of `seeds`: index into `sweeps`
  const StudyResult* runs = nullptr;  ///< of rows that are means over seeds: the runs themselves
};

}  // namespace hookpoint::studies
