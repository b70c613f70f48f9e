#include "studies/plan/plan_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "language/names.h"
#include "language/values/budget.h"
#include "simulation/scene/load.h"
#include "studies/blocks/block.h"
#include "studies/blocks/fix.h"
#include "studies/blocks/measure.h"
#include "studies/blocks/study.h"
#include "studies/blocks/written_values.h"
#include "studies/plan/row_forms.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;

/// Puts the step that a run chooses where the scene leaves it to it: a closed form may name it.
void write_step(Object& scene) {
  Diagnostics unreported;
  if (const auto experiment = simulation::load_experiment(scene, unreported))
    simulation::write_chosen_step(*experiment, scene);
}

RowPlan first_row(const StudyPlan& plan, const std::filesystem::path& scene_file) {
  RowPlan first;
  first.values.assign(plan.sweeps.size(), 0);
  first.scene = std::make_shared<const ScenePlan>(ScenePlan{.file = scene_file, .options = {}});
  return first;
}

/// The scene as the study's first run has it, but for fields of its World. Null where it cannot be
/// laid down; what is wrong goes to `diagnostics`.
std::unique_ptr<Object> lay_first(const StudyPlan& plan, const std::filesystem::path& file,
                                  Diagnostics& diagnostics) {
  if (plan.subjects.empty()) return nullptr;
  const RowPlan first = first_row(plan, file);
  ScenePlan scene = plan.scene_of(first);
  scene.options.overrides.clear();
  Diagnostics found;
  auto tree = lay_down(*plan.library, scene, found);
  for (const language::Diagnostic& diagnostic : found.all())
    diagnostics.report_again(diagnostic, plan.place_in_study(diagnostic.position, first, ""));
  return tree;
}

/// Words that the study's Sweeps and Fixes say, those too that do not run under --quick.
std::vector<std::string> words_in(const Object& study) {
  std::vector<std::string> words;
  for (const Object* sweep : study.children_of("Sweep")) append(words, swept_words(*sweep));
  std::vector<const Object*> owners = study.children_of("Subject");
  owners.push_back(&study);
  for (const Object* owner : owners)
    for (const Object* fix : owner->children_of("Fix")) append(words, fixed_words(*fix));
  for (const Object* subject : study.children_of("Subject"))
    for (const CompositionWord& word : composition_words)
      if (subject->given(word.field)) words.push_back(subject->word(word.field));
  return words;
}

bool defines_metric(const Object* measure) { return measure_block(*measure).defines_metric(); }

bool has_traces(const Object* cases) { return !cases->children_of("Trace").empty(); }

/// Reports a Sweep or Cases whose name stands for something else in a Table, a Plot or results.csv.
void check_swept_names(const Object& study, Diagnostics& diagnostics) {
  for (const char* type : {"Sweep", "Cases"})
    for (const Object* block : study.children_of(type))
      if (block->name == "subject" || block->name == "status")
        diagnostics.error(
            block->position,
            fmt::format("results.csv has another column `{}`: give the {} another "
                        "name",
                        block->name, block->type == "Sweep" ? "Param of the scene" : "Cases"));
}

/// The column of results.csv that a metric of this name would have a second time; "" for none.
std::string taken_column(const StudyPlan& plan, const std::string& name) {
  static const std::vector<std::string> no_metrics{"subject",  "engine", "law",   "integrator",
                                                   "settings", "seed",   "status"};
  if (language::contains(no_metrics, name)) return name;
  for (const std::string& other : plan.metric_names())
    for (const char* ending : {"_predicted", "_ok"}) {
      if (name == other + ending) return name;
      if (other == name + ending) return other;
    }
  return "";
}

/// Reports a Measure whose name another column of results.csv has, or an axis of a Plot.
void check_name(const StudyPlan& plan, const Object& measure, Diagnostics& diagnostics) {
  if (plan.sweep_index(measure.name) >= 0)
    diagnostics.error(measure.position,
                      fmt::format("`{}` is a Sweep or the Cases too: a Plot could not tell which "
                                  "is meant; rename one of them",
                                  measure.name));
  else if (const std::string column = taken_column(plan, measure.name); !column.empty())
    diagnostics.error(measure.position,
                      fmt::format("results.csv has another column `{}`: give this metric another "
                                  "name",
                                  column));
}

void check_only_option(const StudyPlan& plan, const Object& study, Diagnostics& diagnostics) {
  const std::vector<std::string> names = plan.subject_names();
  for (const std::string& only : plan.only)
    if (std::ranges::find(names, only) == names.end())
      report_unknown(study.position, "Subject", only, names, diagnostics);
}

void check_size(const StudyPlan& plan, const Object& study, Diagnostics& diagnostics) {
  const double count = plan.most_rows();
  if (count > static_cast<double>(most_runs))
    diagnostics.error(study.position, fmt::format("the study's sweeps and subjects require {}",
                                                  language::too_many(count, most_runs, "runs")));
}

}  // namespace

void plan_parts(StudyPlan& plan, const Object& study, const std::filesystem::path& scene_file,
                Diagnostics& diagnostics) {
  const auto sweeps = study.children_of("Sweep"), cases = study.children_of("Cases");
  const auto measures = study.children_of("Measure");
  check_swept_names(study, diagnostics);
  for (const Object* block : sweeps) append(plan.grounds, load_grounds(*block, plan, diagnostics));
  for (const Object* block : sweeps)
    if (auto sweep = load_sweep(*block, plan, diagnostics))
      plan.sweeps.push_back(std::move(*sweep));
  for (const Object* block : cases) load_cases(*block, plan, diagnostics);
  // What else names the cases is not wrong where they could not be read.
  if (!cases.empty() && plan.case_sweep() < 0) return;
  for (const Object* block : study.children_of("Subject"))
    plan.subjects.push_back(load_subject(*block, plan, diagnostics));
  plan.fixes = load_fixes(study, plan, diagnostics);
  std::unique_ptr<Object> scene;
  Diagnostics dropped;
  if (!diagnostics.has_errors()) {
    const bool needed =
        std::ranges::any_of(measures, defines_metric) || std::ranges::any_of(cases, has_traces);
    scene = lay_first(plan, scene_file, needed ? diagnostics : dropped);
    if (scene && needed) write_step(*scene);
  }
  std::optional<SceneNames> known;
  if (scene) {
    known.emplace(*scene, words_of(plan, first_row(plan, scene_file)));
    known->expect_words(words_in(study));
  }
  SceneNames* const names = known ? &*known : nullptr;
  load_curves(study, names, plan, diagnostics);
  for (const Object* block : measures) {
    check_name(plan, *block, diagnostics);
    load_measure(*block, names, plan, diagnostics);
  }
  if (names != nullptr && study_block(study).expects) load_expectations(*names, plan, diagnostics);
  for (const Object* block : study.children_of("Truth"))
    if (auto truth = load_truth(*block, plan, diagnostics))
      plan.truths.push_back(std::move(*truth));
  for (const Object* block : study.children_of("Plot"))
    plan.plots.push_back(load_plot(*block, plan, diagnostics));
  for (const Object* block : study.children_of("Table"))
    plan.tables.push_back(load_table(*block, plan, diagnostics));
  for (const Object* block : study.children_of("Claim"))
    if (auto claim = load_claim(*block, plan, diagnostics))
      plan.claims.push_back(std::move(*claim));
  load_seeds(study, plan, diagnostics);
  check_only_option(plan, study, diagnostics);
  check_size(plan, study, diagnostics);
}

}  // namespace hookpoint::studies
