// Study object -> plan: names, units and values are checked here, and every row's scene is loaded.
#include "studies/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "language/names.h"
#include "simulation/analysis/step_warning.h"
#include "simulation/engine_interface/identity.h"
#include "simulation/engine_interface/step_count.h"
#include "studies/blocks/study.h"
#include "studies/measure/measured_body.h"
#include "studies/plan/plan_parts.h"
#include "studies/plan/row_forms.h"
#include "studies/plan/row_planner.h"
#include "studies/plan/scene.h"
#include "studies/results/selection.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

bool StudyPlan::covers(const std::vector<Condition>& conditions, const RowPlan& row) const {
  return std::all_of(conditions.begin(), conditions.end(), [&](const Condition& condition) {
    const auto sweep = static_cast<std::size_t>(condition.sweep);
    return condition.holds(sweeps[sweep].si[static_cast<std::size_t>(row.values[sweep])]);
  });
}

bool StudyPlan::records(const PlotPlan& plot, const RowPlan& row) const {
  return plot.signal != nullptr && covers(plot.only, row);
}

bool StudyPlan::measures(MetricScope scope) const {
  return std::ranges::any_of(
      metrics, [&](const MeasuredMetric& metric) { return metric.definition->scope == scope; });
}

std::vector<std::vector<std::size_t>> StudyPlan::groups_along(int sweep) const {
  std::map<std::pair<int, std::vector<int>>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<int> values = rows[i].values;
    if (sweep >= 0) values[static_cast<std::size_t>(sweep)] = 0;
    groups[{rows[i].subject, std::move(values)}].push_back(i);
  }
  std::vector<std::vector<std::size_t>> found;
  for (auto& [key, group] : groups) found.push_back(std::move(group));
  return found;
}

double StudyPlan::most_rows() const {
  auto count = static_cast<double>(subjects.size());
  for (const SweepPlan& sweep : sweeps) count *= static_cast<double>(sweep.si.size());
  return count;
}

std::filesystem::path StudyPlan::folder() const { return folder_of(name, hash); }

std::string StudyPlan::name_of(const RowPlan& row) const {
  std::string text = name + " (" + subjects[static_cast<std::size_t>(row.subject)].info.name;
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    text += ", " + sweeps[i].column.name + " = " +
            sweeps[i].texts[static_cast<std::size_t>(row.values[i])];
  return text + ")";
}

ScenePlan StudyPlan::scene_of(const RowPlan& row) const {
  ScenePlan scene = *row.scene;
  const SweptGround* ground = nullptr;
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    if (sweeps[i].role == SweepRole::ground)
      ground = &sweeps[i].grounds[static_cast<std::size_t>(row.values[i])];
  DeclaredParameters declared{scene_parameters, {}};
  if (ground != nullptr) {
    scene.ground = GroundPlan{ground->file, {}};
    declared.ground = ground->parameters;
  }
  const auto give = [&](const std::string& name, const std::string& text) {
    scene.give(declared, name, text);
  };
  for (const auto* some : {&fixes, &subjects[static_cast<std::size_t>(row.subject)].fixes})
    for (const Assignment& fix : *some) give(fix.parameter, fix.text);
  const std::string engine = world_word(row, "engine");
  const bool ours = row.under_ours || engine.empty() || engine == "dts";
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const SweepPlan& sweep = sweeps[i];
    const std::string& parameter = sweep.column.name;
    const std::string& text = sweep.texts[static_cast<std::size_t>(row.values[i])];
    if (sweep.role == SweepRole::parameter || sweep.role == SweepRole::seeds) give(parameter, text);
    if (sweep.role == SweepRole::cases)
      for (const Assignment& set : sweep.settings[static_cast<std::size_t>(row.values[i])])
        give(set.parameter, set.text);
    if (sweep.role == SweepRole::seeds) scene.set_world(parameter, text);
  }
  Composition swept;
  for (const CompositionWord& word : composition_words) {
    // A peer has a contact and an integrator of its own, and we have no settings.
    const std::string field = word.field;
    const bool meant = field == "engine" ? !row.under_ours : ours != (field == "settings");
    if (meant && varies(field)) swept.*word.member = world_word(row, field);
  }
  scene.set_world(swept);
  for (const simulation::MatchedMaterial& material : row.matched)
    for (const simulation::MatchedConstant& constant : material.constants)
      scene.set_world(material.name + "." + constant.name, fmt::format("{}", constant.chosen));
  return scene;
}

language::Position StudyPlan::place_in_study(const language::Position& position, const RowPlan& row,
                                             const std::string& world) const {
  if (position.file == nullptr) return position;
  const auto is_of = [&](const std::string& trail) {
    return position.file->path == "<--set " + trail + ">";
  };
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const auto value = static_cast<std::size_t>(row.values[i]);
    const SweepPlan& sweep = sweeps[i];
    const std::string prefix = sweep.role == SweepRole::world_field ? world + "." : "";
    const bool given =
        sweep.role == SweepRole::cases
            ? std::ranges::any_of(sweep.settings[value], is_of, &Assignment::parameter)
            : is_of(prefix + sweep.column.name);
    if (given) return sweep.places[value];
  }
  return position;
}

std::shared_ptr<const TracePlan> StudyPlan::measured_in(const RowPlan& row,
                                                        const std::string& trace) const {
  const auto found = std::ranges::find(curves, trace, &MeasuredCurves::name);
  const auto one = row.values[static_cast<std::size_t>(case_sweep())];
  return found->cases[static_cast<std::size_t>(one)];
}

double StudyPlan::duration_of(const RowPlan& row, double deltat) const {
  const int sweep = case_sweep();
  if (sweep < 0 || sweeps[static_cast<std::size_t>(sweep)].durations.empty()) return duration;
  const auto index = static_cast<std::size_t>(sweep);
  const double last = sweeps[index].durations[static_cast<std::size_t>(row.values[index])];
  // Times are multiples of the step, rounded: a sample at a step is of that step.
  return std::ceil(last / deltat - 1e-9) * deltat;
}

bool StudyPlan::varies(const std::string& world_field) const {
  return std::ranges::any_of(sweeps, [&](const SweepPlan& sweep) {
    return sweep.role == SweepRole::world_field &&
           (sweep.column.name == world_field || sweep.column.name == "engine");
  });
}

std::string StudyPlan::world_word(const RowPlan& row, const std::string& field) const {
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    if (sweeps[i].role == SweepRole::world_field && sweeps[i].column.name == field)
      return sweeps[i].column.words[static_cast<std::size_t>(row.values[i])];
  const auto word = std::ranges::find(composition_words, field, &CompositionWord::field);
  return subjects[static_cast<std::size_t>(row.subject)].*word->member;
}

std::vector<std::string> StudyPlan::settings_of(const RowPlan& row) const {
  const ScenePlan scene = scene_of(row);
  std::vector<std::string> words = setting_words(scene.options);
  if (scene.timed) words.push_back(fmt::format("{}.duration={} s", scene.world, row.duration));
  return words;
}

simulation::Experiment StudyPlan::experiment_of(const RowPlan& row) const {
  Diagnostics unreported;
  auto loaded = load_scene(*library, scene_of(row), unreported);
  const bool same = loaded && (!row.refusal.empty() || loaded->hash() == row.hash);
  if (!same)
    throw ChangedInput(name_of(row) +
                       ": its scene, or a file that it reads, was changed after the study had "
                       "been planned; start it again with --resume");
  loaded->experiment.duration = row.duration;
  return std::move(loaded->experiment);
}

std::filesystem::path folder_of(const std::string& name, const std::string& hash) {
  constexpr std::size_t digits = 12;
  return std::filesystem::path("runs") / (name + "-" + hash.substr(0, digits));
}

namespace {

/// Why the body that a study asks for is none that moves; "" where it does not ask.
std::string why_not_measured(const simulation::Experiment& experiment, const std::string& body) {
  if (body.empty()) return "";
  try {
    measured_body(experiment, body);
  } catch (const simulation::ExperimentError& error) {
    return error.what();
  }
  return "";
}

/// Advances the innermost sweep first; false after the last combination.
bool next_combination(const std::vector<SweepPlan>& sweeps, std::vector<int>& values) {
  for (std::size_t i = sweeps.size(); i-- > 0;) {
    if (++values[i] < static_cast<int>(sweeps[i].si.size())) return true;
    values[i] = 0;
  }
  return false;
}

/// The rows of a Study: one scene under all values and subjects. The same warning in many rows is
/// reported once.
class StudyPlanner : public RowPlanner {
 public:
  /// `plan` has all but its rows.
  StudyPlanner(StudyPlan& plan, const Object& study, std::filesystem::path scene,
               const EngineTable& engines, const PlanOptions& options, Diagnostics& diagnostics)
      : RowPlanner(plan, engines, options.jobs, diagnostics),
        study_(study),
        library_(*plan.library),
        scene_(std::move(scene)),
        options_(options) {}

  /// All of them; false after an error.
  bool run() {
    plan_.rows.reserve(static_cast<std::size_t>(plan_.most_rows()));
    std::vector<int> values(plan_.sweeps.size(), 0);
    do {
      for (std::size_t i = 0; i < plan_.subjects.size(); ++i) {
        const SubjectPlan& subject = plan_.subjects[i];
        if (!options_.only.empty() && !language::contains(options_.only, subject.info.name))
          continue;
        RowPlan row;
        row.values = values;
        row.subject = static_cast<int>(i);
        if (!plan_.covers(subject.only, row)) continue;
        if (!prepare(row) || !add(std::move(row))) return false;
      }
    } while (next_combination(plan_.sweeps, values));
    return finish();
  }

 private:
  /// Sets the scene of `row`; false after an error.
  bool prepare(RowPlan& row) {
    static const auto bare = std::make_shared<const ScenePlan>();
    row.scene = bare;
    language::EvaluateOptions options{plan_.scene_of(row).options.parameters, {}};
    if (!find_world(row, options)) return false;
    for (const language::Override& setting : taken_) {
      if (const auto problem = problem_of(setting, planned_subject(row))) {
        diagnostics_.error(study_.position, *problem);
        return false;
      }
    }
    if (const language::Override* decided = decided_by_study(options.parameters)) {
      diagnostics_.error(study_.position, decided_already(*decided));
      return false;
    }
    row.scene = scenes_of(row.subject).whole;
    return true;
  }

  LoadedRow load(const RowPlan& row) const override {
    LoadedRow loaded;
    auto scene = load_scene(library_, plan_.scene_of(row), loaded.found);
    if (scene && plan_.match) match(row, scene, loaded);
    if (scene) {
      simulation::Experiment& experiment = scene->experiment;
      experiment.duration = plan_.duration_of(row, experiment.deltat);
      loaded.no_body = why_not_measured(experiment, plan_.body);
      if (!stepped_.contains(
              {planned_subject(row).info.name, experiment.contact, experiment.deltat}))
        loaded.warning = simulation::step_warning(experiment);
      loaded.forms = row_forms(plan_, row, *scene->tree, experiment);
      take(*scene, loaded);
      if (plan_.rows.empty()) loaded.printed = scene->printed();
      return loaded;
    }
    const std::string engine = plan_.world_word(row, "engine");
    if (engine.empty() || engine == "dts") return loaded;
    RowPlan ours = row;
    ours.under_ours = true;
    ours.scene = scenes_.at(row.subject).under_ours;
    Diagnostics unreported;
    scene = load_scene(library_, plan_.scene_of(ours), unreported);
    if (!scene) return loaded;
    loaded.refusal = loaded.found.first_error();
    simulation::Experiment& experiment = scene->experiment;
    experiment.duration = plan_.duration_of(row, experiment.deltat);
    experiment.engine = engine;
    experiment.settings = plan_.world_word(row, "settings");
    take(*scene, loaded);
    loaded.printed = scene->printed();
    loaded.hash = simulation::experiment_hash(loaded.printed + engine + loaded.refusal, experiment);
    return loaded;
  }

  Answer accept(LoadedRow& loaded, RowPlan& row) override {
    if (!loaded.loads || loaded.refusal.empty()) forward(loaded.found, row);
    if (!loaded.loads) return Answer::error;
    if (!loaded.no_match.empty())
      return wrong(study_block(study_).match.position(), loaded.no_match);
    if (!loaded.no_body.empty()) return wrong(study_block(study_).body->position, loaded.no_body);
    row.matched = std::move(loaded.matched);
    row.under_ours = !loaded.refusal.empty();
    if (row.under_ours) row.scene = scenes_.at(row.subject).under_ours;
    row.refusal = std::move(loaded.refusal);
    row.deltat = loaded.deltat;
    row.duration = loaded.duration;
    if (!check_length(row)) return Answer::error;
    row.forms = std::move(loaded.forms);
    row.forms.resize(plan_.user_metrics.size());
    const std::string& subject = planned_subject(row).info.name;
    if (loaded.warning && stepped_.insert({subject, loaded.contact, loaded.deltat}).second)
      warn_of_step(study_.position, subject, row, *loaded.warning);
    return Answer::taken;
  }

  Answer wrong(const language::Position& place, const std::string& problem) {
    diagnostics_.error(place, problem);
    return Answer::error;
  }

  /// Reports a row that is too long to be counted in steps, where its length is said.
  bool check_length(const RowPlan& row) {
    std::string problem = simulation::step_count_problem(row.duration, row.deltat);
    if (problem.empty()) problem = simulation::no_step_problem(row.duration, row.deltat);
    if (problem.empty()) return true;
    const int cases = plan_.case_sweep();
    if (cases >= 0 && !plan_.sweeps[static_cast<std::size_t>(cases)].durations.empty()) {
      const SweepPlan& sweep = plan_.sweeps[static_cast<std::size_t>(cases)];
      const auto place = static_cast<std::size_t>(row.values[static_cast<std::size_t>(cases)]);
      diagnostics_.error(sweep.places[place],
                         fmt::format("{} {} was measured until then: {}", sweep.column.name,
                                     sweep.texts[place], problem));
    } else {
      diagnostics_.error(study_block(study_).said_duration(plan_.quick).position(), problem);
    }
    diagnostics_.note(study_.position, "in study " + study_.name + " " + place_of(row));
    return false;
  }

  /// Gives the row of our engine hookpoint's ground; a peer has its own.
  void match(const RowPlan& row, std::optional<LoadedScene>& scene, LoadedRow& loaded) const {
    if (scene->experiment.engine != "dts") return;
    try {
      loaded.matched = simulation::matched_to_hookpoint(scene->experiment);
    } catch (const simulation::ExperimentError& error) {
      loaded.no_match = error.what();
      return;
    }
    RowPlan matched = row;
    matched.matched = loaded.matched;
    Diagnostics found;
    scene = load_scene(library_, plan_.scene_of(matched), found);
    if (!scene) loaded.found = std::move(found);
  }

  /// "with subject = ours, slope = 10 deg"
  std::string place_of(const RowPlan& row) const {
    std::string where = "with subject = " + planned_subject(row).info.name;
    for (std::size_t i = 0; i < plan_.sweeps.size(); ++i)
      where += fmt::format(", {} = {}", plan_.sweeps[i].column.name,
                           plan_.sweeps[i].texts[static_cast<std::size_t>(row.values[i])]);
    return where;
  }

  /// What a subject's rows share: as it says, and without its engine.
  struct SubjectScenes {
    std::shared_ptr<const ScenePlan> whole, under_ours;
  };
  const SubjectScenes& scenes_of(int index) {
    const SubjectPlan& subject = plan_.subjects[static_cast<std::size_t>(index)];
    SubjectScenes& scenes = scenes_[index];
    if (scenes.whole) return scenes;
    ScenePlan scene{scene_, {}, world_, true};
    scene.options.overrides = taken_;
    Composition said;
    for (const CompositionWord& word : composition_words)
      if (!plan_.varies(word.field)) said.*word.member = subject.*word.member;
    scene.set_world({"", said.contact, said.integrator, ""});
    scenes.under_ours = std::make_shared<const ScenePlan>(scene);
    scene.set_world({said.engine, "", "", said.settings});
    scenes.whole = std::make_shared<const ScenePlan>(std::move(scene));
    return scenes;
  }

  static bool of_world(const SweepPlan& sweep) {
    return sweep.role == SweepRole::world_field || sweep.role == SweepRole::seeds;
  }

  std::optional<std::string> problem_of(const language::Override& setting,
                                        const SubjectPlan& subject) const {
    for (const SweepPlan& sweep : plan_.sweeps) {
      if (sweep.assigns(setting.trail))
        return fmt::format("`{}` is set by the cases of {}: it cannot be set as well",
                           setting.trail, sweep.column.name);
      if (sweep.role == SweepRole::cases) continue;
      if (setting.trail == sweep.column.name ||
          (of_world(sweep) && setting.trail == world_ + "." + sweep.column.name))
        return fmt::format("`{}` is swept: it cannot be set as well", setting.trail);
    }
    if (setting.trail == world_ + ".duration")
      return fmt::format("a run lasts as long as its study says: set `{}.duration`", plan_.name);
    return setting_problem(setting, world_, subject);
  }

  /// A field that is set from outside although its value in the scene follows from a Param that the
  /// study sets; null for none.
  const language::Override* decided_by_study(const std::map<std::string, std::string>& values) {
    if (std::ranges::all_of(taken_, [this](const auto& set) { return is_parameter(set); }) ||
        !compared_.insert(values).second)
      return nullptr;
    Diagnostics unreported;
    if (plain_ == nullptr) plain_ = library_.evaluate(scene_, with_parameters({}), unreported);
    auto tree = library_.evaluate(scene_, with_parameters(values), unreported);
    // What is wrong with it is told when the row is loaded.
    if (tree == nullptr) return nullptr;
    if (plain_ != nullptr) return changed_setting(taken_, *plain_, *tree);
    // The scene has a Param without a value: the first row is what others are compared with.
    plain_ = std::move(tree);
    return nullptr;
  }

  /// The scene's Params: `values`, then those that are set from outside. Fields that are set from
  /// outside are left out.
  language::EvaluateOptions with_parameters(
      const std::map<std::string, std::string>& values) const {
    language::EvaluateOptions options{values, {}};
    std::ranges::copy_if(
        taken_, std::back_inserter(options.overrides),
        [this](const language::Override& setting) { return is_parameter(setting); });
    return options;
  }

  bool is_parameter(const language::Override& setting) const {
    return language::contains(plan_.scene_parameters, setting.trail);
  }

  /// The trail of the scene's World, once.
  bool find_world(const RowPlan& row, const language::EvaluateOptions& options) {
    if (!world_.empty()) return true;
    Diagnostics found;
    const auto tree = library_.evaluate(scene_, options, found);
    if (!tree) {
      forward(found, row);
      return false;
    }
    const auto worlds = tree->children_of("World");
    if (worlds.empty()) {
      diagnostics_.error(tree->position, "the study's scene has no World");
      return false;
    }
    world_ = worlds.front()->trail();
    taken_ = settings_of_scene(options_.settings, plan_.scene_parameters, *tree, world_);
    plan_.settable = plan_.scene_parameters;
    for (const auto& child : tree->children) plan_.settable.push_back(child->name);
    return true;
  }

  void forward(const Diagnostics& found, const RowPlan& row) {
    for (const language::Diagnostic& diagnostic : found.all()) {
      if (!told_.insert(diagnostic.message).second) continue;
      const language::Position position = plan_.place_in_study(diagnostic.position, row, world_);
      diagnostics_.report_again(diagnostic, position);
      if (diagnostic.severity != language::Severity::note)
        diagnostics_.note(study_.position, "in study " + study_.name + " " + place_of(row));
    }
  }

  /// What is warned of once: a subject's law and step.
  using Step = std::tuple<std::string, std::string, double>;

  const Object& study_;
  language::Library& library_;
  std::filesystem::path scene_;
  const PlanOptions& options_;
  std::string world_;
  std::vector<language::Override> taken_;  ///< the settings that the scene takes
  std::map<int, SubjectScenes> scenes_;
  std::unique_ptr<Object> plain_;                          ///< the scene without them
  std::set<std::map<std::string, std::string>> compared_;  ///< Params of rows compared with it
  std::set<std::string> told_;
  std::set<Step> stepped_;
};

/// Adds all that was measured to what the study's hash is of, and the files to what it read.
void add_measured(const StudyPlan& plan, output::Hash& hash, std::set<std::string>& inputs) {
  for (const std::filesystem::path& file : plan.measured_files)
    inputs.insert(std::filesystem::absolute(file).lexically_normal().string());
  for (const MeasuredCurves& curves : plan.curves)
    for (const auto& one : curves.cases) hash.add(trace_hash(*one));
}

}  // namespace

std::optional<StudyPlan> make_plan(const Object& root, const Object& study, const std::string& file,
                                   language::Library& library, const EngineTable& engines,
                                   const PlanOptions& options, Diagnostics& diagnostics) {
  StudyPlan plan;
  plan.file = file;
  plan.library = &library;
  plan.quick = options.quick;
  plan.only = options.only;
  const std::filesystem::path scene = load_study(study, plan, diagnostics);
  if (scene.empty()) return std::nullopt;
  plan.scene_parameters = parameter_names(library, scene, diagnostics);
  plan_parts(plan, study, scene, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  plan.printed = language::print(root);
  StudyPlanner planner(plan, study, scene, engines, options, diagnostics);
  planner.hash.add(plan.printed)
      .add(fmt::format("{} {} {} {}", plan.name, language::join(options.only, ","), plan.settle,
                       plan.duration));
  if (!planner.run()) return std::nullopt;
  add_measured(plan, planner.hash, planner.inputs);
  planner.complete(root);
  if (plan.rows.empty()) {
    diagnostics.error(study.position,
                      "the study has no run: no Subject, or none that its Only blocks allow");
    return std::nullopt;
  }
  return plan;
}

}  // namespace hookpoint::studies
