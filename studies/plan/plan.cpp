// Study object -> plan: names, units and values are checked here, and every row's scene is loaded.
#include "studies/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "contact/force_law.h"
#include "language/names.h"
#include "output/text/hash.h"
#include "simulation/analysis/step_warning.h"
#include "simulation/identity.h"
#include "simulation/step_count.h"
#include "studies/measured_body.h"
#include "studies/plan/plan_parts.h"
#include "studies/plan/row_forms.h"
#include "studies/plan/scene_settings.h"
#include "studies/plan/told_elsewhere.h"
#include "studies/workers.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

bool Condition::holds(double value) const {
  const double slack = 1e-9 * std::abs(value);
  if (from && value < *from - slack) return false;
  if (to && value > *to + slack) return false;
  if (!values) return true;
  return std::any_of(values->begin(), values->end(),
                     [&](double allowed) { return std::abs(allowed - value) <= slack; });
}

std::string SweepPlan::values_near(std::optional<double> value) const {
  constexpr std::size_t most = 10, nearest = 3;
  if (declared.size() <= most || !value || !declared_words.empty())
    return language::join(declared_texts, ", ");
  std::vector<std::size_t> order(declared.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {},
                           [&](std::size_t i) { return std::abs(declared[i] - *value); });
  order.resize(nearest);
  std::ranges::sort(order);
  std::vector<std::string> texts;
  for (const std::size_t i : order) texts.push_back(declared_texts[i]);
  return fmt::format("{} values, of which the nearest are {}", declared.size(),
                     language::join(texts, ", "));
}

bool SweepPlan::assigns(const std::string& parameter) const {
  return !settings.empty() && std::ranges::find(settings.front(), parameter,
                                                &Assignment::parameter) != settings.front().end();
}

bool StudyPlan::covers(const std::vector<Condition>& conditions, const RowPlan& row) const {
  return std::all_of(conditions.begin(), conditions.end(), [&](const Condition& condition) {
    const auto sweep = static_cast<std::size_t>(condition.sweep);
    return condition.holds(sweeps[sweep].si[static_cast<std::size_t>(row.values[sweep])]);
  });
}

SweepValues StudyPlan::admitted(const std::vector<Condition>& conditions) const {
  SweepValues values;
  for (const Condition& condition : conditions) {
    const SweepPlan& sweep = sweeps[static_cast<std::size_t>(condition.sweep)];
    std::vector<double> held;
    for (std::size_t i = 0; i < sweep.si.size(); ++i)
      if (condition.holds(sweep.si[i])) held.push_back(sweep.column.values[i]);
    values.emplace_back(sweep.column.name, std::move(held));
  }
  return values;
}

bool StudyPlan::measures(MetricScope scope) const {
  return std::ranges::any_of(
      metrics, [&](const MetricDefinition* metric) { return metric->scope == scope; });
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

std::filesystem::path StudyPlan::folder() const { return folder_of(name, hash); }

std::string StudyPlan::name_of(const RowPlan& row) const {
  std::string text = name + " (" + subjects[static_cast<std::size_t>(row.subject)].info.name;
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    text += ", " + sweeps[i].column.name + " = " +
            sweeps[i].texts[static_cast<std::size_t>(row.values[i])];
  return text + ")";
}

namespace {

bool names_it(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// Gives Params to a scene and to the ground that is laid into it, as far as they declare them.
class ParameterGiver {
 public:
  ParameterGiver(RowScene& scene, const std::vector<std::string>& declared,
                 const SweptGround* ground)
      : scene_(scene), declared_(declared), ground_(ground) {
    if (ground_ != nullptr) scene_.ground = RowGround{ground_->file, {}};
  }
  void give(const std::string& name, const std::string& text) {
    if (names_it(declared_, name)) scene_.options.parameters[name] = text;
    if (ground_ != nullptr && names_it(ground_->parameters, name))
      scene_.ground->parameters[name] = text;
  }

 private:
  RowScene& scene_;
  const std::vector<std::string>& declared_;
  const SweptGround* ground_;
};

}  // namespace

namespace {

void set_matched(RowScene& scene, const std::vector<simulation::MatchedMaterial>& materials) {
  for (const simulation::MatchedMaterial& material : materials)
    for (const simulation::MatchedConstant& constant : material.constants)
      scene.options.overrides.push_back(
          {fmt::format("{}.{}.{}", scene.timed_world, material.name, constant.name),
           fmt::format("{}", constant.chosen)});
}

}  // namespace

RowScene StudyPlan::scene_of(const RowPlan& row) const {
  RowScene scene = *row.scene;
  const SweptGround* ground = nullptr;
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    if (sweeps[i].role == SweepRole::ground)
      ground = &sweeps[i].grounds[static_cast<std::size_t>(row.values[i])];
  ParameterGiver parameters(scene, scene_parameters, ground);
  for (const auto* some : {&fixes, &subjects[static_cast<std::size_t>(row.subject)].fixes})
    for (const Assignment& fix : *some) parameters.give(fix.parameter, fix.text);
  const std::string engine = world_word(row, "engine");
  const bool ours = row.under_ours || engine.empty() || engine == "dts";
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const SweepPlan& sweep = sweeps[i];
    const std::string& parameter = sweep.column.name;
    const std::string& text = sweep.texts[static_cast<std::size_t>(row.values[i])];
    if (sweep.role == SweepRole::parameter || sweep.role == SweepRole::seeds)
      parameters.give(parameter, text);
    if (sweep.role == SweepRole::cases)
      for (const Assignment& set : sweep.settings[static_cast<std::size_t>(row.values[i])])
        parameters.give(set.parameter, set.text);
    if (sweep.role == SweepRole::seeds)
      scene.options.overrides.push_back({scene.timed_world + "." + parameter, text});
  }
  for (const std::string field : {"engine", "contact", "integrator", "settings"}) {
    // A peer has a contact and an integrator of its own, and we have no settings.
    const bool meant = field == "engine" ? !row.under_ours : ours != (field == "settings");
    const std::string word = world_word(row, field);
    if (meant && varies(field) && !word.empty())
      scene.options.overrides.push_back({scene.timed_world + "." + field, word});
  }
  set_matched(scene, row.matched);
  return scene;
}

int StudyPlan::seed_sweep() const {
  const bool has_seeds = !sweeps.empty() && sweeps.back().role == SweepRole::seeds;
  return has_seeds ? static_cast<int>(sweeps.size()) - 1 : -1;
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

int StudyPlan::case_sweep() const {
  const auto found = std::ranges::find(sweeps, SweepRole::cases, &SweepPlan::role);
  return found == sweeps.end() ? -1 : static_cast<int>(found - sweeps.begin());
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
  const SubjectPlan& subject = subjects[static_cast<std::size_t>(row.subject)];
  return field == "engine"       ? subject.engine
         : field == "contact"    ? subject.contact
         : field == "integrator" ? subject.integrator
                                 : subject.settings;
}

std::vector<std::string> StudyPlan::settings_of(const RowPlan& row) const {
  const RowScene scene = scene_of(row);
  std::vector<std::string> words = setting_words(scene.options);
  if (!scene.timed_world.empty())
    words.push_back(fmt::format("{}.duration={} s", scene.timed_world, row.duration));
  return words;
}

simulation::Experiment StudyPlan::experiment_of(const RowPlan& row) const {
  Diagnostics untold;
  auto loaded = load_scene(*library, scene_of(row), untold);
  const bool same =
      loaded && (!row.refusal.empty() ||
                 simulation::experiment_hash(loaded->printed, loaded->experiment) == row.hash);
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

/// A row's scene as it was loaded, and what there is to say about it.
struct LoadedRow {
  std::optional<LoadedScene> scene;
  Diagnostics found;
  std::string refusal;  ///< why its engine cannot run it; "": it can
  std::vector<RowForm> forms;
  std::optional<std::string> warning;  ///< of its step
  std::string no_body;                 ///< why the body that is asked for cannot be measured
  std::string no_match;                ///< why its ground cannot be hookpoint's
  std::vector<simulation::MatchedMaterial> matched;
};

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

/// Evaluates and loads the scene of each row, in three parts: `prepare` and `accept` one row after
/// the other, `load` from any thread. The same warning in many rows is told once.
class SceneLoader {
 public:
  SceneLoader(language::Library& library, std::filesystem::path scene, Diagnostics& diagnostics)
      : library_(library), scene_(std::move(scene)), diagnostics_(diagnostics) {}

  /// Sets the scene of `row`; false after an error.
  bool prepare(const StudyPlan& plan, const Object& study, RowPlan& row) {
    const SubjectPlan& subject = plan.subjects[static_cast<std::size_t>(row.subject)];
    static const auto bare = std::make_shared<const RowScene>();
    row.scene = bare;
    language::EvaluateOptions options{plan.scene_of(row).options.parameters, {}};
    if (!find_world(plan, study, row, options)) return false;
    for (const language::Override& setting : taken_) {
      if (const auto problem = problem_of(setting, plan, subject)) {
        diagnostics_.error(study.position, *problem);
        return false;
      }
    }
    if (const language::Override* decided = decided_by_study(options.parameters)) {
      diagnostics_.error(study.position, decided_already(*decided));
      return false;
    }
    row.scene = scenes_of(plan, row.subject).whole;
    return true;
  }

  LoadedRow load(const StudyPlan& plan, const RowPlan& row) const {
    const SubjectPlan& subject = plan.subjects[static_cast<std::size_t>(row.subject)];
    LoadedRow loaded;
    loaded.scene = load_scene(library_, plan.scene_of(row), loaded.found);
    if (loaded.scene && plan.match) match(plan, row, loaded);
    if (loaded.scene) {
      simulation::Experiment& experiment = loaded.scene->experiment;
      experiment.duration = plan.duration_of(row, experiment.deltat);
      loaded.no_body = why_not_measured(experiment, plan.body);
      if (!stepped_.contains(step_of(subject, experiment)))
        loaded.warning = simulation::step_warning(experiment);
      loaded.forms = row_forms(plan, row, *loaded.scene->tree, experiment);
      return loaded;
    }
    const std::string engine = plan.world_word(row, "engine");
    if (engine.empty() || engine == "dts") return loaded;
    RowPlan ours = row;
    ours.under_ours = true;
    ours.scene = scenes_.at(row.subject).under_ours;
    Diagnostics untold;
    loaded.scene = load_scene(library_, plan.scene_of(ours), untold);
    if (!loaded.scene) return loaded;
    loaded.refusal = first_error(loaded.found);
    loaded.scene->experiment.duration = plan.duration_of(row, loaded.scene->experiment.deltat);
    loaded.scene->experiment.engine = engine;
    loaded.scene->experiment.settings = plan.world_word(row, "settings");
    loaded.scene->printed += engine + loaded.refusal;
    return loaded;
  }

  /// Tells what there is to say and completes the row; false after an error.
  bool accept(StudyPlan& plan, const Object& study, const LoadedRow& loaded, RowPlan& row) {
    if (!loaded.scene || loaded.refusal.empty()) forward(loaded.found, plan, study, row);
    if (!loaded.scene) return false;
    if (!loaded.no_match.empty()) {
      diagnostics_.error(study.find("match")->position, loaded.no_match);
      return false;
    }
    row.matched = loaded.matched;
    if (!loaded.no_body.empty()) {
      diagnostics_.error(study.find("body")->position, loaded.no_body);
      return false;
    }
    row.under_ours = !loaded.refusal.empty();
    if (row.under_ours) row.scene = scenes_.at(row.subject).under_ours;
    row.refusal = loaded.refusal;
    row.engine = loaded.scene->experiment.engine;
    row.deltat = loaded.scene->experiment.deltat;
    row.duration = loaded.scene->experiment.duration;
    if (!check_length(plan, study, row)) return false;
    row.forms = loaded.forms;
    row.forms.resize(plan.user_metrics.size());
    if (loaded.warning) warn_of_step(plan, study, row, loaded.scene->experiment, *loaded.warning);
    return true;
  }

  SceneSettings settings;               ///< from outside
  std::vector<std::string> parameters;  ///< the scene's
  std::vector<std::string> settable;    ///< names at the scene's top

 private:
  /// Reports a row that is too long to be counted in steps, where its length is said.
  bool check_length(const StudyPlan& plan, const Object& study, const RowPlan& row) {
    const std::string problem = simulation::step_count_problem(row.duration, row.deltat);
    if (problem.empty()) return true;
    const int cases = plan.case_sweep();
    if (cases >= 0 && !plan.sweeps[static_cast<std::size_t>(cases)].durations.empty()) {
      const SweepPlan& sweep = plan.sweeps[static_cast<std::size_t>(cases)];
      const auto place = static_cast<std::size_t>(row.values[static_cast<std::size_t>(cases)]);
      diagnostics_.error(sweep.places[place],
                         fmt::format("{} {} was measured until then: {}", sweep.column.name,
                                     sweep.texts[place], problem));
    } else {
      const bool quick = plan.quick && study.given("quick_duration");
      diagnostics_.error(study.find(quick ? "quick_duration" : "duration")->position, problem);
    }
    diagnostics_.note(study.position, "in study " + study.name + " " + place_of(plan, row));
    return false;
  }

  /// Gives the row of our engine hookpoint's ground; a peer has its own.
  void match(const StudyPlan& plan, const RowPlan& row, LoadedRow& loaded) const {
    if (loaded.scene->experiment.engine != "dts") return;
    try {
      loaded.matched = simulation::matched_to_hookpoint(loaded.scene->experiment);
    } catch (const simulation::ExperimentError& error) {
      loaded.no_match = error.what();
      return;
    }
    RowPlan matched = row;
    matched.matched = loaded.matched;
    Diagnostics found;
    loaded.scene = load_scene(library_, plan.scene_of(matched), found);
    if (!loaded.scene) loaded.found = std::move(found);
  }

  /// Warns of a step above the stability bound, once for each subject and step.
  void warn_of_step(StudyPlan& plan, const Object& study, const RowPlan& row,
                    const simulation::Experiment& experiment, const std::string& what) {
    const SubjectPlan& planned = plan.subjects[static_cast<std::size_t>(row.subject)];
    const std::string& subject = planned.info.name;
    if (!stepped_.insert(step_of(planned, experiment)).second) return;
    diagnostics_.warning(study.position, what);
    diagnostics_.note(study.position, "with subject = " + subject);
    plan.warnings.push_back(subject + ": " + what);
  }

  /// What is warned of once: a subject's law and step.
  using Step = std::tuple<std::string, std::string, double>;
  static Step step_of(const SubjectPlan& subject, const simulation::Experiment& experiment) {
    return {subject.info.name, experiment.contact, experiment.deltat};
  }

  /// "with subject = ours, slope = 10 deg"
  static std::string place_of(const StudyPlan& plan, const RowPlan& row) {
    std::string where =
        "with subject = " + plan.subjects[static_cast<std::size_t>(row.subject)].info.name;
    for (std::size_t i = 0; i < plan.sweeps.size(); ++i)
      where += fmt::format(", {} = {}", plan.sweeps[i].column.name,
                           plan.sweeps[i].texts[static_cast<std::size_t>(row.values[i])]);
    return where;
  }

  /// What a subject's rows share: as it says, and without its engine.
  struct SubjectScenes {
    std::shared_ptr<const RowScene> whole, under_ours;
  };
  const SubjectScenes& scenes_of(const StudyPlan& plan, int index) {
    const SubjectPlan& subject = plan.subjects[static_cast<std::size_t>(index)];
    SubjectScenes& scenes = scenes_[index];
    if (scenes.whole) return scenes;
    RowScene scene{scene_, {}, world_};
    scene.options.overrides = taken_;
    const auto set = [&](const char* field, const std::string& value) {
      if (!value.empty() && !plan.varies(field))
        scene.options.overrides.push_back({world_ + "." + field, value});
    };
    set("contact", subject.contact);
    set("integrator", subject.integrator);
    scenes.under_ours = std::make_shared<const RowScene>(scene);
    set("engine", subject.engine);
    set("settings", subject.settings);
    scenes.whole = std::make_shared<const RowScene>(std::move(scene));
    return scenes;
  }

  static bool of_world(const SweepPlan& sweep) {
    return sweep.role == SweepRole::world_field || sweep.role == SweepRole::seeds;
  }

  static std::string first_error(const Diagnostics& found) {
    for (const language::Diagnostic& diagnostic : found.all())
      if (diagnostic.severity == language::Severity::error) return diagnostic.message;
    return "";
  }

  std::optional<std::string> problem_of(const language::Override& setting, const StudyPlan& plan,
                                        const SubjectPlan& subject) const {
    for (const SweepPlan& sweep : plan.sweeps) {
      if (sweep.assigns(setting.trail))
        return fmt::format("`{}` is set by the cases of {}: it cannot be set as well",
                           setting.trail, sweep.column.name);
      if (sweep.role == SweepRole::cases) continue;
      if (setting.trail == sweep.column.name ||
          (of_world(sweep) && setting.trail == world_ + "." + sweep.column.name))
        return fmt::format("`{}` is swept: it cannot be set as well", setting.trail);
    }
    if (setting.trail == world_ + ".duration")
      return fmt::format("a run lasts as long as its study says: set `{}.duration`", plan.name);
    return setting_problem(setting, world_, subject);
  }

  /// A field that is set from outside although its value in the scene follows from a Param that the
  /// study sets; null for none.
  const language::Override* decided_by_study(const std::map<std::string, std::string>& values) {
    if (std::ranges::all_of(taken_, [this](const auto& set) { return is_parameter(set); }) ||
        !compared_.insert(values).second)
      return nullptr;
    Diagnostics untold;
    if (plain_ == nullptr) plain_ = library_.evaluate(scene_, with_parameters({}), untold);
    auto tree = library_.evaluate(scene_, with_parameters(values), untold);
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
    return std::ranges::find(parameters, setting.trail) != parameters.end();
  }

  /// The trail of the scene's World, once.
  bool find_world(const StudyPlan& plan, const Object& study, const RowPlan& row,
                  const language::EvaluateOptions& options) {
    if (!world_.empty()) return true;
    Diagnostics found;
    const auto tree = library_.evaluate(scene_, options, found);
    if (!tree) {
      forward(found, plan, study, row);
      return false;
    }
    const auto worlds = tree->children_of("World");
    if (worlds.empty()) {
      diagnostics_.error(tree->position, "the study's scene has no World");
      return false;
    }
    world_ = worlds.front()->trail();
    taken_ = settings_of_scene(settings, parameters, *tree, world_);
    settable = parameters;
    for (const auto& child : tree->children) settable.push_back(child->name);
    return true;
  }

  void forward(const Diagnostics& found, const StudyPlan& plan, const Object& study,
               const RowPlan& row) {
    for (const language::Diagnostic& diagnostic : found.all()) {
      if (!told_.insert(diagnostic.message).second) continue;
      const language::Position position = plan.place_in_study(diagnostic.position, row, world_);
      tell_at(position, diagnostic, diagnostics_);
      if (diagnostic.severity != language::Severity::note)
        diagnostics_.note(study.position, "in study " + study.name + " " + place_of(plan, row));
    }
  }

  language::Library& library_;
  std::filesystem::path scene_;
  Diagnostics& diagnostics_;
  std::string world_;
  std::vector<language::Override> taken_;  ///< the settings that the scene takes
  std::map<int, SubjectScenes> scenes_;
  std::unique_ptr<Object> plain_;                          ///< the scene without them
  std::set<std::map<std::string, std::string>> compared_;  ///< Params of rows compared with it
  std::set<std::string> told_;
  std::set<Step> stepped_;
};

/// Advances the innermost sweep first; false after the last combination.
bool next_combination(const std::vector<SweepPlan>& sweeps, std::vector<int>& values) {
  for (std::size_t i = sweeps.size(); i-- > 0;) {
    if (++values[i] < static_cast<int>(sweeps[i].si.size())) return true;
    values[i] = 0;
  }
  return false;
}

/// Engine, law, integrator and settings that an experiment has.
SubjectInfo composed(const simulation::Experiment& experiment) {
  SubjectInfo info;
  info.engine = experiment.engine;
  const bool ours = info.engine == "dts";
  info.law = ours ? experiment.contact : "";
  const bool integrated = ours && contact::find_force_law(experiment.contact).has_value();
  info.integrator = integrated ? experiment.integrator : "";
  info.settings = ours ? "" : experiment.settings;
  return info;
}

/// The rows of a plan as they are made, some at a time: so many scenes have room, and so many are
/// worth several threads.
class RowPlanner {
 public:
  RowPlanner(StudyPlan& plan, const Object& study, SceneLoader& loader, int jobs,
             output::Hash& hash)
      : plan_(plan), study_(study), loader_(loader), jobs_(jobs), hash_(hash) {}

  /// False after an error, as from `finish`.
  bool add(RowPlan row) {
    if (!loader_.prepare(plan_, study_, row)) return false;
    waiting_.push_back(std::move(row));
    return waiting_.size() < most_waiting || finish();
  }

  bool finish() {
    std::vector<LoadedRow> loaded(waiting_.size());
    work_through(waiting_.size(), jobs_, [&](std::size_t i) {
      loaded[i] = loader_.load(plan_, waiting_[i]);
      return true;
    });
    for (std::size_t i = 0; i < waiting_.size(); ++i)
      if (!accept(std::move(loaded[i]), std::move(waiting_[i]))) return false;
    waiting_.clear();
    return true;
  }

  std::set<std::string> inputs;

 private:
  static constexpr std::size_t most_waiting = 64;

  bool accept(LoadedRow loaded, RowPlan row) {
    if (!loader_.accept(plan_, study_, loaded, row)) return false;
    LoadedScene& scene = *loaded.scene;
    row.hash = simulation::experiment_hash(scene.printed, scene.experiment);
    hash_.add(row.hash);
    inputs.merge(scene.sources);
    plan_.seeds.insert(scene.experiment.seed);
    if (plan_.rows.empty()) plan_.scene_printed = scene.printed;
    row.composition = composition_index(composed(scene.experiment));
    plan_.rows.push_back(std::move(row));
    return true;
  }

  int composition_index(SubjectInfo made) {
    const auto key = std::make_tuple(made.engine, made.law, made.integrator, made.settings);
    const auto [place, fresh] =
        compositions_.try_emplace(key, static_cast<int>(plan_.compositions.size()));
    if (fresh) plan_.compositions.push_back(std::move(made));
    return place->second;
  }

  StudyPlan& plan_;
  const Object& study_;
  SceneLoader& loader_;
  int jobs_;
  output::Hash& hash_;
  std::vector<RowPlan> waiting_;
  std::map<std::tuple<std::string, std::string, std::string, std::string>, int> compositions_;
};

bool plan_rows(const StudyPlan& plan, const PlanOptions& options, RowPlanner& planner) {
  std::vector<int> values(plan.sweeps.size(), 0);
  do {
    for (std::size_t i = 0; i < plan.subjects.size(); ++i) {
      const SubjectPlan& subject = plan.subjects[i];
      RowPlan row;
      row.values = values;
      row.subject = static_cast<int>(i);
      if (!options.only.empty() && std::find(options.only.begin(), options.only.end(),
                                             subject.info.name) == options.only.end())
        continue;
      if (plan.covers(subject.only, row) && !planner.add(std::move(row))) return false;
    }
  } while (next_combination(plan.sweeps, values));
  return planner.finish();
}

/// Distinct words in their order: "hookpoint or bristle".
void add_word(std::string& words, const std::string& word) {
  if (word.empty() || (" or " + words + " or ").find(" or " + word + " or ") != std::string::npos)
    return;
  words += (words.empty() ? "" : " or ") + word;
}

/// A scene may set engine, law and integrator itself, and so may a Sweep: the table names all that
/// are in force.
void complete_subjects(StudyPlan& plan, const EngineTable& engines) {
  for (SubjectPlan& subject : plan.subjects) {
    subject.info.engine.clear();
    subject.info.available = false;
  }
  for (SubjectInfo& composed : plan.compositions) {
    const auto entry = engines.find(composed.engine);
    composed.available = entry != engines.end() && entry->second.description.found;
  }
  for (const RowPlan& row : plan.rows) {
    const SubjectInfo& composed = plan.compositions[static_cast<std::size_t>(row.composition)];
    SubjectInfo& info = plan.subjects[static_cast<std::size_t>(row.subject)].info;
    for (const auto word : {&SubjectInfo::engine, &SubjectInfo::law, &SubjectInfo::integrator,
                            &SubjectInfo::settings})
      add_word(info.*word, composed.*word);
    info.available |= composed.available;
  }
  // A subject without a row, under `--quick`, lacks nothing.
  for (SubjectPlan& subject : plan.subjects)
    if (subject.info.engine.empty()) subject.info.available = true;
}

void plan_body(StudyPlan& plan, const Object& study, Diagnostics& diagnostics) {
  const language::Field* field = study.find("body");
  if (field == nullptr) return;
  const language::Formula& asked = *field->formula;
  if (asked.names.size() == 1 && asked.text == asked.names.front())
    plan.body = asked.text;
  else
    diagnostics.error(field->position,
                      "`body` is the trail of a robot or of a body of one: arm.leg1.link2");
}

/// Whether each run is as long as its case was measured: then nothing is cut short under --quick.
bool lasts_as_measured(const StudyPlan& plan, const Object& study) {
  return !study.given("duration") && !(plan.quick && study.given("quick_duration"));
}

void plan_times(StudyPlan& plan, const Object& study, Diagnostics& diagnostics) {
  constexpr double quick_part = 0.2;
  const auto quick = [&](const char* field, double full) {
    return study.find(field) != nullptr ? study.number(field) : quick_part * full;
  };
  const bool measured = lasts_as_measured(plan, study);
  plan.settle = study.number("settle");
  if (plan.quick && (!measured || study.given("quick_settle")))
    plan.settle = quick("quick_settle", plan.settle);
  if (measured) return;
  if (study.given("duration")) plan.duration = study.number("duration");
  if (plan.quick) plan.duration = quick("quick_duration", plan.duration);
  if (plan.settle >= plan.duration)
    diagnostics.error(study.find(study.given("duration") ? "duration" : "quick_duration")->position,
                      "duration must be longer than settle: nothing would be measured");
}

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
  plan.name = study.name;
  plan.file = file;
  plan.library = &library;
  plan.quick = options.quick;
  plan.only = options.only;
  if (study.find("title") != nullptr) plan.title = study.word("title");
  if (study.find("question") != nullptr) plan.question = study.word("question");
  plan_body(plan, study, diagnostics);
  plan.match = study.find("match") != nullptr && study.word("match") == "hookpoint";
  plan_times(plan, study, diagnostics);
  const std::filesystem::path scene = library.find(study.word("scene"), file);
  if (scene.empty()) {
    diagnostics.error(study.find("scene")->position,
                      "no file \"" + study.word("scene") + "\" beside the study or in configs/");
    return std::nullopt;
  }
  SceneLoader loader(library, scene, diagnostics);
  for (const language::ParameterDeclaration& parameter : library.parameters(scene, diagnostics))
    plan.scene_parameters.push_back(parameter.name);
  loader.parameters = plan.scene_parameters;
  loader.settings = options.settings;
  plan_parts(plan, study, scene, options, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  plan.printed = language::print(root);
  output::Hash hash;
  hash.add(plan.printed);
  hash.add(fmt::format("{} {} {} {}", plan.name, language::join(options.only, ","), plan.settle,
                       plan.duration));
  RowPlanner planner(plan, study, loader, options.jobs, hash);
  if (!plan_rows(plan, options, planner)) return std::nullopt;
  add_measured(plan, hash, planner.inputs);
  plan.settable = loader.settable;
  plan.hash = hash.text();
  for (std::string& source : language::sources_of(root)) planner.inputs.insert(std::move(source));
  plan.inputs = simulation::hashed(planner.inputs);
  if (plan.rows.empty()) {
    diagnostics.error(study.position,
                      "the study has no run: no Subject, or none that its Only blocks allow");
    return std::nullopt;
  }
  complete_subjects(plan, engines);
  return plan;
}

}  // namespace hookpoint::studies
