// Turns a study's blocks into the parts of its plan, one by one. Looks names up among the parts
// planned so far, with the nearest one in the error.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "language/diagnostics.h"
#include "language/tree/object.h"
#include "studies/measurements/case_table.h"
#include "studies/plan/plan.h"
#include "studies/plan/plan_values.h"
#include "studies/plan/scene_probe.h"

namespace hookpoint::studies {

class PlanBuilder {
 public:
  PlanBuilder(StudyPlan& plan, const PlanOptions& options, language::Diagnostics& diagnostics)
      : plan_(plan),
        parameters_(plan.scene_parameters),
        options_(options),
        diagnostics_(diagnostics) {}

  /// Reads which Params the grounds have that a Sweep `terrain` names, before the blocks that may
  /// speak of them.
  void find_grounds(const language::Object& block);

  /// What names mean in the scene, for what follows; null where it cannot be laid down.
  void know(SceneNames* scene) { scene_ = scene; }

  void add_sweep(const language::Object& block);
  /// Of what its table has: an axis of the study.
  void add_cases(const language::Object& block);
  /// What the Traces of its Cases have measured, and how long a study without a `duration` runs.
  void add_curves(const language::Object& study);
  void add_subject(const language::Object& block);
  void add_metric(const language::Object& block);
  /// Those Expects of the scene that say something of a run as long as the study's.
  void add_expectations();
  void add_truth(const language::Object& block);
  void add_plot(const language::Object& block);
  void add_table(const language::Object& block);
  void add_claim(const language::Object& block);
  /// The runs of each row, after all that may speak of other sweeps.
  void add_seeds(const language::Object& study);
  void check_only_option(const language::Object& study);
  void check_size(const language::Object& study);
  std::vector<Assignment> fixes(const language::Object& owner);

 private:
  void unknown(const language::Position& position, std::string_view kind, const std::string& name,
               const std::vector<std::string>& known);
  std::vector<std::string> sweep_names() const;
  int sweep_index(const std::string& name) const;  ///< -1 for none
  bool parameter_exists(const language::Object& block);
  /// Whether a Sweep may have so many; if not, an error at its `field`.
  bool may_have_values(const language::Object& block, const char* field, double count);
  std::vector<double> sweep_values(const language::Object& block, const WrittenUnit& unit);
  /// What a Sweep of this name sets; nothing, after an error, where no such thing is.
  std::optional<SweepRole> role_of(const language::Object& block);
  /// Whether the words are what a Subject may say there; else errors.
  bool may_say(const language::Object& block, const language::Field& words);
  void add_word_sweep(const language::Object& block, SweepRole role);
  /// The file that the field names, kept among those that were measured; empty after an error.
  std::filesystem::path measured_file(const language::Object& block, const char* field);
  /// Leaves those of the cases that run under --quick.
  void choose_quick_cases(const language::Object& block);
  void read_curves(const language::Object& cases);
  /// Each case lasts up to its last sample.
  void last_as_measured(const language::Object& study);
  /// Whether a Sweep or a table of cases sets the Param.
  bool is_varied(const std::string& parameter) const;
  /// Whether no field of the block is swept; else an error.
  void check_not_swept(const language::Object& subject);
  /// All values that the block gives, in the unit; empty where it lacks some.
  std::vector<double> declared_values(const language::Object& block, const WrittenUnit& unit);
  /// The places in the sweep of those of the words that run; errors for words that it lacks.
  std::vector<double> word_values(const SweepPlan& sweep, const language::Field& field);
  /// The numbers; errors for those that the sweep lacks.
  std::vector<double> number_values(const SweepPlan& sweep, const language::Field& field);
  /// "`13 deg` is no value of the Sweep `slope`; it has 4 deg, 12 deg"; `value` in SI, if it is a
  /// number.
  static std::string no_such_value(const SweepPlan& sweep, const std::string& text,
                                   std::optional<double> value);
  /// Those values of the sweep that the condition lets in.
  std::vector<std::string> admitted_texts(const Condition& condition) const;
  Condition condition(const language::Object& block, int sweep);
  std::vector<Condition> conditions(const language::Object& owner);
  std::string conditions_words(const std::vector<Condition>& conditions) const;
  std::string truth_words(const language::Object& block, const TruthPlan& truth);
  std::vector<int> named_subjects(const language::Object& block);
  std::string sweep_unit(const language::Object& block, const char* field);
  std::string metric_unit(const language::Object& block, const char* field);
  static std::vector<std::string> metric_names();
  std::vector<std::string> measured_names() const;
  std::ptrdiff_t measured_index(std::string_view name) const;  ///< of StudyPlan::metrics; -1: none
  /// A metric that the block itself defines.
  void add_own_metric(const language::Object& block);
  /// Errors where a built-in metric's block has fields of the user's own.
  void check_own_fields(const language::Object& block);
  /// Of the names of a formula of ports, or of the scene's constants; the ports' trails go to
  /// `trails`. Nothing after an error.
  std::optional<std::vector<std::optional<language::Dimension>>> dimensions_of(
      const language::Formula& formula, bool ports, std::vector<std::string>& trails);
  std::optional<language::FormulaUnit> formula_unit(const language::Formula& formula, bool ports,
                                                    std::vector<std::string>& trails);
  /// Sets what the metric is of: ports, or a Trace of the Cases. Nothing after an error.
  std::optional<language::FormulaUnit> set_source(UserMetric& metric,
                                                  const language::Object& block);
  std::optional<language::FormulaUnit> set_trace(UserMetric& metric, const language::Object& block);
  void check_fits(const language::Field& field, const std::optional<language::Dimension>& found,
                  const language::Dimension& wanted);
  simulation::ReductionSpec reduction_of(const language::Object& block);
  void set_unit(UserMetric& metric, const language::Object& block,
                const std::optional<language::Dimension>& dimension);
  void add_expectation(const language::Object& block, const simulation::ExpectationSpec& spec);
  void keep(UserMetric metric);
  /// The unit that the block's `unit` names, where it fits `dimension`; else nothing, after an
  /// error.
  std::optional<language::Unit> given_unit(const language::Object& block,
                                           const std::optional<language::Dimension>& dimension);
  /// The number in the unit that the field has it in, else in `unit`: "0.5 deg".
  static std::string number_text(const language::Object& block, const char* field,
                                 const std::string& unit);
  /// " within 1 % or 2 mm"; `within` is the text of the latter.
  static std::string allowed_words(const TruthPlan& truth, const std::string& within);
  /// The number that the block has in `field`, with an error where its unit is not of the kind of
  /// `unit`.
  double number_in(const language::Object& block, const char* field, std::string_view unit);
  /// Adds the value of the sweep `name` that `value` is to `where`; false after an error.
  bool is_claim_place(const language::Object& block, const std::string& name,
                      const std::string& value, SweepValues& where);
  /// What stands between two braces of a Claim's text; nothing after an error.
  std::optional<ClaimPart> claim_number(const language::Object& block, const std::string& text);
  std::optional<ClaimValue> claim_value(const language::Object& block, const std::string& text);
  bool claim_parts(const language::Object& block, std::vector<ClaimPart>& parts);
  std::vector<int> claim_truths(const language::Object& block, const std::vector<ClaimPart>& parts);
  /// Whether `field` names a sweep or is `subject`; if not, an error.
  bool is_table_side(const language::Object& block, const char* field);
  void set_panels(PlotSpec& spec, const language::Object& block);
  void set_references(PlotSpec& spec, const language::Object& block);
  void set_time_axes(PlotPlan& plot, const language::Object& block);
  void set_map(PlotSpec& spec, const language::Object& block);

  StudyPlan& plan_;
  std::vector<std::string> parameters_;  ///< of the scene and of its grounds
  std::vector<SweptGround> grounds_;
  std::vector<CaseRow> cases_;  ///< of the Cases block that run
  const PlanOptions& options_;
  language::Diagnostics& diagnostics_;
  SceneNames* scene_ = nullptr;
};

}  // namespace hookpoint::studies
