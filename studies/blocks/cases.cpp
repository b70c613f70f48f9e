#include "studies/blocks/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "language/names.h"
#include "studies/blocks/block.h"
#include "studies/blocks/case_table.h"
#include "studies/blocks/study.h"
#include "studies/blocks/study_parts.h"
#include "studies/blocks/trace.h"
#include "text/number.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

const Fields<CasesBlock>& cases_fields() {
  static const Fields<CasesBlock> fields{
      required(text_field("file", &CasesBlock::file,
                          "the table of the cases, comma-separated, with titles like `z [m]`")),
      required(words_field("case", 1, &CasesBlock::case_column,
                           "title of the column that says which case a row is of, here and in the "
                           "Traces' tables")),
      or_words(values_field("quick_values", &CasesBlock::quick_values,
                            "of a Study, the cases under --quick; default: first and last"))};
  return fields;
}

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
    if (error != std::errc{} || read != end || text::shortest(number) != one.name)
      return std::nullopt;
  }
  return numbers;
}

/// `all`: names of the cases of the table, of which --quick leaves some out.
SweepPlan sweep_over(const Object& block, const std::vector<CaseRow>& cases,
                     const std::vector<CaseRow>& all) {
  SweepPlan sweep;
  sweep.column = {block.name, "", {}, {}};
  sweep.role = SweepRole::cases;
  const auto every = numbers_of(all);
  const auto numbers = every ? numbers_of(cases) : std::nullopt;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    sweep.si.push_back(numbers ? (*numbers)[i] : static_cast<double>(i));
    if (!numbers) sweep.column.words.push_back(cases[i].name);
    sweep.texts.push_back(cases[i].name);
    sweep.places.push_back(cases_block(block).file.position());
    sweep.settings.push_back(cases[i].settings);
  }
  sweep.column.values = sweep.si;
  for (std::size_t i = 0; i < all.size(); ++i) {
    sweep.declared.push_back(every ? (*every)[i] : static_cast<double>(i));
    sweep.declared_texts.push_back(all[i].name);
    if (!every) sweep.declared_words.push_back(all[i].name);
  }
  return sweep;
}

/// The file that the field names, kept among those that were measured; empty after an error.
std::filesystem::path measured_file(const Placed<std::string>& name, StudyParts& so_far,
                                    Diagnostics& diagnostics) {
  std::filesystem::path found = so_far.library->find(*name, so_far.file);
  if (found.empty())
    diagnostics.error(name.position(),
                      fmt::format("no file \"{}\" beside the study or in configs/", *name));
  else if (std::ranges::find(so_far.measured_files, found) == so_far.measured_files.end())
    so_far.measured_files.push_back(found);
  return found;
}

/// Those of the cases that run under --quick; after an error all, as what names them is not wrong.
std::vector<CaseRow> quick_cases(const CasesBlock& block, const std::vector<CaseRow>& cases,
                                 Diagnostics& diagnostics) {
  if (block.quick_values == nullptr)
    return cases.size() > 2 ? std::vector<CaseRow>{cases.front(), cases.back()} : cases;
  const language::Field& field = *block.quick_values;
  std::vector<std::string> names = field.words;
  if (names.empty())
    for (const double number : field.numbers) names.push_back(text::shortest(number));
  std::vector<CaseRow> chosen;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::ranges::find(cases, names[i], &CaseRow::name);
    if (found != cases.end())
      chosen.push_back(*found);
    else
      diagnostics.error(i < field.places.size() ? field.places[i] : field.position,
                        fmt::format("no case is called `{}`", names[i]));
  }
  return chosen.size() == names.size() ? chosen : cases;
}

void read_curves(const Object& block, SceneNames& scene, StudyParts& so_far,
                 Diagnostics& diagnostics) {
  const TraceSource source{
      [&](const Placed<std::string>& name) { return measured_file(name, so_far, diagnostics); },
      [&](const std::string& trail, std::string& why) -> std::optional<TracePort> {
        const auto port = scene.port(trail, why);
        if (!port) return std::nullopt;
        return TracePort{port->trail,
                         port->dimension ? language::unit_text(*port->dimension) : "?"};
      },
      diagnostics};
  auto traces = TraceReader(source).read_cases(block, so_far.cases);
  if (!traces) return;
  const auto blocks = block.children_of("Trace");
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    MeasuredCurves& curves = so_far.curves.emplace_back();
    curves.name = blocks[i]->name;
    const TraceBlock trace = trace_block(*blocks[i]);
    for (const std::string& part : *trace_parts(trace.column->size()))
      curves.ports.push_back(*trace.of + part);
    for (std::vector<TracePlan>& of_case : *traces) {
      of_case[i].weight = 1.;
      curves.cases.push_back(std::make_shared<const TracePlan>(std::move(of_case[i])));
    }
  }
}

/// Each case lasts up to its last sample.
void last_as_measured(const Object& study, StudyParts& so_far, Diagnostics& diagnostics) {
  if (so_far.curves.empty())
    return diagnostics.error(study.position,
                             "this Study needs `duration` [s]: it has no Cases with Traces, which "
                             "say how long each was measured");
  SweepPlan& sweep = so_far.sweeps[static_cast<std::size_t>(so_far.case_sweep())];
  for (std::size_t i = 0; i < so_far.cases.size(); ++i) {
    double& last = sweep.durations.emplace_back();
    for (const MeasuredCurves& curves : so_far.curves)
      last = std::max(last, curves.cases[i]->measured.time.back());
    if (so_far.settle >= last)
      return diagnostics.error(
          study_block(study).settle.position_or(study.position),
          fmt::format("{} {} was measured for {} s, which must be longer than settle",
                      sweep.column.name, sweep.texts[i], text::rounded(last, 6)));
  }
  so_far.duration = std::ranges::max(sweep.durations);
}

}  // namespace

void add_cases_class(language::Schema& schema) {
  schema.add(block_class(
      "Cases",
      "Runs that were measured, from tables: a row a case, whose columns set the Params that are "
      "called like them, and curves of many cases in the tables of its Traces. Of a Study it is "
      "an axis, as a Sweep is.",
      schemas(cases_fields()), {"Trace", "Only"}));
}

CasesBlock cases_block(const Object& block) { return load_fields(block, cases_fields()); }

void load_cases(const Object& object, StudyParts& so_far, Diagnostics& diagnostics) {
  if (so_far.case_sweep() >= 0)
    return diagnostics.error(object.position,
                             "a Study has one Cases block: its Traces are of one run each");
  if (so_far.sweep_index(object.name) >= 0 ||
      std::ranges::find(taken_names, object.name) != taken_names.end())
    return diagnostics.error(
        object.position,
        fmt::format("Cases cannot be called `{}`: the study has another column of that name",
                    object.name));
  const CasesBlock block = cases_block(object);
  const std::filesystem::path file = measured_file(block.file, so_far, diagnostics);
  if (file.empty()) return;
  const auto table = read_cases(object, file, so_far.parameters(), diagnostics);
  if (!table) return;
  for (const std::string& parameter : table->parameters)
    if (so_far.sweep_index(parameter) >= 0)
      diagnostics.error(block.file.position(),
                        fmt::format("`{}` is swept: the column of {} cannot set it as well",
                                    parameter, file.string()));
  so_far.cases = so_far.quick ? quick_cases(block, table->cases, diagnostics) : table->cases;
  so_far.sweeps.push_back(sweep_over(object, so_far.cases, table->cases));
}

void load_curves(const Object& study, SceneNames* scene, StudyParts& so_far,
                 Diagnostics& diagnostics) {
  for (const Object* block : study.children_of("Cases"))
    if (scene != nullptr && so_far.case_sweep() >= 0)
      read_curves(*block, *scene, so_far, diagnostics);
  if (diagnostics.has_errors()) return;
  // The study says none.
  if (so_far.duration == 0.) last_as_measured(study, so_far, diagnostics);
}

}  // namespace hookpoint::studies
