#include "studies/plan/plan_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "language/names.h"
#include "language/values/budget.h"
#include "output/text/number.h"
#include "simulation/scene/load.h"
#include "studies/plan/plan_builder.h"
#include "studies/plan/plan_values.h"
#include "studies/plan/scene_words.h"
#include "studies/plan/told_elsewhere.h"
#include "studies/selection.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Field;
using language::Object;

/// Sweeps of no Param: fields of the World, and its ground.
constexpr std::array<const char*, 4> world_sweeps{"engine", "contact", "integrator", "settings"};
constexpr const char* ground_sweep = "terrain";

std::vector<double> in_unit(const std::vector<double>& si, const WrittenUnit& unit) {
  std::vector<double> values;
  for (const double value : si) values.push_back(tidy(unit.from_si(value)));
  return values;
}

/// Puts the step that a run chooses where the scene leaves it to it: a closed form may name it.
void write_step(Object& scene) {
  Diagnostics untold;
  if (const auto experiment = simulation::load_experiment(scene, untold))
    simulation::write_chosen_step(*experiment, scene);
}

RowPlan first_row(const StudyPlan& plan, const std::filesystem::path& scene_file) {
  RowPlan first;
  first.values.assign(plan.sweeps.size(), 0);
  first.scene = std::make_shared<const RowScene>(RowScene{.file = scene_file, .options = {}});
  return first;
}

/// The scene as the study's first run has it, but for fields of its World. Null where it cannot be
/// laid down; what is wrong goes to `diagnostics`.
std::unique_ptr<Object> lay_first(const StudyPlan& plan, const std::filesystem::path& file,
                                  Diagnostics& diagnostics) {
  if (plan.subjects.empty()) return nullptr;
  const RowPlan first = first_row(plan, file);
  RowScene scene = plan.scene_of(first);
  scene.options.overrides.clear();
  Diagnostics found;
  auto tree = lay_down(*plan.library, scene, found);
  for (const language::Diagnostic& diagnostic : found.all())
    tell_at(plan.place_in_study(diagnostic.position, first, ""), diagnostic, diagnostics);
  return tree;
}

/// Words that the study's Sweeps and Fixes say, those too that do not run under --quick.
std::vector<std::string> words_in(const Object& study) {
  std::vector<std::string> words;
  const auto add = [&](const Object& block, const char* field) {
    if (const Field* given = block.find(field))
      words.insert(words.end(), given->words.begin(), given->words.end());
  };
  for (const Object* sweep : study.children_of("Sweep")) add(*sweep, "values");
  std::vector<const Object*> owners = study.children_of("Subject");
  owners.push_back(&study);
  for (const Object* owner : owners)
    for (const Object* fix : owner->children_of("Fix")) add(*fix, "value");
  return words;
}

bool is_own_metric(const Object* block) { return block->given("of") || block->given("trace"); }

bool has_traces(const Object* cases) { return !cases->children_of("Trace").empty(); }

}  // namespace

void PlanBuilder::unknown(const language::Position& position, std::string_view kind,
                          const std::string& name, const std::vector<std::string>& known) {
  diagnostics_.error(position, fmt::format("no {} is called `{}`{}", kind, name,
                                           language::did_you_mean(name, known)));
}

std::vector<std::string> PlanBuilder::sweep_names() const {
  std::vector<std::string> names;
  for (const SweepPlan& sweep : plan_.sweeps) names.push_back(sweep.column.name);
  return names;
}

int PlanBuilder::sweep_index(const std::string& name) const {
  const auto names = sweep_names();
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

std::optional<SweepRole> PlanBuilder::role_of(const Object& block) {
  if (std::ranges::find(parameters_, block.name) != parameters_.end()) return SweepRole::parameter;
  if (block.name == ground_sweep) return SweepRole::ground;
  if (std::ranges::find(world_sweeps, block.name) != world_sweeps.end())
    return SweepRole::world_field;
  std::vector<std::string> known = parameters_;
  known.insert(known.end(), world_sweeps.begin(), world_sweeps.end());
  known.emplace_back(ground_sweep);
  unknown(block.position, "Param of the scene", block.name, known);
  return std::nullopt;
}

bool PlanBuilder::parameter_exists(const Object& block) {
  if (std::find(parameters_.begin(), parameters_.end(), block.name) != parameters_.end())
    return true;
  unknown(block.position, "Param of the scene", block.name, parameters_);
  return false;
}

bool PlanBuilder::may_have_values(const Object& block, const char* field, double count) {
  if (count <= static_cast<double>(most_runs)) return true;
  diagnostics_.error(
      block.find(field)->position,
      fmt::format("the Sweep asks for {}", language::too_many(count, most_runs, "values")));
  return false;
}

void PlanBuilder::check_size(const Object& study) {
  auto count = static_cast<double>(plan_.subjects.size());
  for (const SweepPlan& sweep : plan_.sweeps) count *= static_cast<double>(sweep.si.size());
  if (count > static_cast<double>(most_runs))
    diagnostics_.error(study.position, fmt::format("the study's sweeps and subjects ask for {}",
                                                   language::too_many(count, most_runs, "runs")));
}

std::vector<double> PlanBuilder::sweep_values(const Object& block, const WrittenUnit& unit) {
  if (options_.quick && block.find("quick_values") != nullptr)
    return in_unit(block.numbers("quick_values"), unit);
  std::vector<double> values = declared_values(block, unit);
  if (values.empty())
    diagnostics_.error(block.position,
                       "a Sweep needs `values`, or `from`, `to` and a `step` > 0 (or a "
                       "`count`; on a log scale both ends > 0)");
  if (options_.quick && values.size() > 2) return {values.front(), values.back()};
  return values;
}

std::vector<double> PlanBuilder::declared_values(const Object& block, const WrittenUnit& unit) {
  std::vector<double> values;
  if (block.find("values") != nullptr) {
    values = in_unit(block.numbers("values"), unit);
  } else if (block.find("from") != nullptr && block.find("to") != nullptr) {
    const double from = unit.from_si(block.number("from")), to = unit.from_si(block.number("to"));
    const bool logarithmic = block.word("scale") == "log";
    if (block.find("step") != nullptr && block.number("step") > 0. && to >= from) {
      const double step = unit.from_si(block.number("step"));
      if (!may_have_values(block, "step", stepped_count(from, to, step))) return {};
      values = stepped(from, to, step);
    } else if (block.find("count") != nullptr && (!logarithmic || (from > 0. && to > 0.))) {
      const double count = block.number("count");
      if (!may_have_values(block, "count", count)) return {};
      values = spaced(from, to, static_cast<int>(count), logarithmic);
    }
  }
  return values;
}

void PlanBuilder::find_grounds(const Object& block) {
  if (std::ranges::find(parameters_, block.name) != parameters_.end()) return;
  const Field* values = block.find("values");
  for (std::size_t i = 0; values != nullptr && i < values->words.size(); ++i) {
    SweptGround& ground = grounds_.emplace_back();
    ground.file = plan_.library->find(values->words[i], plan_.file);
    if (ground.file.empty()) {
      diagnostics_.error(
          values->places[i],
          fmt::format("no file \"{}\" beside the study or in configs/", values->words[i]));
      continue;
    }
    for (const auto& declared : plan_.library->parameters(ground.file, diagnostics_))
      ground.parameters.push_back(declared.name);
  }
  for (const SweptGround& ground : grounds_)
    parameters_.insert(parameters_.end(), ground.parameters.begin(), ground.parameters.end());
}

std::vector<double> PlanBuilder::word_values(const SweepPlan& sweep, const Field& field) {
  std::vector<double> values;
  for (std::size_t i = 0; i < field.words.size(); ++i) {
    const std::string& word = field.words[i];
    if (std::ranges::find(sweep.declared_words, word) == sweep.declared_words.end())
      unknown(field.places[i], "value of the Sweep " + sweep.column.name, word,
              sweep.declared_words);
    const auto found = std::ranges::find(sweep.column.words, word);
    if (found != sweep.column.words.end())
      values.push_back(static_cast<double>(found - sweep.column.words.begin()));
  }
  return values;
}

std::vector<double> PlanBuilder::number_values(const SweepPlan& sweep, const Field& field) {
  const WrittenUnit unit = written_unit(field);
  for (const double value : field.numbers)
    if (std::ranges::none_of(sweep.declared, [&](double v) { return same_value(v, value); }))
      diagnostics_.error(field.position,
                         no_such_value(sweep, unit.with_unit(tidy(unit.from_si(value))), value));
  return field.numbers;
}

std::string PlanBuilder::no_such_value(const SweepPlan& sweep, const std::string& text,
                                       std::optional<double> value) {
  return fmt::format("`{}` is no value of the Sweep `{}`; it has {}", text, sweep.column.name,
                     sweep.values_near(value));
}

bool PlanBuilder::may_say(const Object& block, const Field& words) {
  const auto subjects = block.parent->children_of("Subject");
  const language::FieldSchema* field =
      subjects.empty() ? nullptr : subjects.front()->schema->find(block.name);
  if (field == nullptr || field->choices.empty()) return true;
  bool good = true;
  for (std::size_t i = 0; i < words.words.size(); ++i) {
    if (std::ranges::find(field->choices, words.words[i]) != field->choices.end()) continue;
    unknown(words.places[i], block.name, words.words[i], field->choices);
    good = false;
  }
  return good;
}

void PlanBuilder::add_word_sweep(const Object& block, SweepRole role) {
  const Field& field = *block.find("values");
  if (role == SweepRole::world_field && !may_say(block, field)) return;
  const std::vector<std::string> texts = word_texts(field);
  SweepPlan all;
  all.column = {block.name, "", {}, field.words};
  all.declared_words = field.words;
  std::vector<double> taken;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    taken.push_back(static_cast<double>(i));
    if (std::ranges::count(field.words, field.words[i]) > 1)
      return diagnostics_.error(field.places[i],
                                fmt::format("`{}` stands there twice", field.words[i]));
  }
  const Field* quick = block.find("quick_values");
  if (options_.quick && quick != nullptr && quick->words.empty())
    diagnostics_.error(quick->position, "`quick_values` takes some of the words of `values`");
  if (options_.quick && quick != nullptr)
    taken = word_values(all, *quick);
  else if (options_.quick && taken.size() > 2)
    taken = {taken.front(), taken.back()};
  SweepPlan sweep;
  sweep.column = {block.name, "", {}, {}};
  sweep.role = role;
  for (const double value : taken) {
    const auto i = static_cast<std::size_t>(value);
    sweep.si.push_back(static_cast<double>(sweep.si.size()));
    sweep.column.words.push_back(field.words[i]);
    sweep.texts.push_back(texts[i]);
    sweep.places.push_back(field.places[i]);
    if (role == SweepRole::ground) sweep.grounds.push_back(grounds_[i]);
  }
  sweep.column.values = sweep.si;
  for (std::size_t i = 0; i < texts.size(); ++i) sweep.declared.push_back(static_cast<double>(i));
  sweep.declared_texts = texts;
  sweep.declared_words = field.words;
  plan_.sweeps.push_back(std::move(sweep));
}

void PlanBuilder::add_sweep(const Object& block) {
  const auto role = role_of(block);
  if (!role) return;
  const Field* values = block.find("values");
  if (values != nullptr && !values->words.empty()) return add_word_sweep(block, *role);
  if (*role != SweepRole::parameter)
    return diagnostics_.error(block.position,
                              fmt::format("a Sweep of `{}` needs `values`, words or strings: the "
                                          "scene has no Param of that name",
                                          block.name));
  const Field* first = block.find("values") != nullptr ? block.find("values") : block.find("from");
  const WrittenUnit unit = first == nullptr ? WrittenUnit{} : written_unit(*first);
  SweepPlan sweep;
  sweep.column = {block.name, unit.text, sweep_values(block, unit), {}};
  for (const double value : sweep.column.values) {
    sweep.si.push_back(unit.to_si(value));
    sweep.texts.push_back(unit.with_unit(value));
    sweep.places.push_back(first == nullptr ? block.position : first->position);
  }
  for (const double value : options_.quick ? declared_values(block, unit) : sweep.column.values) {
    sweep.declared.push_back(unit.to_si(value));
    sweep.declared_texts.push_back(unit.with_unit(value));
  }
  plan_.sweeps.push_back(std::move(sweep));
}

bool PlanBuilder::is_varied(const std::string& parameter) const {
  return sweep_index(parameter) >= 0 ||
         std::ranges::any_of(plan_.sweeps,
                             [&](const SweepPlan& sweep) { return sweep.assigns(parameter); });
}

std::vector<Assignment> PlanBuilder::fixes(const Object& owner) {
  std::vector<Assignment> result;
  for (const Object* block : owner.children_of("Fix")) {
    if (!parameter_exists(*block)) continue;
    if (is_varied(block->name)) {
      diagnostics_.error(block->position,
                         fmt::format("`{}` is {}: it cannot be fixed as well", block->name,
                                     sweep_index(block->name) >= 0 ? "swept" : "set by the Cases"));
      continue;
    }
    result.push_back({block->name, text_of(*block->find("value"))});
  }
  return result;
}

Condition PlanBuilder::condition(const Object& block, int sweep) {
  const SweepPlan& swept = plan_.sweeps[static_cast<std::size_t>(sweep)];
  const bool words = !swept.column.words.empty();
  Condition condition;
  condition.sweep = sweep;
  if (const Field* values = block.find("values")) {
    if (values->words.empty() == words)
      diagnostics_.error(
          values->position,
          fmt::format("the values of `{}` are {}", swept.column.name,
                      words ? "words: " + language::join(swept.texts, ", ") : "numbers"));
    condition.values = words ? word_values(swept, *values) : number_values(swept, *values);
  }
  for (const char* end : {"from", "to"})
    if (words && block.find(end) != nullptr)
      diagnostics_.error(
          block.find(end)->position,
          fmt::format("`{}` has words, which have no order: give `values`", swept.column.name));
  if (block.find("from") != nullptr) condition.from = block.number("from");
  if (block.find("to") != nullptr) condition.to = block.number("to");
  const bool ranged = !words && (condition.from || condition.to) && !condition.values;
  if (ranged && std::ranges::none_of(swept.declared, [&](double v) { return condition.holds(v); }))
    diagnostics_.error(
        block.position,
        fmt::format("no value of the Sweep `{}` lies there; it has {}", swept.column.name,
                    swept.values_near(condition.from ? condition.from : condition.to)));
  return condition;
}

std::vector<Condition> PlanBuilder::conditions(const Object& owner) {
  std::vector<Condition> result;
  for (const Object* block : owner.children_of("Only")) {
    const int sweep = sweep_index(block->name);
    if (sweep < 0)
      unknown(block->position, "Sweep", block->name, sweep_names());
    else
      result.push_back(condition(*block, sweep));
  }
  return result;
}

void PlanBuilder::check_not_swept(const Object& subject) {
  for (const SweepPlan& sweep : plan_.sweeps) {
    const Field* field = subject.find(sweep.column.name);
    if (sweep.role == SweepRole::world_field && field != nullptr)
      diagnostics_.error(
          field->position,
          fmt::format("`{}` is swept: a Subject cannot say it as well", sweep.column.name));
  }
}

void PlanBuilder::add_subject(const Object& block) {
  SubjectPlan subject = subject_of(block);
  if (!subject.engine.empty() && subject.engine != "dts" && !subject.contact.empty())
    diagnostics_.error(
        block.find("contact")->position,
        fmt::format("engine {} has a contact of its own: leave `contact` out", subject.engine));
  check_not_swept(block);
  subject.fixes = fixes(block);
  subject.only = conditions(block);
  plan_.subjects.push_back(std::move(subject));
}

std::vector<std::string> PlanBuilder::metric_names() {
  std::vector<std::string> names;
  for (const MetricDefinition& metric : metric_table()) names.emplace_back(metric.name);
  return names;
}

double PlanBuilder::number_in(const Object& block, const char* field, std::string_view unit) {
  const Field& given = *block.find(field);
  const std::optional<language::Unit> expected = language::parse_unit(unit);
  if (expected && !language::fits(given.dimension, expected->dimension))
    diagnostics_.error(given.position,
                       fmt::format("`{}` is in {}, not {}", field,
                                   language::describe_dimension(expected->dimension),
                                   language::describe_dimension(given.dimension)));
  return block.number(field) * (expected ? expected->denominator / expected->numerator : 1.);
}

void PlanBuilder::add_metric(const Object& block) {
  if (is_own_metric(&block)) return add_own_metric(block);
  const MetricDefinition* metric = find_metric(block.name);
  if (metric == nullptr)
    return diagnostics_.error(
        block.position,
        fmt::format("no metric is called `{}` (one of your own says what it is `of`){}", block.name,
                    language::did_you_mean(block.name, metric_names())));
  check_own_fields(block);
  const Field* over = block.find("over");
  int sweep = -1;
  if (metric->scope == MetricScope::sweep) {
    sweep = sweep_index(over != nullptr ? block.word("over") : "azimuth");
    if (sweep < 0 && over != nullptr)
      unknown(over->position, "Sweep", block.word("over"), sweep_names());
    else if (sweep < 0)
      diagnostics_.warning(block.position,
                           fmt::format("`{}` says nothing: no Sweep is called azimuth, and `over` "
                                       "names no other",
                                       block.name));
  } else if (over != nullptr) {
    diagnostics_.error(over->position,
                       fmt::format("`{}` is of one run, not over a Sweep", block.name));
  }
  ShownUnit shown{std::string(metric->unit)};
  if (block.given("unit")) {
    const auto own = language::parse_unit(metric->unit);
    if (const auto unit = given_unit(block, own ? own->dimension : language::Dimension{}))
      shown = {block.find("unit")->words.front(), unit->numerator / unit->denominator};
  }
  plan_.metrics.push_back(metric);
  plan_.units.push_back(std::move(shown));
  plan_.metric_sweeps.push_back(sweep);
}

std::vector<std::string> PlanBuilder::admitted_texts(const Condition& condition) const {
  const SweepPlan& sweep = plan_.sweeps[static_cast<std::size_t>(condition.sweep)];
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < sweep.si.size(); ++i)
    if (condition.holds(sweep.si[i])) texts.push_back(sweep.texts[i]);
  return texts;
}

/// ", mu = 0.8, slope from 15 deg".
std::string PlanBuilder::conditions_words(const std::vector<Condition>& conditions) const {
  std::string words;
  for (const Condition& condition : conditions) {
    const SweepPlan& sweep = plan_.sweeps[static_cast<std::size_t>(condition.sweep)];
    const std::vector<std::string> held = admitted_texts(condition);
    if (held.empty()) continue;
    const bool all_given = held.size() < 3 || condition.values;
    words += ", " + sweep.column.name +
             (all_given ? " = " + language::join(held, " or ")
                        : " from " + held.front() + " to " + held.back());
  }
  return words;
}

std::string PlanBuilder::allowed_words(const TruthPlan& truth, const std::string& within) {
  std::string words;
  if (truth.tolerance > 0.) words += " within " + output::rounded(100. * truth.tolerance) + " %";
  if (truth.within > 0.) words += (truth.tolerance > 0. ? " or " : " within ") + within;
  return words;
}

std::string PlanBuilder::number_text(const Object& block, const char* field,
                                     const std::string& unit) {
  const Field* given = block.find(field);
  if (given == nullptr) return "";
  const WrittenUnit written = written_unit(*given);
  const WrittenUnit shown =
      written.text.empty()
          ? WrittenUnit{unit, language::parse_unit(unit).value_or(language::Unit{})}
          : written;
  return output::rounded(shown.from_si(block.number(field))) +
         (shown.text.empty() ? "" : " " + shown.text);
}

std::string PlanBuilder::truth_words(const Object& block, const TruthPlan& truth) {
  const auto number = [&](const char* field) {
    return number_text(block, field, plan_.units[truth.metric].text);
  };
  std::string words(plan_.metrics[truth.metric]->name);
  if (truth.predicted) words += " equals predicted";
  if (truth.value) words += " equals " + number("value");
  if (truth.same_over >= 0)
    words +=
        " is the same over " + plan_.sweeps[static_cast<std::size_t>(truth.same_over)].column.name;
  words += allowed_words(truth, number("within"));
  if (truth.above) words += " is above " + number("above");
  if (truth.below) words += " is below " + number("below");
  words += conditions_words(truth.only);
  if (block.find("subjects") != nullptr)
    words += " (" + language::join(block.find("subjects")->words, ", ") + ")";
  return words;
}

void PlanBuilder::add_truth(const Object& block) {
  TruthPlan truth;
  const std::string metric = block.find("metric") != nullptr ? block.word("metric") : block.name;
  const std::ptrdiff_t found = measured_index(metric);
  if (found < 0) return unknown(block.position, "Measure of this study", metric, measured_names());
  truth.metric = static_cast<std::size_t>(found);
  const std::string_view unit = plan_.units[truth.metric].text;
  const auto number = [&](const char* field) {
    return block.find(field) == nullptr ? std::nullopt
                                        : std::optional(number_in(block, field, unit));
  };
  truth.value = number("value");
  truth.above = number("above");
  truth.below = number("below");
  truth.within = number("within").value_or(0.);
  truth.tolerance = block.number("tolerance");
  if (block.find("same_over") != nullptr) {
    truth.same_over = sweep_index(block.word("same_over"));
    if (truth.same_over < 0)
      unknown(block.find("same_over")->position, "Sweep", block.word("same_over"), sweep_names());
  }
  truth.predicted = block.find("equals") != nullptr && block.word("equals") == "predicted";
  if (!truth.predicted && !truth.value && !truth.above && !truth.below && truth.same_over < 0)
    diagnostics_.error(
        block.position,
        "a Truth needs `equals = predicted`, `value`, `above`, `below` or `same_over`");
  if (truth.predicted && truth.value)
    diagnostics_.error(block.find("value")->position,
                       "a Truth equals the prediction or a value, not both");
  truth.subjects = named_subjects(block);
  truth.only = conditions(block);
  truth.may_be_empty = block.boolean("may_be_empty");
  truth.name = block.name;
  truth.words = truth_words(block, truth);
  plan_.truths.push_back(std::move(truth));
}

/// The subjects that the block's `subjects` names; empty without.
std::vector<int> PlanBuilder::named_subjects(const Object& block) {
  std::vector<int> subjects;
  if (block.find("subjects") == nullptr) return subjects;
  std::vector<std::string> names;
  for (const SubjectPlan& subject : plan_.subjects) names.push_back(subject.info.name);
  for (const std::string& word : block.find("subjects")->words) {
    const auto subject = std::find(names.begin(), names.end(), word);
    if (subject == names.end()) unknown(block.find("subjects")->position, "Subject", word, names);
    subjects.push_back(static_cast<int>(subject - names.begin()));
  }
  return subjects;
}

void PlanBuilder::add_seeds(const Object& study) {
  const Field* field = study.find("seeds");
  if (field == nullptr) return;
  constexpr const char* seed = "seed";
  const auto is_seed = [&](const Assignment& fix) { return fix.parameter == seed; };
  bool taken = sweep_index(seed) >= 0 || std::ranges::any_of(plan_.fixes, is_seed);
  for (const SubjectPlan& subject : plan_.subjects)
    taken = taken || std::ranges::any_of(subject.fixes, is_seed);
  if (taken)
    return diagnostics_.error(field->position,
                              "`seeds` varies the Param `seed`: it cannot be swept or fixed");
  if (is_varied(seed))
    return diagnostics_.error(field->position,
                              "`seeds` varies the Param `seed`, which the Cases set");
  SweepPlan sweep;
  sweep.column.name = seed;
  sweep.role = SweepRole::seeds;
  for (int i = 1; i <= static_cast<int>(study.number("seeds")); ++i) {
    sweep.si.push_back(i);
    sweep.texts.push_back(std::to_string(i));
    sweep.places.push_back(field->position);
  }
  sweep.column.values = sweep.si;
  plan_.sweeps.push_back(std::move(sweep));
}

void PlanBuilder::check_only_option(const Object& study) {
  std::vector<std::string> names;
  for (const SubjectPlan& subject : plan_.subjects) names.push_back(subject.info.name);
  for (const std::string& only : options_.only)
    if (std::find(names.begin(), names.end(), only) == names.end())
      unknown(study.position, "Subject", only, names);
}

SubjectPlan subject_of(const Object& block) {
  const auto word = [&](const char* field) {
    return block.find(field) == nullptr ? std::string() : block.word(field);
  };
  SubjectPlan subject;
  subject.info.name = block.name;
  subject.engine = word("engine");
  subject.contact = word("contact");
  subject.integrator = word("integrator");
  subject.settings = word("settings");
  return subject;
}

void plan_parts(StudyPlan& plan, const Object& study, const std::filesystem::path& scene_file,
                const PlanOptions& options, Diagnostics& diagnostics) {
  PlanBuilder parts(plan, options, diagnostics);
  for (const Object* block : study.children_of("Sweep"))
    if (block->name == ground_sweep) parts.find_grounds(*block);
  for (const Object* block : study.children_of("Sweep")) parts.add_sweep(*block);
  const auto cases = study.children_of("Cases");
  for (const Object* block : cases) parts.add_cases(*block);
  // What else names the cases is not wrong where they could not be read.
  if (!cases.empty() && plan.case_sweep() < 0) return;
  for (const Object* block : study.children_of("Subject")) parts.add_subject(*block);
  plan.fixes = parts.fixes(study);
  std::unique_ptr<Object> scene;
  Diagnostics untold;
  if (!diagnostics.has_errors()) {
    const bool own = std::ranges::any_of(study.children_of("Measure"), is_own_metric) ||
                     std::ranges::any_of(cases, has_traces);
    scene = lay_first(plan, scene_file, own ? diagnostics : untold);
    if (scene && own) write_step(*scene);
  }
  std::optional<SceneNames> known;
  if (scene) {
    known.emplace(*scene, words_of(plan, first_row(plan, scene_file)));
    known->expect_words(words_in(study));
    parts.know(&*known);
  }
  parts.add_curves(study);
  for (const Object* block : study.children_of("Measure")) parts.add_metric(*block);
  if (scene && study.boolean("expects")) parts.add_expectations();
  for (const Object* block : study.children_of("Truth")) parts.add_truth(*block);
  for (const Object* block : study.children_of("Plot")) parts.add_plot(*block);
  for (const Object* block : study.children_of("Table")) parts.add_table(*block);
  for (const Object* block : study.children_of("Claim")) parts.add_claim(*block);
  parts.add_seeds(study);
  parts.check_only_option(study);
  parts.check_size(study);
}

}  // namespace hookpoint::studies
