// Wall object -> plan.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "language/names.h"
#include "language/units.h"
#include "simulation/analysis/step_warning.h"
#include "simulation/scene/load.h"
#include "studies/blocks/fix.h"
#include "studies/blocks/measure.h"
#include "studies/blocks/wall.h"
#include "studies/compare/wall.h"
#include "studies/plan/row_planner.h"
#include "studies/plan/scene.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;

/// The rows of a Wall: each scene under the subjects that its truths cover.
class WallPlanner : public RowPlanner {
 public:
  WallPlanner(WallPlan& plan, const EngineTable& engines, const PlanOptions& options,
              Diagnostics& diagnostics)
      : RowPlanner(plan.study, engines, options.jobs, diagnostics),
        wall_(plan),
        library_(*plan.study.library),
        options_(options) {
    SweepPlan& sweep = plan_.sweeps.emplace_back();
    sweep.role = SweepRole::scenes;
    sweep.column.name = "scene";
  }

  void add_subject(const Object& block) {
    plan_.subjects.push_back(subject_of(block));
    subjects_.push_back(&block);
  }

  void add_scene(const Object& block) {
    const SceneBlock scene = scene_block(block);
    if (options_.quick && !scene.quick) return;
    const std::string file = scene_file(block);
    const std::filesystem::path path = library_.find(file, plan_.file);
    if (path.empty()) {
      diagnostics_.error(block.position, "no file \"" + file + "\" beside the Wall or in configs/");
      return;
    }
    wall_.scenes.push_back({block.name, scene.title, file, {}, scene.accepted_by});
    accepted_ = scene.accepted;
    if (accepted_ != nullptr) wall_.scenes.back().accepted = accepted_->numbers[0];
    const std::size_t runs_before = plan_.rows.size();
    const std::size_t errors_before = diagnostics_.error_count();
    covered_.clear();
    block_ = &block;
    for (std::size_t i = 0; i < subjects_.size(); ++i) add_run(block, path, i);
    finish();
    if (plan_.rows.size() > runs_before || diagnostics_.error_count() > errors_before)
      return add_value(block);
    wall_.scenes.pop_back();
    if (options_.only.empty())
      diagnostics_.error(block.position,
                         "the scene has no Expect that covers one of the Wall's subjects");
  }

 private:
  /// The scene as a value of what the study varies.
  void add_value(const Object& block) {
    SweepPlan& sweep = plan_.sweeps.front();
    const auto index = static_cast<double>(sweep.si.size());
    sweep.si.push_back(index);
    sweep.column.values.push_back(index);
    sweep.column.words.push_back(block.name);
    sweep.texts.push_back(block.name);
    sweep.places.push_back(block.position);
  }

  /// Sets the scene's Params by Fix blocks, the Scene's after the Subject's. A Subject's is left
  /// out where the scene has no such Param; a Scene's is then an error.
  bool set_parameters(const Object& block, const std::filesystem::path& path, std::size_t subject,
                      language::EvaluateOptions& evaluate) {
    const std::vector<std::string> names = parameter_names(library_, path, diagnostics_);
    for (const Object* fix : subjects_[subject]->children_of("Fix")) {
      if (language::contains(names, fix->name)) evaluate.parameters[fix->name] = fixed_text(*fix);
    }
    for (const Object* fix : block.children_of("Fix")) {
      if (!language::contains(names, fix->name)) {
        refuse(*fix, fmt::format("no Param of the scene is called `{}`{}", fix->name,
                                 language::did_you_mean(fix->name, names)));
        return false;
      }
      evaluate.parameters[fix->name] = fixed_text(*fix);
    }
    return true;
  }

  void add_run(const Object& block, const std::filesystem::path& path, std::size_t index) {
    const SubjectPlan& subject = plan_.subjects[index];
    language::EvaluateOptions evaluate;
    if (!set_parameters(block, path, index, evaluate)) return;
    Diagnostics found;
    const auto plain = library_.evaluate(path, evaluate, found);
    forward(block, found);
    if (!plain) return;
    const auto worlds = plain->children_of("World");
    if (worlds.empty()) return diagnostics_.error(block.position, "the scene has no World");
    const std::string world = worlds.front()->trail();
    const std::vector<std::string> names = parameter_names(library_, path, diagnostics_);
    plan_.settable.insert(plan_.settable.end(), names.begin(), names.end());
    for (const auto& child : plain->children) plan_.settable.push_back(child->name);
    const auto taken = settings_of_scene(options_.settings, names, *plain, world);
    for (const language::Override& setting : taken) {
      if (const auto problem = setting_problem(setting, world, subject))
        return refuse(block, *problem);
      if (evaluate.parameters.contains(setting.trail))
        return refuse(block,
                      fmt::format("a Fix sets `{}`: it cannot be set as well", setting.trail));
    }
    if (!taken.empty() && !evaluate.parameters.empty()) {
      Diagnostics unreported;  // a Param that only a Fix gives a value lacks one here
      const auto unfixed = library_.evaluate(path, {}, unreported);
      const auto* decided = unfixed ? changed_setting(taken, *unfixed, *plain) : nullptr;
      if (decided != nullptr) return refuse(block, decided_already(*decided));
    }
    ScenePlan scene{path, evaluate, world};
    scene.options.overrides = taken;
    Composition words = subject;
    if (worlds.front()->children_of("Terrain.").empty()) words.contact.clear();
    scene.set_world(words);
    if (!covers_some(*plain, subject)) return;
    RowPlan row;
    row.values = {static_cast<int>(wall_.scenes.size()) - 1};
    row.subject = static_cast<int>(index);
    row.scene = std::make_shared<const ScenePlan>(std::move(scene));
    add(std::move(row));
  }

  /// What was found in a scene's file, reported once however many subjects have it.
  void forward(const Object& block, const Diagnostics& found) {
    std::string all;
    for (const language::Diagnostic& diagnostic : found.all()) all += diagnostic.message + "\n";
    if (!refused_.insert(block.name + ": " + all).second) return;
    for (const language::Diagnostic& diagnostic : found.all())
      diagnostics_.report_again(diagnostic, diagnostic.position);
  }

  /// An error of a scene, told once however many subjects have it.
  void refuse(const Object& block, const std::string& problem) {
    if (refused_.insert(block.name + ": " + problem).second)
      diagnostics_.error(block.position, problem);
  }

  /// Whether one of the scene's Expects, which are noted, covers the subject. Asked before the scene
  /// is loaded under the subject's law, for which it may not be made.
  bool covers_some(const Object& scene, const SubjectPlan& subject) {
    Diagnostics unreported;
    const auto experiment = simulation::load_experiment(scene, unreported, library_.search_path());
    if (!experiment) return true;  // what is wrong is told when it is loaded for its run
    std::vector<std::string>& expects = wall_.scenes.back().expects;
    for (const simulation::ExpectationSpec& spec : experiment->expectations)
      if (!language::contains(expects, spec.name)) expects.push_back(spec.name);
    const std::string& law = subject.contact.empty() ? experiment->contact : subject.contact;
    const std::string& integrator =
        subject.integrator.empty() ? experiment->integrator : subject.integrator;
    return std::ranges::any_of(
        experiment->expectations,
        [&](const simulation::ExpectationSpec& spec) { return spec.covers(law, integrator); });
  }

  LoadedRow load(const RowPlan& row) const override {
    LoadedRow loaded;
    const auto scene = load_scene(library_, *row.scene, loaded.found);
    if (!scene) return loaded;
    take(*scene, loaded);
    // Without ground no law does anything.
    if (!loaded.has_ground) loaded.composition.law.clear();
    loaded.warning = simulation::step_warning(scene->experiment);
    for (const simulation::ExpectationSpec& spec : scene->experiment.expectations)
      if (spec.covers(scene->experiment)) loaded.expectations.push_back(spec);
    return loaded;
  }

  /// Without ground all contact laws are the same: then only the first subject of each integrator
  /// has a run. The errors of one row hide none of the next.
  Answer accept(LoadedRow& loaded, RowPlan& row) override {
    for (const language::Diagnostic& diagnostic : loaded.found.all()) {
      if (diagnostic.severity != language::Severity::error ||
          !refused_.insert(block_->name + ": " + diagnostic.message).second)
        continue;
      diagnostics_.error(diagnostic.position, diagnostic.message);
      diagnostics_.note(block_->position, "with subject = " + planned_subject(row).info.name);
    }
    if (!loaded.loads || (!loaded.has_ground && loaded.composition.engine == "dts" &&
                          !covered_.insert(loaded.integrator).second))
      return Answer::dropped;
    if (loaded.warning)
      warn_of_step(block_->position, block_->name + " under " + planned_subject(row).info.name, row,
                   *loaded.warning);
    row.deltat = loaded.deltat;
    row.duration = loaded.duration;
    if (wall_.score_card && !fit_a_card(loaded.expectations)) return Answer::error;
    wall_.expectations.push_back(std::move(loaded.expectations));
    return Answer::taken;
  }

  /// Whether each has a scale, and the unit of the error that others accept.
  bool fit_a_card(const std::vector<simulation::ExpectationSpec>& expectations) {
    for (const simulation::ExpectationSpec& spec : expectations) {
      const auto unit = language::parse_unit(spec.unit);
      std::string problem;
      if (spec.expected == 0. && !spec.scale)
        problem = fmt::format(
            "the Expect {} has a closed form of 0: a score card needs the `scale` that its error is "
            "held against",
            spec.name);
      else if (accepted_ != nullptr && unit &&
               !language::fits(accepted_->dimension, unit->dimension))
        problem = fmt::format("`accepted` is to be in {}, as the Expect {} is, not in {}",
                              language::describe_dimension(unit->dimension), spec.name,
                              language::describe_dimension(accepted_->dimension));
      if (problem.empty()) continue;
      refuse(*block_, problem);
      return false;
    }
    return true;
  }

  WallPlan& wall_;
  language::Library& library_;
  const PlanOptions& options_;
  const Object* block_ = nullptr;              ///< the present scene
  const language::Field* accepted_ = nullptr;  ///< of it
  std::vector<const Object*> subjects_;
  std::set<std::string> covered_;
  std::set<std::string> refused_;  ///< scenes, each with what is wrong
};

/// Measures the truths of all scenes, by their names: a run has those that cover it.
void measure_expectations(WallPlan& plan) {
  StudyPlan& study = plan.study;
  for (const auto& expectations : plan.expectations)
    for (const simulation::ExpectationSpec& spec : expectations) {
      if (study.metric_index(spec.name) >= 0) continue;
      UserMetric metric;
      metric.name = metric.expectation = spec.name;
      add_user_metric(std::move(metric), study);
    }
  for (std::size_t row = 0; row < study.rows.size(); ++row) {
    RowForm none;
    none.missing = "no Expect of that name covers the run";
    study.rows[row].forms.assign(study.metrics.size(), none);
    for (const simulation::ExpectationSpec& spec : plan.expectations[row])
      study.rows[row].forms[static_cast<std::size_t>(study.metric_index(spec.name))] = {};
  }
}

}  // namespace

std::optional<WallPlan> make_wall_plan(const Object& root, const Object& wall,
                                       const std::string& file, language::Library& library,
                                       const EngineTable& engines, const PlanOptions& options,
                                       Diagnostics& diagnostics) {
  WallPlan plan;
  plan.study.name = wall.name;
  plan.study.file = file;
  plan.study.library = &library;
  plan.study.quick = options.quick;
  plan.study.may_end = true;
  const WallBlock block = wall_block(wall);
  plan.study.title = block.title;
  plan.study.question = block.question;
  plan.score_card = block.score_card;
  WallPlanner planner(plan, engines, options, diagnostics);
  for (const Object* subject : wall.children_of("Subject")) {
    if (options.only.empty() || language::contains(options.only, subject->name))
      planner.add_subject(*subject);
    else
      plan.unselected.push_back(subject->name);
  }
  if (plan.study.subjects.empty())
    diagnostics.error(wall.position, "the Wall has no Subject, or none that --only names");
  for (const Object* scene : wall.children_of("Scene")) planner.add_scene(*scene);
  if (plan.study.rows.empty() && !diagnostics.has_errors())
    diagnostics.error(wall.position,
                      "the Wall has no run: no Scene, or none that is left by "
                      "--quick and --only");
  if (diagnostics.has_errors()) return std::nullopt;
  plan.study.printed = language::print(root);
  planner.hash.add(plan.study.printed);
  planner.complete(root);
  measure_expectations(plan);
  return plan;
}

}  // namespace hookpoint::studies
