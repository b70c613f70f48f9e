// A Cases block as an axis of the study, and the curves that its Traces have of each case.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "language/names.h"
#include "output/text/number.h"
#include "studies/measurements/trace_blocks.h"
#include "studies/plan/plan_builder.h"

namespace hookpoint::studies {

using language::Object;

namespace {

/// Columns of results.csv, and what else a Table or a Plot calls by such a name.
const std::vector<std::string> taken_names{"subject",  "engine",  "law",  "contact", "integrator",
                                           "settings", "terrain", "seed", "time",    "status"};

/// The numbers that the cases are called by; nothing where one is called otherwise than results.csv
/// writes its number.
std::optional<std::vector<double>> numbers_of(const std::vector<CaseRow>& cases) {
  std::vector<double> numbers;
  for (const CaseRow& one : cases) {
    const char* const end = one.name.data() + one.name.size();
    double& number = numbers.emplace_back();
    const auto [read, error] = std::from_chars(one.name.data(), end, number);
    if (error != std::errc{} || read != end || output::shortest(number) != one.name)
      return std::nullopt;
  }
  return numbers;
}

SweepPlan sweep_over(const Object& block, std::vector<CaseRow>& cases) {
  SweepPlan sweep;
  sweep.column = {block.name, "", {}, {}};
  sweep.role = SweepRole::cases;
  const auto numbers = numbers_of(cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    sweep.si.push_back(numbers ? (*numbers)[i] : static_cast<double>(i));
    if (!numbers) sweep.column.words.push_back(cases[i].name);
    sweep.texts.push_back(cases[i].name);
    sweep.places.push_back(block.find("file")->position);
    sweep.settings.push_back(cases[i].settings);
  }
  sweep.column.values = sweep.si;
  return sweep;
}

}  // namespace

std::filesystem::path PlanBuilder::measured_file(const Object& block, const char* field) {
  std::filesystem::path found = plan_.library->find(block.word(field), plan_.file);
  if (found.empty())
    diagnostics_.error(
        block.find(field)->position,
        fmt::format("no file \"{}\" beside the study or in configs/", block.word(field)));
  else if (std::ranges::find(plan_.measured_files, found) == plan_.measured_files.end())
    plan_.measured_files.push_back(found);
  return found;
}

void PlanBuilder::add_cases(const Object& block) {
  if (plan_.case_sweep() >= 0)
    return diagnostics_.error(block.position,
                              "a Study has one Cases block: its Traces are of one run each");
  if (sweep_index(block.name) >= 0 ||
      std::ranges::find(taken_names, block.name) != taken_names.end())
    return diagnostics_.error(
        block.position,
        fmt::format("Cases cannot be called `{}`: the study has another column of that name",
                    block.name));
  const std::filesystem::path file = measured_file(block, "file");
  if (file.empty()) return;
  auto table = read_cases(block, file, parameters_, diagnostics_);
  if (!table) return;
  for (const std::string& parameter : table->parameters)
    if (sweep_index(parameter) >= 0)
      diagnostics_.error(block.find("file")->position,
                         fmt::format("`{}` is swept: the column of {} cannot set it as well",
                                     parameter, file.string()));
  cases_ = std::move(table->cases);
  if (options_.quick) choose_quick_cases(block);
  plan_.sweeps.push_back(sweep_over(block, cases_));
}

void PlanBuilder::choose_quick_cases(const Object& block) {
  if (!block.given("quick_values")) {
    if (cases_.size() > 2) cases_ = {cases_.front(), cases_.back()};
    return;
  }
  const language::Field& field = *block.find("quick_values");
  std::vector<std::string> names = field.words;
  if (names.empty())
    for (const double number : field.numbers) names.push_back(output::shortest(number));
  std::vector<CaseRow> chosen;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::ranges::find(cases_, names[i], &CaseRow::name);
    if (found != cases_.end())
      chosen.push_back(*found);
    else
      diagnostics_.error(i < field.places.size() ? field.places[i] : field.position,
                         fmt::format("no case is called `{}`", names[i]));
  }
  // After an error all stay: what names them is not wrong.
  if (chosen.size() == names.size()) cases_ = std::move(chosen);
}

void PlanBuilder::add_curves(const Object& study) {
  for (const Object* block : study.children_of("Cases"))
    if (scene_ != nullptr && plan_.case_sweep() >= 0) read_curves(*block);
  if (diagnostics_.has_errors()) return;
  // The study says none.
  if (plan_.duration == 0.) last_as_measured(study);
}

void PlanBuilder::read_curves(const Object& block) {
  const TraceSource source{
      [this](const Object& trace, const char* field) { return measured_file(trace, field); },
      [this](const std::string& trail, std::string& why) -> std::optional<TracePort> {
        const auto port = scene_->port(trail, why);
        if (!port) return std::nullopt;
        return TracePort{port->trail,
                         port->dimension ? language::unit_text(*port->dimension) : "?"};
      },
      diagnostics_};
  auto traces = TraceReader(source).read_cases(block, cases_);
  if (!traces) return;
  const auto blocks = block.children_of("Trace");
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    MeasuredCurves& curves = plan_.curves.emplace_back();
    curves.name = blocks[i]->name;
    for (const std::string& part : *trace_parts(blocks[i]->find("column")->words.size()))
      curves.ports.push_back(blocks[i]->word("of") + part);
    for (std::vector<TracePlan>& of_case : *traces) {
      of_case[i].weight = 1.;
      curves.cases.push_back(std::make_shared<const TracePlan>(std::move(of_case[i])));
    }
  }
}

void PlanBuilder::last_as_measured(const Object& study) {
  if (plan_.curves.empty())
    return diagnostics_.error(study.position,
                              "this Study needs `duration` [s]: it has no Cases with Traces, which "
                              "say how long each was measured");
  SweepPlan& sweep = plan_.sweeps[static_cast<std::size_t>(plan_.case_sweep())];
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    double& last = sweep.durations.emplace_back();
    for (const MeasuredCurves& curves : plan_.curves)
      last = std::max(last, curves.cases[i]->measured.time.back());
    if (plan_.settle >= last)
      return diagnostics_.error(
          study.find("settle")->position,
          fmt::format("{} {} was measured for {} s, which must be longer "
                      "than settle",
                      sweep.column.name, sweep.texts[i], output::rounded(last, 6)));
  }
  plan_.duration = std::ranges::max(sweep.durations);
}

std::optional<language::FormulaUnit> PlanBuilder::set_trace(UserMetric& metric,
                                                            const Object& block) {
  const language::Field& field = *block.find("trace");
  metric.trace = field.words.front();
  if (block.given("of")) {
    diagnostics_.error(field.position, "a metric is `of` ports or of a `trace`, not both");
    return std::nullopt;
  }
  std::vector<std::string> known;
  for (const Object* cases : block.parent->children_of("Cases"))
    for (const Object* trace : cases->children_of("Trace")) known.push_back(trace->name);
  if (std::ranges::find(known, metric.trace) == known.end())
    unknown(field.position, "Trace of the study's Cases", metric.trace, known);
  const auto curves = std::ranges::find(plan_.curves, metric.trace, &MeasuredCurves::name);
  // A Trace that could not be read has its error already.
  if (curves == plan_.curves.end()) return std::nullopt;
  const TracePlan& trace = *curves->cases.front();
  metric.trails = trace.parts;
  const language::Dimension radians{0, 0, 0, 1};
  return language::FormulaUnit{trace.is_orientation() ? radians : trace.measured.unit.dimension};
}

}  // namespace hookpoint::studies
