// The rows of a plan as they are made: the scene of each is loaded, as many at a time as are worth
// several threads, for what the plan keeps of it. What a scene is made of, and what there is to say
// about it, differs between a Study and a Wall.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "language/diagnostics.h"
#include "output/files/hash.h"
#include "studies/measure/engine_table.h"
#include "studies/plan/plan.h"
#include "studies/plan/scene.h"

namespace hookpoint::studies {

/// What a plan keeps of a row's scene, and what there is to say about it: the scene itself is large
/// and goes when it has been looked at.
struct LoadedRow {
  bool loads = false;  ///< else nothing but `found` says something
  language::Diagnostics found;
  std::string hash;  ///< of its experiment, and of the refusal
  std::string contact, integrator;
  bool has_ground = false;
  double deltat = 0., duration = 0.;  ///< [s]
  std::uint64_t seed = 0;
  SubjectInfo composition;
  std::set<std::string> sources;
  std::optional<std::string> warning;  ///< of its step
  std::string printed;                 ///< of the first rows, where the plan shows its scene
  std::string refusal;                 ///< why its engine cannot run it; "": it can
  std::vector<RowForm> forms;
  std::string no_body;   ///< why the body that is requested cannot be measured
  std::string no_match;  ///< why its ground cannot be hookpoint's
  std::vector<simulation::MatchedMaterial> matched;
  std::vector<simulation::ExpectationSpec> expectations;  ///< of a Wall: those that cover it
};

class RowPlanner {
 public:
  /// All outlives it.
  RowPlanner(StudyPlan& plan, const EngineTable& engines, int jobs,
             language::Diagnostics& diagnostics)
      : plan_(plan), engines_(engines), diagnostics_(diagnostics), jobs_(jobs) {}
  virtual ~RowPlanner() = default;

  /// False after an error, as from `finish`.
  bool add(RowPlan row);
  bool finish();

  /// Completes the plan: its hash, which is that of the rows and of what was added, its inputs,
  /// those of `root` among them, and what its subjects are made of.
  void complete(const language::Object& root);

  output::Hash hash;
  std::set<std::string> inputs;  ///< files that the rows were made from and read

 protected:
  enum class Answer { taken, dropped, error };

  /// In any thread.
  virtual LoadedRow load(const RowPlan& row) const = 0;
  /// Reports what there is to say and completes the row, one after the other.
  virtual Answer accept(LoadedRow& loaded, RowPlan& row) = 0;

  /// What the row has of its scene whatever runs it.
  void take(const LoadedScene& scene, LoadedRow& loaded) const;
  const SubjectPlan& planned_subject(const RowPlan& row) const {
    return plan_.subjects[static_cast<std::size_t>(row.subject)];
  }
  /// `who` has the step in the plan's warnings.
  void warn_of_step(const language::Position& place, const std::string& who, const RowPlan& row,
                    const std::string& what);

  StudyPlan& plan_;
  const EngineTable& engines_;
  language::Diagnostics& diagnostics_;

 private:
  bool add_loaded(LoadedRow loaded, RowPlan row);
  int composition_index(SubjectInfo made);

  int jobs_;
  std::vector<RowPlan> waiting_;
  std::map<std::tuple<std::string, std::string, std::string, std::string>, int> compositions_;
};

}  // namespace hookpoint::studies
