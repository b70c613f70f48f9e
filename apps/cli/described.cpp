#include "apps/cli/described.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <set>
#include <utility>

#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "language/names.h"
#include "output/files/csv.h"
#include "reference/engines.h"
#include "simulation/experiment/material_fields.h"
#include "studies/measure/metric.h"

namespace hookpoint::cli {
namespace {

using language::ClassSchema;

/// A name and what there is to say of it.
struct Entry {
  std::string name, text;
};

std::string constant_names(const contact::ConstantList& constants) {
  std::vector<std::string> names;
  for (const contact::Constant constant : constants)
    names.emplace_back(simulation::field_of(constant).name);
  return language::join(names, ", ");
}

void add_laws(std::vector<Entry>& entries) {
  for (const contact::LawDescription& law : contact::law_table()) {
    std::string text =
        fmt::format("{}, contact law\n  {}\n  source: {}\n  constants that it reads: {}\n",
                    law.name, law.summary, law.source, constant_names(law.constants));
    if (law.own_constants.size() > 0)
      text += fmt::format("  of them its own: {}\n", constant_names(law.own_constants));
    text += fmt::format("  chosen by: contact = {}; in the World, or --contact {}\n", law.name,
                        law.name);
    entries.push_back({std::string(law.name), std::move(text)});
  }
}

void add_integrators(std::vector<Entry>& entries) {
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    const std::string order =
        stepper.adaptive() ? "chooses its own steps" : fmt::format("order {}", stepper.order);
    entries.push_back(
        {std::string(stepper.name),
         fmt::format("{}, integrator, {}\n  {}\n  chosen by: integrator = {}; in the "
                     "World, or --integrator {}\n",
                     stepper.name, order, stepper.summary, stepper.name, stepper.name)});
  }
}

/// A program is started only where it is the one that is `wanted`.
void add_engines(const application::Application& application, const std::string& wanted,
                 std::vector<Entry>& entries) {
  for (const auto& [name, engine] : application.engines()) {
    if (engine.is_program && name != wanted) {
      entries.push_back({name, ""});
      continue;
    }
    const simulation::EngineDescription of = engine.describe();
    std::string text =
        fmt::format("{}, engine\n  version {}, {} precision{}\n", name, of.version, of.precision,
                    of.found             ? ""
                    : of.missing.empty() ? "; not found in this build"
                                         : "; not found: " + of.missing);
    text += fmt::format("  settings: {}\n", fmt::join(of.settings, ", "));
    for (const simulation::EngineGap& gap : of.gaps)
      text += fmt::format("  {}: {}\n", gap.feature, gap.instead);
    text += fmt::format("  chosen by: engine = {}; in the World, or --engine {}\n", name, name);
    entries.push_back({name, std::move(text)});
  }
}

/// A setting's constants, engine by engine.
void add_engine_settings(std::vector<Entry>& entries) {
  std::map<std::string, std::string> texts;
  for (const reference::Peer& peer : reference::known_peers()) {
    for (const std::string& name : peer.settings_names()) {
      std::string& text = texts[name];
      if (text.empty()) text = fmt::format("{}, settings of reference engines\n", name);
      text += fmt::format("  {}\n", peer.name);
      for (const reference::OwnSetting& own : peer.own_settings)
        if (name == own.name) text += fmt::format("    {}\n", own.doc);
      const auto setting = reference::settings_named(name, peer);
      if (!setting || peer.settings_table == nullptr) continue;
      for (const reference::SettingRow& row : peer.settings_table())
        text += fmt::format("    {}: {}\n", row.quantity, row.at(*setting));
    }
  }
  for (auto& [name, text] : texts) entries.push_back({name, std::move(text)});
}

void add_measurements(std::vector<Entry>& entries) {
  for (const studies::MetricDefinition& metric : studies::metric_table())
    entries.push_back(
        {std::string(metric.name),
         fmt::format("{}\n  {}\n",
                     output::column_title(std::string(metric.name), std::string(metric.unit)),
                     metric.doc)});
  for (const studies::SignalDefinition& signal : studies::signal_table())
    entries.push_back(
        {std::string(signal.name),
         fmt::format("{}, over time in a Plot of a Study\n  {}\n",
                     output::column_title(std::string(signal.name), std::string(signal.unit)),
                     signal.doc)});
}

/// The classes for which `fits` holds, as `name of a class, its schema`.
template <class Fits>
std::vector<std::pair<std::string, const ClassSchema*>> classes_where(
    const language::Schema& schema, const Fits& fits) {
  std::vector<std::pair<std::string, const ClassSchema*>> found;
  for (const auto& [name, entry] : schema.classes())
    if (fits(name, entry)) found.emplace_back(name, &entry);
  return found;
}

std::string last_word(const std::string& name) { return name.substr(name.rfind('.') + 1); }

/// What to look up in the place of a `name` that is none of `names`.
std::string instead_of(const std::string& name, const std::vector<std::string>& names) {
  if (std::string nearest = language::did_you_mean(name, names); !nearest.empty()) return nearest;
  constexpr std::size_t shortest = 3, most = 12;
  std::set<std::string> longer;
  for (const std::string& one : names)
    if (name.size() >= shortest && one.find(name) != std::string::npos) longer.insert(one);
  if (!longer.empty() && longer.size() <= most)
    return fmt::format("; it is part of {}", fmt::join(longer, ", "));
  return "; `hookpoint describe` lists the classes, `hookpoint engines` the laws, integrators and "
         "engines";
}

}  // namespace

std::vector<std::string> described(const application::Application& application,
                                   const std::string& name, std::string& problem) {
  const language::Schema& schema = application.schema();
  std::vector<std::string> texts;
  for (const auto& [full, found] : classes_where(schema, [&](const auto&full, const auto&entry) {
         return full == name || entry.name == name;
       }))
    texts.push_back(language::describe(*found, schema));
  std::vector<Entry> entries;
  add_measurements(entries);
  add_laws(entries);
  add_integrators(entries);
  add_engines(application, name, entries);
  add_engine_settings(entries);
  for (const Entry& entry : entries)
    if (entry.name == name) texts.push_back(entry.text);
  if (!texts.empty()) return texts;

  const auto called_so = classes_where(
      schema, [&](const auto&, const auto& entry) { return last_word(entry.name) == name; });
  if (called_so.size() == 1) return {language::describe(*called_so.front().second, schema)};
  std::vector<std::string> names;
  for (const auto& [full, found] : called_so) names.push_back(full);
  if (!names.empty()) {
    problem = fmt::format("`{}` is the end of several names: {}", name, fmt::join(names, ", "));
    return {};
  }
  for (const auto& [full, entry] : schema.classes()) {
    names.push_back(full);
    if (full != entry.name) names.push_back(entry.name);
  }
  for (const Entry& entry : entries) names.push_back(entry.name);
  problem = "there is no class, metric, contact law, integrator, engine or setting `" + name + "`" +
            instead_of(name, names);
  return {};
}

}  // namespace hookpoint::cli
