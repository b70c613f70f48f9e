// Wall object -> plan.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "contact/force_law.h"
#include "language/names.h"
#include "output/text/hash.h"
#include "simulation/analysis/step_warning.h"
#include "simulation/identity.h"
#include "simulation/scene/load.h"
#include "studies/compare/wall.h"
#include "studies/plan/plan_parts.h"
#include "studies/plan/plan_values.h"
#include "studies/plan/scene_settings.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;

class WallPlanner {
 public:
  WallPlanner(WallPlan& plan, language::Library& library, const PlanOptions& options,
              Diagnostics& diagnostics)
      : plan_(plan), library_(library), options_(options), diagnostics_(diagnostics) {}

  void add_subject(const Object& block) {
    plan_.study.subjects.push_back(subject_of(block));
    subjects_.push_back(&block);
  }

  void add_scene(const Object& block) {
    if (options_.quick && block.find("quick") != nullptr && !block.boolean("quick")) return;
    const std::string file = scene_file(block);
    const std::filesystem::path path = library_.find(file, plan_.study.file);
    if (path.empty()) {
      diagnostics_.error(block.position, "no file \"" + file + "\" beside the Wall or in configs/");
      return;
    }
    plan_.scenes.push_back(
        {block.name, block.given("title") ? block.word("title") : std::string(), file});
    const std::size_t runs_before = plan_.study.rows.size();
    const std::size_t errors_before = diagnostics_.error_count();
    covered_.clear();
    for (std::size_t i = 0; i < subjects_.size(); ++i) add_run(block, path, i);
    if (plan_.study.rows.size() > runs_before || diagnostics_.error_count() > errors_before) return;
    plan_.scenes.pop_back();
    if (options_.only.empty())
      diagnostics_.error(block.position,
                         "the scene has no Expect that covers one of the Wall's subjects");
  }

  output::Hash& hash() { return hash_; }
  std::set<std::string>& inputs() { return inputs_; }

 private:
  /// The names of the Params of the scene at `path`.
  std::vector<std::string> names_of(const std::filesystem::path& path) {
    std::vector<std::string> names;
    for (const auto& parameter : library_.parameters(path, diagnostics_))
      names.push_back(parameter.name);
    return names;
  }

  /// Sets the scene's Params by Fix blocks, the Scene's after the Subject's. A Subject's is left
  /// out where the scene has no such Param; a Scene's is then an error.
  bool set_parameters(const Object& block, const std::filesystem::path& path, std::size_t subject,
                      language::EvaluateOptions& evaluate) {
    const std::vector<std::string> names = names_of(path);
    for (const Object* fix : subjects_[subject]->children_of("Fix")) {
      if (std::ranges::find(names, fix->name) != names.end())
        evaluate.parameters[fix->name] = text_of(*fix->find("value"));
    }
    for (const Object* fix : block.children_of("Fix")) {
      if (std::ranges::find(names, fix->name) == names.end()) {
        diagnostics_.error(fix->position,
                           fmt::format("no Param of the scene is called `{}`{}", fix->name,
                                       language::did_you_mean(fix->name, names)));
        return false;
      }
      evaluate.parameters[fix->name] = text_of(*fix->find("value"));
    }
    return true;
  }

  void add_run(const Object& block, const std::filesystem::path& path, std::size_t index) {
    const SubjectPlan& subject = plan_.study.subjects[index];
    language::EvaluateOptions evaluate;
    if (!set_parameters(block, path, index, evaluate)) return;
    const auto plain = library_.evaluate(path, evaluate, diagnostics_);
    if (!plain) return;
    const auto worlds = plain->children_of("World");
    if (worlds.empty()) return diagnostics_.error(block.position, "the scene has no World");
    const std::string world = worlds.front()->trail();
    for (const std::string& name : names_of(path)) plan_.study.settable.push_back(name);
    for (const auto& child : plain->children) plan_.study.settable.push_back(child->name);
    const auto taken = settings_of_scene(options_.settings, names_of(path), *plain, world);
    for (const language::Override& setting : taken) {
      if (const auto problem = setting_problem(setting, world, subject))
        return refuse(block, *problem);
      if (evaluate.parameters.contains(setting.trail))
        return refuse(block,
                      fmt::format("a Fix sets `{}`: it cannot be set as well", setting.trail));
    }
    if (!taken.empty() && !evaluate.parameters.empty()) {
      Diagnostics untold;  // a Param that only a Fix gives a value lacks one here
      const auto unfixed = library_.evaluate(path, {}, untold);
      const auto* decided = unfixed ? changed_setting(taken, *unfixed, *plain) : nullptr;
      if (decided != nullptr) return refuse(block, decided_already(*decided));
    }
    evaluate.overrides = taken;
    const bool has_ground = !worlds.front()->children_of("Terrain.").empty();
    const auto set = [&](const char* field, const std::string& value) {
      if (!value.empty()) evaluate.overrides.push_back({world + "." + field, value});
    };
    set("engine", subject.engine);
    set("contact", has_ground ? subject.contact : "");
    set("integrator", subject.integrator);
    set("settings", subject.settings);
    if (!covers_some(*plain, subject)) return;
    Diagnostics found;
    RowPlan row;
    row.scene = std::make_shared<const RowScene>(RowScene{path, evaluate});
    auto loaded = load_scene(library_, *row.scene, found);
    tell(found, block, subject.info.name);
    if (loaded) add_row(block, std::move(row), std::move(*loaded), index);
  }

  /// An error of a scene, told once however many subjects have it.
  void refuse(const Object& block, const std::string& problem) {
    if (refused_.insert(block.name + ": " + problem).second)
      diagnostics_.error(block.position, problem);
  }

  /// Whether one of the scene's Expects covers the subject. Asked before the scene is loaded under
  /// the subject's law, for which it may not be made.
  bool covers_some(const Object& scene, const SubjectPlan& subject) const {
    Diagnostics untold;
    const auto experiment = simulation::load_experiment(scene, untold, library_.search_path());
    if (!experiment) return true;  // what is wrong is told when it is loaded for its run
    const std::string& law = subject.contact.empty() ? experiment->contact : subject.contact;
    const std::string& integrator =
        subject.integrator.empty() ? experiment->integrator : subject.integrator;
    return std::ranges::any_of(
        experiment->expectations,
        [&](const simulation::ExpectationSpec& spec) { return spec.covers(law, integrator); });
  }

  /// Plans a run. Without ground all contact laws are the same: then only the first subject of each
  /// integrator has one.
  void add_row(const Object& block, RowPlan row, LoadedScene loaded, std::size_t index) {
    const simulation::Experiment& experiment = loaded.experiment;
    if (!experiment.terrain && experiment.engine == "dts" &&
        !covered_.insert(experiment.integrator).second)
      return;
    warn_of_step(block, experiment, index);
    row.hash = simulation::experiment_hash(loaded.printed, experiment);
    hash_.add(row.hash);
    inputs_.merge(loaded.sources);
    plan_.study.seeds.insert(experiment.seed);
    row.values = {static_cast<int>(plan_.scenes.size()) - 1};
    row.subject = static_cast<int>(index);
    row.deltat = experiment.deltat;
    row.duration = experiment.duration;
    row.engine = experiment.engine;
    plan_.study.rows.push_back(std::move(row));
    WallRunPlan& run = plan_.runs.emplace_back();
    run.law = experiment.terrain ? experiment.contact : "";
    run.integrator = contact::find_force_law(experiment.contact) ? experiment.integrator : "";
    for (const simulation::ExpectationSpec& spec : experiment.expectations)
      if (spec.covers(experiment)) run.expectations.push_back(spec);
  }

  void warn_of_step(const Object& block, const simulation::Experiment& experiment,
                    std::size_t index) {
    const std::optional<std::string> what = simulation::step_warning(experiment);
    if (!what) return;
    const std::string& subject = plan_.study.subjects[index].info.name;
    diagnostics_.warning(block.position, *what);
    diagnostics_.note(block.position, "with subject = " + subject);
    plan_.study.warnings.push_back(block.name + " under " + subject + ": " + *what);
  }

  void tell(const Diagnostics& found, const Object& block, const std::string& subject) {
    for (const language::Diagnostic& diagnostic : found.all()) {
      if (diagnostic.severity != language::Severity::error) continue;
      diagnostics_.error(diagnostic.position, diagnostic.message);
      diagnostics_.note(block.position, "with subject = " + subject);
    }
  }

  WallPlan& plan_;
  language::Library& library_;
  const PlanOptions& options_;
  Diagnostics& diagnostics_;
  std::vector<const Object*> subjects_;
  std::set<std::string> covered_;
  std::set<std::string> refused_;  ///< scenes, each with what is wrong
  output::Hash hash_;
  std::set<std::string> inputs_;  ///< files that the rows were made from and read
};

/// A subject that names no engine has that of its scenes.
void complete_subjects(StudyPlan& study) {
  for (const RowPlan& row : study.rows)
    study.subjects[static_cast<std::size_t>(row.subject)].info.engine = row.engine;
}

}  // namespace

std::string scene_file(const Object& scene) {
  return scene.given("file") ? scene.word("file") : "scenes/" + scene.name + ".hook";
}

std::optional<WallPlan> make_wall_plan(const Object& root, const Object& wall,
                                       const std::string& file, language::Library& library,
                                       const PlanOptions& options, Diagnostics& diagnostics) {
  WallPlan plan;
  plan.study.name = wall.name;
  plan.study.file = file;
  plan.study.library = &library;
  plan.study.quick = options.quick;
  if (wall.find("title") != nullptr) plan.study.title = wall.word("title");
  if (wall.find("question") != nullptr) plan.study.question = wall.word("question");
  WallPlanner planner(plan, library, options, diagnostics);
  for (const Object* subject : wall.children_of("Subject")) {
    if (options.only.empty() ||
        std::ranges::find(options.only, subject->name) != options.only.end())
      planner.add_subject(*subject);
  }
  if (plan.study.subjects.empty())
    diagnostics.error(wall.position, "the Wall has no Subject, or none that --only names");
  for (const Object* scene : wall.children_of("Scene")) planner.add_scene(*scene);
  if (diagnostics.has_errors()) return std::nullopt;
  plan.study.printed = language::print(root);
  planner.hash().add(plan.study.printed);
  plan.study.hash = planner.hash().text();
  for (std::string& source : language::sources_of(root)) planner.inputs().insert(std::move(source));
  plan.study.inputs = simulation::hashed(planner.inputs());
  complete_subjects(plan.study);
  return plan;
}

}  // namespace hookpoint::studies
