// Truths, Claims, Plots and Tables that judge or show nothing, with the reason of each: a study
// that judged nothing is not green.
#pragma once

#include <string>
#include <vector>

#include "studies/results/result.h"

namespace hookpoint::studies {

/// Runs that a block of a study is about.
struct RunSelection {
  std::vector<int> subjects;              ///< indices; empty: all
  std::vector<const SweepValues*> where;  ///< rows that all of these let in
};

/// Why no row of the study is in the selection.
Idleness why_no_run(const StudyResult& study, const RunSelection& selection);

/// The idleness of a block about the selection, which is no fault where --only leaves out others of
/// its subjects.
Idleness unless_left_out(const StudyResult& study, const RunSelection& selection,
                         Idleness idleness);

/// A number that a block needs of the runs that it is about.
struct NeededValue {
  std::size_t metric = 0;  ///< index
  bool predicted = false;  ///< its closed form
};

/// Why no row of the selection has the number.
Idleness why_no_value(const StudyResult& study, const RunSelection& selection,
                      const NeededValue& needed);

/// The same, or nothing wrong, where the file allows that a block is empty.
Idleness allowed_by(bool may_be_empty, Idleness idleness);

/// A block that judges or shows nothing.
struct IdleBlock {
  const char* kind;  ///< "Truth"
  std::string name;
  Idleness idleness;
};

/// Blocks that judge or show nothing, in the order Truths, Claims, Tables, Plots. Of a study whose
/// rows are means, those of its runs.
std::vector<IdleBlock> idle_blocks(const StudyResult& study);

/// Whether one of them is a failure.
bool has_fault(const std::vector<IdleBlock>& blocks);

/// "1 Truth judges nothing, 2 Plots show nothing, 1 Claim is left out"; "" of none. Kinds in the
/// order in which they first appear.
std::string idle_words(const std::vector<IdleBlock>& blocks);

/// The faults, each as a line; none without a fault.
std::vector<std::string> fault_lines(const std::vector<IdleBlock>& blocks);

/// "18 of 18 verdicts hold, 1 Truth judges nothing": what a study comes to.
std::string verdict_words(int passed, int failed, const std::vector<IdleBlock>& blocks);

/// "Plot fig5: no run has creep_speed".
std::string line_of(const IdleBlock& block);

/// What stands behind a Truth's words where it judges nothing, or not all runs that it is about: ";
/// judges nothing: no closed form: contact point d is a ball", else "".
std::string not_judged_words(const TruthResult& truth);

/// A reason why a metric that has a closed form in other runs has none, and whose runs it is of.
struct MissingForm {
  std::size_t metric = 0;  ///< index
  std::string why;
  std::vector<int> subjects;  ///< in order
  int runs = 0;
};

/// Of runs that finished, each reason once for each metric.
std::vector<MissingForm> missing_forms(const StudyResult& study);

/// "creep_speed of bullet (4 runs): Bullet's iterations end before they converge".
std::string line_of(const StudyResult& study, const MissingForm& missing);

}  // namespace hookpoint::studies
