// Study object -> plan: names, units and values are checked here, and every row's scene is loaded.
#include "studies/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "contact/force_law.h"
#include "language/names.h"
#include "output/text/hash.h"
#include "simulation/identity.h"
#include "simulation/scene/load.h"
#include "studies/plan/plan_parts.h"
#include "studies/plan/scene_settings.h"
#include "studies/plan/step_warning.h"

namespace hookpoint::studies {

bool Condition::holds(double value) const {
  const double slack = 1e-9 * std::abs(value);
  if (from && value < *from - slack) return false;
  if (to && value > *to + slack) return false;
  if (values.empty()) return true;
  return std::any_of(values.begin(), values.end(),
                     [&](double allowed) { return std::abs(allowed - value) <= slack; });
}

bool StudyPlan::covers(const std::vector<Condition>& conditions, const RowPlan& row) const {
  return std::all_of(conditions.begin(), conditions.end(), [&](const Condition& condition) {
    const auto sweep = static_cast<std::size_t>(condition.sweep);
    return condition.holds(sweeps[sweep].si[static_cast<std::size_t>(row.values[sweep])]);
  });
}

bool StudyPlan::measures(MetricScope scope) const {
  return std::ranges::any_of(
      metrics, [&](const MetricDefinition* metric) { return metric->scope == scope; });
}

std::vector<std::size_t> StudyPlan::rows_along(std::size_t row, int sweep) const {
  std::vector<std::size_t> found;
  std::vector<int> values = rows[row].values;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].subject != rows[row].subject) continue;
    const auto at = static_cast<std::size_t>(sweep);
    if (sweep >= 0) values[at] = rows[i].values[at];
    if (rows[i].values == values) found.push_back(i);
  }
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

std::string StudyPlan::identity_of(const RowPlan& row, const EngineTable& engines) const {
  const auto engine = engines.find(row.experiment.engine);
  const simulation::EngineDescription description =
      engine == engines.end()
          ? simulation::EngineDescription{row.experiment.engine, {}, {}, false, {}}
          : engine->second.description;
  output::Hash identity;
  identity.add(printed).add(name_of(row)).add(fmt::format("{} {}", settle, duration));
  return identity.add(simulation::run_hash(row.hash, description)).text();
}

std::filesystem::path folder_of(const std::string& name, const std::string& hash) {
  constexpr std::size_t digits = 12;
  return std::filesystem::path("runs") / (name + "-" + hash.substr(0, digits));
}

namespace {

/// The grid under the experiment; null of another ground.
simulation::GridSpec* grid_of(simulation::Experiment& experiment) {
  return experiment.terrain ? std::get_if<simulation::GridSpec>(&experiment.terrain->surface)
                            : nullptr;
}

}  // namespace

void SharedHeights::take(RowPlan& row) {
  simulation::GridSpec* grid = grid_of(row.experiment);
  if (grid == nullptr) return;
  const std::string_view bytes(reinterpret_cast<const char*>(grid->heights.data()),
                               grid->heights.size() * sizeof(double));
  RowPlan::Heights& known = known_[output::Hash().add(bytes).text()];
  std::vector<double> heights = std::exchange(grid->heights, std::vector<double>());
  if (known == nullptr) known = std::make_shared<const std::vector<double>>(std::move(heights));
  row.heights = known;
}

simulation::Experiment RowPlan::whole() const {
  simulation::Experiment result = experiment;
  if (heights) grid_of(result)->heights = *heights;
  return result;
}

namespace {

using language::Diagnostics;
using language::Object;

/// Evaluates and loads the scene of each row. The same warning in many rows is told once.
class SceneLoader {
 public:
  SceneLoader(language::Library& library, std::filesystem::path scene, Diagnostics& diagnostics)
      : library_(library), scene_(std::move(scene)), diagnostics_(diagnostics) {}

  /// Fills `row.experiment`; false when the scene cannot be loaded so.
  bool load(const StudyPlan& plan, const Object& study, RowPlan& row, std::string& printed) {
    const SubjectPlan& subject = plan.subjects[static_cast<std::size_t>(row.subject)];
    language::EvaluateOptions options;
    std::string where = "with subject = " + subject.info.name;
    for (const Assignment& fix : fixes) options.parameters[fix.parameter] = fix.text;
    for (const Assignment& fix : subject.fixes) options.parameters[fix.parameter] = fix.text;
    for (std::size_t i = 0; i < plan.sweeps.size(); ++i) {
      const SweepPlan& sweep = plan.sweeps[i];
      const std::string& text = sweep.texts[static_cast<std::size_t>(row.values[i])];
      options.parameters[sweep.column.name] = text;
      where += fmt::format(", {} = {}", sweep.column.name, text);
    }
    if (!find_world(options)) return false;
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
    options.overrides = taken_;
    const auto set = [&](const char* field, const std::string& value) {
      if (!value.empty()) options.overrides.push_back({world_ + "." + field, value});
    };
    set("contact", subject.contact);
    set("integrator", subject.integrator);
    const language::EvaluateOptions ours = options;
    set("engine", subject.engine);
    set("settings", subject.settings);
    row.scene = scene_;
    row.settings = setting_words(options);
    row.settings.push_back(fmt::format("{}.duration={} s", world_, plan.duration));
    Diagnostics found;
    if (evaluate(options, row, printed, found)) {
      forward(found, study, where);
      return true;
    }
    Diagnostics untold;
    const bool peer = !subject.engine.empty() && subject.engine != "dts";
    if (!peer || !evaluate(ours, row, printed, untold)) {
      forward(found, study, where);
      return false;
    }
    row.refusal = first_error(found);
    row.experiment.engine = subject.engine;
    row.experiment.settings = subject.settings;
    printed += subject.engine + row.refusal;
    return true;
  }

  /// Warns of a step above the stability bound, once for each subject and step.
  void warn_of_step(StudyPlan& plan, const Object& study, const RowPlan& row) {
    const std::string& subject = plan.subjects[static_cast<std::size_t>(row.subject)].info.name;
    const std::pair<std::string, double> run{subject, row.experiment.deltat};
    if (stepped_.contains(run)) return;
    const std::optional<std::string> what = step_warning(row.experiment);
    if (!what) return;
    stepped_.insert(run);
    diagnostics_.warning(study.position, *what);
    diagnostics_.note(study.position, "with subject = " + subject);
    plan.warnings.push_back(subject + ": " + *what);
  }

  std::vector<Assignment> fixes;        ///< the study's own
  SceneSettings settings;               ///< from outside
  std::vector<std::string> parameters;  ///< the scene's
  std::vector<std::string> settable;    ///< names at the scene's top
  std::set<std::string> inputs;         ///< files that the rows so far were made from and read

 private:
  /// Fills the row's experiment and its text; false after errors.
  bool evaluate(const language::EvaluateOptions& options, RowPlan& row, std::string& printed,
                Diagnostics& found) {
    const auto tree = library_.evaluate(scene_, options, found);
    std::optional<simulation::Experiment> experiment;
    if (tree) experiment = simulation::load_experiment(*tree, found, library_.search_path());
    if (!experiment || found.has_errors()) return false;
    simulation::write_chosen_step(*experiment, *tree);
    row.experiment = std::move(*experiment);
    inputs.merge(simulation::files_read(row.experiment));
    for (std::string& source : language::sources_of(*tree)) inputs.insert(std::move(source));
    printed = language::print(*tree);
    return true;
  }

  static std::string first_error(const Diagnostics& found) {
    for (const language::Diagnostic& diagnostic : found.all())
      if (diagnostic.severity == language::Severity::error) return diagnostic.message;
    return "";
  }

  std::optional<std::string> problem_of(const language::Override& setting, const StudyPlan& plan,
                                        const SubjectPlan& subject) const {
    for (const SweepPlan& sweep : plan.sweeps)
      if (sweep.column.name == setting.trail)
        return fmt::format("`{}` is swept: it cannot be set as well", setting.trail);
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
  bool find_world(const language::EvaluateOptions& options) {
    if (!world_.empty()) return true;
    const auto tree = library_.evaluate(scene_, options, diagnostics_);
    if (!tree) return false;
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

  void forward(const Diagnostics& found, const Object& study, const std::string& where) {
    for (const language::Diagnostic& diagnostic : found.all()) {
      if (!told_.insert(diagnostic.message).second) continue;
      if (diagnostic.severity == language::Severity::error)
        diagnostics_.error(diagnostic.position, diagnostic.message);
      else if (diagnostic.severity == language::Severity::warning)
        diagnostics_.warning(diagnostic.position, diagnostic.message);
      else
        diagnostics_.note(diagnostic.position, diagnostic.message);
      if (diagnostic.severity != language::Severity::note)
        diagnostics_.note(study.position, "in study " + study.name + " " + where);
    }
  }

  language::Library& library_;
  std::filesystem::path scene_;
  Diagnostics& diagnostics_;
  std::string world_;
  std::vector<language::Override> taken_;                  ///< the settings that the scene takes
  std::unique_ptr<Object> plain_;                          ///< the scene without them
  std::set<std::map<std::string, std::string>> compared_;  ///< Params of rows compared with it
  std::set<std::string> told_;
  std::set<std::pair<std::string, double>> stepped_;  ///< subjects and steps that were warned of
};

/// Advances the innermost sweep first; false after the last combination.
bool next_combination(const std::vector<SweepPlan>& sweeps, std::vector<int>& values) {
  for (std::size_t i = sweeps.size(); i-- > 0;) {
    if (++values[i] < static_cast<int>(sweeps[i].si.size())) return true;
    values[i] = 0;
  }
  return false;
}

bool plan_rows(StudyPlan& plan, const Object& study, SceneLoader& loader,
               const PlanOptions& options, output::Hash& hash) {
  SharedHeights heights;
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
      if (!plan.covers(subject.only, row)) continue;
      std::string printed;
      if (!loader.load(plan, study, row, printed)) return false;
      row.experiment.duration = plan.duration;
      if (row.refusal.empty()) loader.warn_of_step(plan, study, row);
      row.hash = simulation::experiment_hash(printed, row.experiment);
      hash.add(row.hash);
      if (plan.rows.empty()) plan.scene_printed = printed;
      heights.take(row);
      plan.rows.push_back(std::move(row));
    }
  } while (next_combination(plan.sweeps, values));
  return true;
}

/// A scene may set engine, law and integrator itself: the table names those in force.
void complete_subjects(StudyPlan& plan, const EngineTable& engines) {
  for (std::size_t i = 0; i < plan.subjects.size(); ++i) {
    SubjectInfo& info = plan.subjects[i].info;
    const auto row = std::find_if(
        plan.rows.begin(), plan.rows.end(),
        [&](const RowPlan& candidate) { return candidate.subject == static_cast<int>(i); });
    const simulation::Experiment* experiment = row == plan.rows.end() ? nullptr : &row->experiment;
    info.engine = experiment != nullptr ? experiment->engine : plan.subjects[i].engine;
    const auto entry = engines.find(info.engine);
    info.available = entry != engines.end() && entry->second.description.found;
    if (experiment == nullptr) continue;
    const bool ours = info.engine == "dts";
    info.law = ours ? experiment->contact : "";
    const bool integrated = ours && contact::find_force_law(experiment->contact).has_value();
    info.integrator = integrated ? experiment->integrator : "";
    info.settings = ours ? "" : experiment->settings;
  }
}

void plan_times(StudyPlan& plan, const Object& study, Diagnostics& diagnostics) {
  constexpr double quick_part = 0.2;
  const auto quick = [&](const char* field, double full) {
    return study.find(field) != nullptr ? study.number(field) : quick_part * full;
  };
  plan.duration = study.number("duration");
  plan.settle = study.number("settle");
  if (plan.quick) {
    plan.duration = quick("quick_duration", plan.duration);
    plan.settle = quick("quick_settle", plan.settle);
  }
  if (plan.settle >= plan.duration)
    diagnostics.error(study.find("duration")->position,
                      "duration must be longer than settle: nothing would be measured");
}

}  // namespace

std::optional<StudyPlan> make_plan(const Object& root, const Object& study, const std::string& file,
                                   language::Library& library, const EngineTable& engines,
                                   const PlanOptions& options, Diagnostics& diagnostics) {
  StudyPlan plan;
  plan.name = study.name;
  plan.file = file;
  plan.quick = options.quick;
  if (study.find("title") != nullptr) plan.title = study.word("title");
  if (study.find("question") != nullptr) plan.question = study.word("question");
  plan_times(plan, study, diagnostics);
  const std::filesystem::path scene = library.find(study.word("scene"), file);
  if (scene.empty()) {
    diagnostics.error(study.find("scene")->position,
                      "no file \"" + study.word("scene") + "\" beside the study or in configs/");
    return std::nullopt;
  }
  SceneLoader loader(library, scene, diagnostics);
  const auto parameters = library.parameters(scene, diagnostics);
  for (const language::ParameterDeclaration& parameter : parameters)
    loader.parameters.push_back(parameter.name);
  loader.settings = options.settings;
  loader.fixes = plan_parts(plan, study, parameters, options, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  plan.printed = language::print(root);
  output::Hash hash;
  hash.add(plan.printed);
  hash.add(fmt::format("{} {} {} {}", plan.name, language::join(options.only, ","), plan.settle,
                       plan.duration));
  if (!plan_rows(plan, study, loader, options, hash)) return std::nullopt;
  plan.settable = loader.settable;
  plan.hash = hash.text();
  for (std::string& source : language::sources_of(root)) loader.inputs.insert(std::move(source));
  plan.inputs = simulation::hashed(loader.inputs);
  if (plan.rows.empty()) {
    diagnostics.error(study.position,
                      "the study has no run: no Subject, or none that its Only blocks allow");
    return std::nullopt;
  }
  complete_subjects(plan, engines);
  return plan;
}

}  // namespace hookpoint::studies
