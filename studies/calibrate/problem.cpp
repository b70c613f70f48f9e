#include "studies/calibrate/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "contact/force_law.h"
#include "language/names.h"
#include "output/files/hash.h"
#include "simulation/engine_interface/identity.h"
#include "simulation/experiment/material_fields.h"
#include "simulation/run/world.h"
#include "simulation/wiring/ports.h"
#include "studies/blocks/trace.h"
#include "studies/blocks/vary.h"
#include "studies/calibrate/subject_name.h"
#include "studies/results/selection.h"
#include "studies/search/step_warnings.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;
using language::Position;

/// What a plan is made from.
struct PlanSource {
  const Object& root;
  const Object& calibrate;
  const CalibrateBlock& block;
  const std::string& file;
  language::Library& library;
  const EngineTable& engines;
  Diagnostics& diagnostics;

  void error(const Position& position, std::string message) const {
    diagnostics.error(position, std::move(message));
  }
  std::filesystem::path find(const language::Placed<std::string>& name) const {
    return file_beside(calibrate, name, file, library, diagnostics);
  }
};

std::shared_ptr<const VariedScene> scene_of(const PlanSource& from, const Object* subject,
                                            const Composition& words) {
  SceneSource source = scene_source(from.calibrate, from.block, subject, words, from.file,
                                    from.library, from.diagnostics);
  if (from.diagnostics.has_errors()) return nullptr;
  auto scene = std::make_shared<const VariedScene>(from.library, std::move(source),
                                                   from.calibrate.position, from.diagnostics);
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
  if (from.block.subjects) {
    const language::Field& field = *from.block.subjects.field;
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
                                           const CalibrationPlan& plan, const VariedScene& scene) {
  std::vector<ConstantSetting> settings = fixed_constants(block);
  for (ConstantSetting& setting : settings) {
    const auto place = scene.place_of(setting.name);
    if (!place)
      from.error(block.position, fmt::format("no Param of the scene is called `{}`{}", setting.name,
                                             language::did_you_mean(setting.name, scene.names())));
    setting.place = place.value_or(ConstantPlace::parameter);
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
    check_varied(*vary, {0, 0, 1, 0}, "an offset is a time, as 12.3 s", from.diagnostics);
    VariedConstant constant = varied_range(*vary, from.diagnostics);
    constant.name = trace.name + ".offset";
    plan.offsets.push_back({plan.varied.size(), trace.name});
    plan.own.resize(plan.varied.size());
    const double own = constant.unit.from_si(trace_block(trace).offset.value.value_or(first));
    plan.own.push_back(std::max(constant.from, std::min(own, constant.to)));
    plan.varied.push_back(std::move(constant));
  }
}

void add_traces(const PlanSource& from, CalibrationPlan& plan, const VariedScene& scene,
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
std::vector<std::string> parameters_of(const VariedScene& scene) {
  std::vector<std::string> names = scene.names();
  std::erase_if(names, [&](const std::string& name) {
    const auto place = scene.place_of(name);
    return place != ConstantPlace::parameter;
  });
  return names;
}

/// The cases of a Cases block: each row of its table that its Only blocks admit, set as its columns
/// say, with the part of each Trace that is of it.
void add_case_table(const PlanSource& from, CalibrationPlan& plan, const VariedScene& scene,
                    const TraceReader& reader, const Object& block) {
  const std::filesystem::path file = from.find(cases_block(block).file);
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
    if (!trace_block(*trace).weight)
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
      subject.info = composition_of(own->experiment, from_.engines, subject.info.name);
      warn_of_step(own->experiment, asked.position, "with subject = " + subject.info.name,
                   from_.diagnostics);
    } else if (peer) {
      // What it lacks is told in the report, as a study tells it.
      subject.info.engine = asked.plan.engine;
      subject.info.settings = asked.plan.settings;
      subject.refusal = found.first_error();
    } else {
      from_.error(asked.position, found.first_error());
      return;
    }
    if (!subject.info.available && subject.refusal.empty())
      subject.refusal = "engine " + subject.info.engine + " is not on this machine";
    choose_constants(subject, plan_.varied);
    subject.runs_hash = runs_hash(subject, own);
    plan_.runs.compositions.push_back(subject.info);
    plan_.subjects.push_back(std::move(subject));
  }

  std::set<std::string> inputs;

 private:
  std::string runs_hash(const CalibrationSubject& subject, const std::optional<LoadedScene>& own) {
    output::Hash hash;
    hash.add(subject.info.name).add(subject.refusal);
    if (own) {
      if (plan_.runs.scene_printed.empty()) plan_.runs.scene_printed = own->printed();
      hash.add(own->hash());
      inputs.merge(own->sources());
    }
    return simulation::run_hash(hash.text(), from_.engines.describe(subject.info.engine));
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
bool read_traces(const PlanSource& from, CalibrationPlan& plan, const VariedScene& scene) {
  const auto own = scene.load({}, 1, from.diagnostics);
  if (!own) return false;
  check_ends(plan.varied, scene, from.diagnostics);
  const EngineEntry* engine = from.engines.find(own->experiment.engine);
  if (engine == nullptr || !engine->describe().found) {
    from.error(from.calibrate.position, from.engines.absence(own->experiment.engine));
    return false;
  }
  try {
    simulation::World world(own->experiment, engine->make(own->experiment));
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
        [&](const language::Placed<std::string>& name) { return from.find(name); }, port,
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
  const CalibrateBlock block = load_calibrate(calibrate, quick);
  const PlanSource from{root, calibrate, block, file, library, engines, diagnostics};
  CalibrationPlan plan;
  plan.runs.name = calibrate.name;
  plan.runs.file = file;
  plan.runs.quick = quick;
  plan.runs.printed = language::print(root);
  plan.runs.title = block.title;
  plan.runs.question = block.question;
  const auto scene = scene_of(from, nullptr, {});
  if (scene == nullptr) return std::nullopt;
  plan.material = scene->material();
  for (const Object* vary : calibrate.children_of("Vary"))
    if (auto constant = varied_constant(*vary, *scene, diagnostics))
      plan.varied.push_back(std::move(*constant));
  refuse_fixed(calibrate, plan.varied, diagnostics);
  for (const Object* subject : calibrate.children_of("Subject"))
    refuse_fixed(*subject, plan.varied, diagnostics);
  const bool fits_offsets =
      std::ranges::any_of(calibrate.children_of("Trace"),
                          [](const Object* trace) { return !trace->children_of("Vary").empty(); });
  if (calibrate.children_of("Vary").empty() && !fits_offsets &&
      calibrate.children_of("Cases").empty())
    from.error(calibrate.position, "a Calibrate needs a Vary: nothing is to be found");
  if (calibrate.children_of("Trace").empty() && calibrate.children_of("Cases").empty())
    from.error(calibrate.position, "a Calibrate needs a Trace: nothing was measured");
  if (diagnostics.has_errors() || !read_traces(from, plan, *scene)) return std::nullopt;
  static_cast<CalibrationWork&>(plan) = block;
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
