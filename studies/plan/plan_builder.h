// Turns a study's blocks into the parts of its plan, one by one. Looks names up among the parts
// planned so far, with the nearest one in the error.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "language/diagnostics.h"
#include "language/tree/object.h"
#include "studies/plan/plan.h"
#include "studies/plan/plan_values.h"

namespace hookpoint::studies {

class PlanBuilder {
 public:
  PlanBuilder(StudyPlan& plan, std::vector<std::string> parameters, const PlanOptions& options,
              language::Diagnostics& diagnostics)
      : plan_(plan),
        parameters_(std::move(parameters)),
        options_(options),
        diagnostics_(diagnostics) {}

  void add_sweep(const language::Object& block);
  void add_subject(const language::Object& block);
  void add_metric(const language::Object& block);
  void add_truth(const language::Object& block);
  void add_plot(const language::Object& block);
  void add_table(const language::Object& block);
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
  std::vector<Condition> conditions(const language::Object& owner);
  std::string conditions_words(const std::vector<Condition>& conditions) const;
  std::string truth_words(const language::Object& block, const TruthPlan& truth);
  std::vector<int> named_subjects(const language::Object& block);
  std::string sweep_unit(const language::Object& block, const char* field);
  std::string metric_unit(const language::Object& block, const char* field);
  static std::vector<std::string> metric_names();
  /// The number that the block has in `field`, with an error where its unit is not of the kind of
  /// `unit`.
  double number_in(const language::Object& block, const char* field, std::string_view unit);
  /// For figures: the values of the sweeps that the conditions let in, in the sweeps' units.
  SweepValues admitted(const std::vector<Condition>& conditions) const;
  /// Whether `field` names a sweep or is `subject`; if not, an error.
  bool is_table_side(const language::Object& block, const char* field);
  void set_panels(PlotSpec& spec, const language::Object& block);
  void set_references(PlotSpec& spec, const language::Object& block);
  void set_time_axes(PlotPlan& plot, const language::Object& block);
  void set_map(PlotSpec& spec, const language::Object& block);

  StudyPlan& plan_;
  std::vector<std::string> parameters_;
  const PlanOptions& options_;
  language::Diagnostics& diagnostics_;
};

}  // namespace hookpoint::studies
