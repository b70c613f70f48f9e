#include "studies/calibrate/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "contact/force_law.h"
#include "language/names.h"
#include "output/text/hash.h"
#include "simulation/identity.h"
#include "simulation/material_fields.h"
#include "simulation/run/world.h"
#include "simulation/wiring/ports.h"
#include "studies/calibrate/subject_name.h"
#include "studies/measurements/trace_blocks.h"
#include "studies/plan/plan_parts.h"
#include "studies/tune/step_warnings.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;
using language::Position;

/// What --quick leaves of the work.
constexpr std::size_t quick_starts = 4, quick_folds = 2;
constexpr int quick_generations = 3;

/// What a plan is made from.
struct PlanSource {
  const Object& root;
  const Object& calibrate;
  const std::string& file;
  language::Library& library;
  const EngineTable& engines;
  Diagnostics& diagnostics;

  void error(const Position& position, std::string message) const {
    diagnostics.error(position, std::move(message));
  }
  /// The file that a field names; empty after an error.
  std::filesystem::path find(const Object& block, const char* field) const {
    const std::filesystem::path found = library.find(block.word(field), file);
    if (found.empty())
      error(block.find(field)->position,
            "no file \"" + block.word(field) + "\" beside the Calibrate or in configs/");
    return found;
  }
};

std::vector<ConstantSetting> fixed(const Object& owner) {
  std::vector<ConstantSetting> settings;
  for (const Object* fix : owner.children_of("Fix"))
    settings.push_back({ConstantPlace::scene_parameter, fix->name, text_of(*fix->find("value"))});
  return settings;
}

std::shared_ptr<const TuneScene> scene_of(const PlanSource& from, const Object* block,
                                          const SubjectPlan& subject) {
  SceneSource source;
  const Object& calibrate = from.calibrate;
  source.scene = from.find(calibrate, "scene");
  if (calibrate.given("terrain")) source.terrain = from.find(calibrate, "terrain");
  if (calibrate.given("material")) source.material = calibrate.word("material");
  source.settled = fixed(calibrate);
  if (block != nullptr)
    for (ConstantSetting& setting : fixed(*block)) source.settled.push_back(std::move(setting));
  const auto set = [&](const char* field, const std::string& value) {
    if (!value.empty()) source.world.emplace_back(field, value);
  };
  set("contact", subject.contact);
  set("integrator", subject.integrator);
  set("engine", subject.engine);
  set("settings", subject.settings);
  if (from.diagnostics.has_errors()) return nullptr;
  auto scene = std::make_shared<const TuneScene>(from.library, std::move(source),
                                                 calibrate.position, from.diagnostics);
  return from.diagnostics.has_errors() ? nullptr : scene;
}

/// A subject as the file asks for it, before its scene is loaded.
struct AskedSubject {
  SubjectPlan plan;
  const Object* block = nullptr;
  Position position;
};

std::vector<AskedSubject> asked_subjects(const PlanSource& from,
                                         const language::ClassSchema& world) {
  std::vector<AskedSubject> asked;
  const auto add = [&](AskedSubject subject) {
    const bool taken = std::ranges::any_of(asked, [&](const AskedSubject& other) {
      return other.plan.info.name == subject.plan.info.name;
    });
    if (taken)
      from.error(subject.position, "the subject `" + subject.plan.info.name + "` is there already");
    else
      asked.push_back(std::move(subject));
  };
  if (from.calibrate.given("subjects")) {
    const language::Field& field = *from.calibrate.find("subjects");
    for (std::size_t i = 0; i < field.words.size(); ++i) {
      const Position& place = i < field.places.size() ? field.places[i] : field.position;
      const auto subject = subject_named(world, field.words[i]);
      if (subject)
        add({*subject, nullptr, place});
      else
        from.error(place, fmt::format(
                              "no law and no engine with settings is called `{}`{}", field.words[i],
                              language::did_you_mean(field.words[i], subject_parts(world))));
    }
  }
  for (const Object* block : from.calibrate.children_of("Subject"))
    add({subject_of(*block), block, block->position});
  if (asked.empty()) {
    SubjectPlan own;
    own.info.name = "scene";
    asked.push_back({own, nullptr, from.calibrate.position});
  }
  return asked;
}

bool reads(const contact::LawDescription& law, const std::string& constant) {
  return std::ranges::any_of(law.constants, [&](contact::Constant member) {
    return simulation::field_of(member).name == constant;
  });
}

/// Which of the constants the subject has: a law says which of a Material's it reads. Whether a
/// peer, or a Param, changes anything is seen when it runs.
void choose_constants(CalibrationSubject& subject, const std::vector<VariedConstant>& varied) {
  const contact::LawDescription* law =
      subject.info.engine == "dts" ? contact::find_law(subject.info.law) : nullptr;
  for (std::size_t i = 0; i < varied.size(); ++i) {
    const bool field = varied[i].place == ConstantPlace::material_field;
    if (law != nullptr && field && !reads(*law, varied[i].name))
      subject.left_out.push_back({i, "the law " + subject.info.law + " does not read it"});
    else
      subject.constants.push_back(i);
  }
}

bool same_settings(const std::vector<ConstantSetting>& one,
                   const std::vector<ConstantSetting>& other) {
  return std::ranges::equal(one, other, [](const auto& a, const auto& b) {
    return a.place == b.place && a.name == b.name && a.text == b.text;
  });
}

/// A Trace's Fix blocks, in their places.
std::vector<ConstantSetting> case_settings(const PlanSource& from, const Object& block,
                                           const CalibrationPlan& plan, const TuneScene& scene) {
  std::vector<ConstantSetting> settings = fixed(block);
  for (ConstantSetting& setting : settings) {
    const auto place = scene.place_of(setting.name);
    if (!place)
      from.error(block.position, fmt::format("no Param of the scene is called `{}`{}", setting.name,
                                             language::did_you_mean(setting.name, scene.names())));
    setting.place = place.value_or(ConstantPlace::scene_parameter);
    if (std::ranges::find(plan.varied, setting.name, &VariedConstant::name) != plan.varied.end())
      from.error(block.position,
                 fmt::format("`{}` is varied: it cannot be fixed as well", setting.name));
  }
  return settings;
}

/// The offset of a Trace that is fitted: a constant after those of the scene. Its search begins
/// where the Trace says, or at its first sample [s], within the range.
void add_offset(const PlanSource& from, CalibrationPlan& plan, const Object& trace, double first) {
  for (const Object* vary : trace.children_of("Vary")) {
    if (vary->name != "offset") {
      from.error(vary->position,
                 fmt::format("a Trace has no number `{}` to vary: only its `offset`; "
                             "constants of the scene vary in the Calibrate",
                             vary->name));
      continue;
    }
    const language::Dimension time{0, 0, 1, 0};
    for (const char* end : {"from", "to"})
      if (!language::fits(vary->find(end)->dimension, time))
        from.error(vary->find(end)->position, "an offset is a time, as 12.3 s");
    VariedConstant constant = varied_range(*vary, from.diagnostics);
    constant.name = trace.name + ".offset";
    plan.offsets.push_back({plan.varied.size(), trace.name});
    plan.own.resize(plan.varied.size());
    const double own =
        constant.unit.from_si(trace.given("offset") ? trace.number("offset") : first);
    plan.own.push_back(std::max(constant.from, std::min(own, constant.to)));
    plan.varied.push_back(std::move(constant));
  }
}

void add_traces(const PlanSource& from, CalibrationPlan& plan, const TuneScene& scene,
                const TraceReader& reader) {
  for (const Object* block : from.calibrate.children_of("Trace")) {
    auto settings = case_settings(from, *block, plan, scene);
    auto traces = reader.read(*block, "");
    if (!traces) continue;
    TracePlan& trace = traces->begin()->second;
    add_offset(from, plan, *block, trace.measured.time.front());
    const auto known = std::ranges::find_if(plan.cases, [&](const CalibrationCase& one) {
      return same_settings(one.settings, settings);
    });
    CalibrationCase& one =
        known != plan.cases.end()
            ? *known
            : plan.cases.emplace_back(CalibrationCase{"", std::move(settings), {}});
    one.name += (one.name.empty() ? "" : "_") + trace.name;
    one.traces.push_back(std::move(trace));
  }
}

/// Names of the Params that a table's columns may set.
std::vector<std::string> parameters_of(const TuneScene& scene) {
  std::vector<std::string> names = scene.names();
  std::erase_if(names, [&](const std::string& name) {
    const auto place = scene.place_of(name);
    return place != ConstantPlace::scene_parameter && place != ConstantPlace::terrain_parameter;
  });
  return names;
}

/// The cases of a Cases block: each row of its table that its Only blocks admit, set as its columns
/// say, with the part of each Trace that is of it.
void add_case_table(const PlanSource& from, CalibrationPlan& plan, const TuneScene& scene,
                    const TraceReader& reader, const Object& block) {
  const std::filesystem::path file = from.find(block, "file");
  if (file.empty()) return;
  const auto rows = read_cases(block, file, parameters_of(scene), from.diagnostics);
  if (!rows) return;
  plan.case_tables.push_back(file);
  for (const VariedConstant& constant : plan.varied)
    if (std::ranges::find(rows->parameters, constant.name) != rows->parameters.end())
      from.error(block.position, fmt::format("`{}` is varied: {} cannot set it as well",
                                             constant.name, file.string()));
  if (block.children_of("Trace").empty())
    from.error(block.position, "Cases need a Trace: nothing was measured");
  for (const Object* trace : block.children_of("Trace"))
    if (!trace->given("weight"))
      from.error(trace->position, "a Calibrate needs the `weight` of a Trace: it adds them up");
  auto traces = reader.read_cases(block, rows->cases);
  if (!traces) return;
  for (std::size_t i = 0; i < rows->cases.size(); ++i) {
    const CaseRow& row = rows->cases[i];
    CalibrationCase& one =
        plan.cases.emplace_back(CalibrationCase{block.name + "_" + row.name, {}, {}});
    for (const Assignment& set : row.settings)
      one.settings.push_back({*scene.place_of(set.parameter), set.parameter, set.text});
    one.traces = std::move((*traces)[i]);
    for (TracePlan& trace : one.traces) trace.name = one.name + "_" + trace.name;
  }
}

void set_work(CalibrationPlan& plan, const Object& calibrate, bool quick) {
  const auto whole = [&](const char* field) {
    return static_cast<std::size_t>(calibrate.number(field));
  };
  plan.folds = whole("folds");
  plan.resamples = whole("resamples");
  plan.starts = whole("starts");
  plan.seed = whole("seed");
  plan.method = calibrate.word("method") == "cmaes" ? FitMethod::cmaes : FitMethod::least_squares;
  plan.population = static_cast<int>(calibrate.number("population"));
  plan.generations = static_cast<int>(calibrate.number("generations"));
  if (calibrate.given("most_cases")) plan.most_cases = whole("most_cases");
  plan.bootstrap =
      calibrate.word("bootstrap") == "one_step" ? Bootstrap::one_step : Bootstrap::refits;
  if (!quick) return;
  plan.folds = std::min(plan.folds, quick_folds);
  plan.bootstrap = Bootstrap::one_step;
  plan.generations = std::min(plan.generations, quick_generations);
  plan.starts = std::min(plan.starts, quick_starts);
}

/// Makes the subjects of a plan, and hashes what decides their runs.
class SubjectMaker {
 public:
  SubjectMaker(const PlanSource& from, CalibrationPlan& plan) : from_(from), plan_(plan) {}

  void add(const AskedSubject& asked) {
    CalibrationSubject subject;
    subject.info = asked.plan.info;
    subject.scene = scene_of(from_, asked.block, asked.plan);
    if (subject.scene == nullptr) return;
    Diagnostics found;
    const auto own = subject.scene->load({}, 1, found);
    const bool peer = !asked.plan.engine.empty() && asked.plan.engine != "dts";
    if (own) {
      complete_subject(subject.info, own->experiment, from_.engines);
      warn_of_step(own->experiment, asked.position, "with subject = " + subject.info.name,
                   from_.diagnostics);
    } else if (peer) {
      // What it lacks is told in the report, as a study tells it.
      subject.info.engine = asked.plan.engine;
      subject.info.settings = asked.plan.settings;
      subject.refusal = first_error_of(found);
    } else {
      from_.error(asked.position, first_error_of(found));
      return;
    }
    if (!subject.info.available && subject.refusal.empty())
      subject.refusal = "engine " + subject.info.engine + " is not on this machine";
    choose_constants(subject, plan_.varied);
    subject.runs_hash = runs_hash(subject, own);
    plan_.subjects.push_back(std::move(subject));
  }

  std::set<std::string> inputs;

 private:
  std::string runs_hash(const CalibrationSubject& subject, const std::optional<TunedScene>& own) {
    output::Hash hash;
    hash.add(subject.info.name).add(subject.refusal);
    if (own) {
      const std::string printed = language::print(*own->tree);
      if (plan_.runs.scene_printed.empty()) plan_.runs.scene_printed = printed;
      hash.add(simulation::experiment_hash(printed, own->experiment));
      inputs.merge(simulation::files_read(own->experiment));
      for (std::string& source : language::sources_of(*own->tree)) inputs.insert(std::move(source));
    }
    const auto engine = from_.engines.find(subject.info.engine);
    return simulation::run_hash(
        hash.text(), engine == from_.engines.end()
                         ? simulation::EngineDescription{subject.info.engine, {}, {}, false, {}}
                         : engine->second.description);
  }

  const PlanSource& from_;
  CalibrationPlan& plan_;
};

void set_hash(const PlanSource& from, CalibrationPlan& plan, std::set<std::string> inputs) {
  std::set<std::filesystem::path> tables(plan.case_tables.begin(), plan.case_tables.end());
  for (const CalibrationCase& one : plan.cases)
    for (const TracePlan& trace : one.traces) tables.insert(trace.file);
  for (const std::filesystem::path& table : tables)
    inputs.insert(std::filesystem::absolute(table).lexically_normal().string());
  plan.runs.inputs = simulation::hashed(inputs);
  output::Hash hash;
  hash.add(plan.runs.printed).add(from.calibrate.name).add(plan.runs.quick ? "quick" : "");
  for (const output::InputFile& input : plan.runs.inputs) hash.add(input.hash);
  for (const CalibrationSubject& subject : plan.subjects) hash.add(subject.info.name);
  plan.runs.hash = hash.text();
}

/// The scene as our engine has it where the file's own is not to be had: ports are the same in all.
bool read_traces(const PlanSource& from, CalibrationPlan& plan, const TuneScene& scene) {
  const auto own = scene.load({}, 1, from.diagnostics);
  if (!own) return false;
  const auto engine = from.engines.find(own->experiment.engine);
  if (engine == from.engines.end() || !engine->second.description.found) {
    from.error(from.calibrate.position,
               "engine " + own->experiment.engine + " is not on this machine");
    return false;
  }
  try {
    simulation::World world(own->experiment, engine->second.make(own->experiment));
    const std::vector<simulation::Port> ports = world.ports();
    const auto port = [&](const std::string& trail, std::string& why) -> std::optional<TracePort> {
      try {
        const simulation::Port found = simulation::find_port(own->experiment, ports, trail);
        return TracePort{found.trail, found.unit};
      } catch (const simulation::ExperimentError& error) {
        why = error.what();
        return std::nullopt;
      }
    };
    const TraceSource source{
        [&](const Object& block, const char* field) { return from.find(block, field); }, port,
        from.diagnostics};
    const TraceReader reader(source);
    add_traces(from, plan, scene, reader);
    for (const Object* block : from.calibrate.children_of("Cases"))
      add_case_table(from, plan, scene, reader, *block);
  } catch (const simulation::ExperimentError& error) {
    from.error(from.calibrate.position, error.what());
  }
  return !from.diagnostics.has_errors();
}

}  // namespace

std::size_t CalibrationCase::residuals() const {
  std::size_t count = 0;
  for (const TracePlan& trace : traces) count += trace.residuals();
  return count;
}

std::size_t CalibrationPlan::residuals() const {
  std::size_t count = 0;
  for (const CalibrationCase& one : cases) count += one.residuals();
  return count;
}

const FittedOffset* CalibrationPlan::offset_of(std::size_t constant) const {
  const auto found = std::ranges::find(offsets, constant, &FittedOffset::constant);
  return found == offsets.end() ? nullptr : &*found;
}

bool CalibrationPlan::resamples_cases() const { return cases.size() >= least_cases_to_resample; }

double exact_value(const VariedConstant& constant, double share) {
  return constant.logarithmic ? constant.from * std::pow(constant.to / constant.from, share)
                              : constant.from + share * (constant.to - constant.from);
}

std::optional<CalibrationPlan> make_calibration_plan(const Object& root, const Object& calibrate,
                                                     const std::string& file,
                                                     language::Library& library,
                                                     const EngineTable& engines, bool quick,
                                                     Diagnostics& diagnostics) {
  const PlanSource from{root, calibrate, file, library, engines, diagnostics};
  CalibrationPlan plan;
  plan.runs.name = calibrate.name;
  plan.runs.file = file;
  plan.runs.quick = quick;
  plan.runs.printed = language::print(root);
  if (calibrate.given("title")) plan.runs.title = calibrate.word("title");
  if (calibrate.given("question")) plan.runs.question = calibrate.word("question");
  const auto scene = scene_of(from, nullptr, {});
  if (scene == nullptr) return std::nullopt;
  plan.material = scene->material();
  for (const Object* block : calibrate.children_of("Vary"))
    if (auto constant = varied_constant(*block, *scene, diagnostics))
      plan.varied.push_back(std::move(*constant));
  const bool fits_offsets =
      std::ranges::any_of(calibrate.children_of("Trace"),
                          [](const Object* trace) { return !trace->children_of("Vary").empty(); });
  if (plan.varied.empty() && !fits_offsets && calibrate.children_of("Cases").empty())
    from.error(calibrate.position, "a Calibrate needs a Vary: nothing is to be found");
  if (calibrate.children_of("Trace").empty() && calibrate.children_of("Cases").empty())
    from.error(calibrate.position, "a Calibrate needs a Trace: nothing was measured");
  if (diagnostics.has_errors() || !read_traces(from, plan, *scene)) return std::nullopt;
  set_work(plan, calibrate, quick);
  plan.own.resize(plan.varied.size());
  for (std::size_t i = 0; i < plan.varied.size(); ++i) {
    if (plan.offset_of(i) != nullptr) continue;
    const VariedConstant& constant = plan.varied[i];
    const auto value = scene->own_value(constant.setting(constant.from));
    if (value) plan.own[i] = constant.unit.from_si(*value);
  }
  SubjectMaker maker(from, plan);
  for (const AskedSubject& asked : asked_subjects(from, scene->world_schema())) maker.add(asked);
  if (diagnostics.has_errors()) return std::nullopt;
  set_hash(from, plan, std::move(maker.inputs));
  return plan;
}

}  // namespace hookpoint::studies
