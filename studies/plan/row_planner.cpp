#include "studies/plan/row_planner.h"

#include <utility>

#include "simulation/engine_interface/identity.h"
#include "studies/measure/workers.h"
#include "studies/results/selection.h"

namespace hookpoint::studies {
namespace {

constexpr std::size_t most_waiting = 64;

/// Distinct words in their order: "hookpoint or bristle".
void add_word(std::string& words, const std::string& word) {
  if (word.empty() || (" or " + words + " or ").find(" or " + word + " or ") != std::string::npos)
    return;
  words += (words.empty() ? "" : " or ") + word;
}

/// A scene may set engine, law and integrator itself, and so may a Sweep: the table names all that
/// are in force.
void complete_subjects(StudyPlan& plan) {
  for (SubjectPlan& subject : plan.subjects) {
    subject.info.engine.clear();
    subject.info.available = false;
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

}  // namespace

bool RowPlanner::add(RowPlan row) {
  waiting_.push_back(std::move(row));
  return waiting_.size() < most_waiting || finish();
}

bool RowPlanner::finish() {
  std::vector<RowPlan> rows;
  rows.swap(waiting_);
  std::vector<LoadedRow> loaded(rows.size());
  work_through(rows.size(), jobs_, [&](std::size_t i) {
    loaded[i] = load(rows[i]);
    return true;
  });
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!add_loaded(std::move(loaded[i]), std::move(rows[i]))) return false;
  return true;
}

void RowPlanner::complete(const language::Object& root) {
  plan_.hash = hash.text();
  for (std::string& source : language::sources_of(root)) inputs.insert(std::move(source));
  plan_.inputs = simulation::hashed(inputs);
  complete_subjects(plan_);
}

void RowPlanner::take(const LoadedScene& scene, LoadedRow& loaded) const {
  const simulation::Experiment& experiment = scene.experiment;
  loaded.loads = true;
  loaded.hash = scene.hash();
  loaded.contact = experiment.contact;
  loaded.integrator = experiment.integrator;
  loaded.has_ground = experiment.terrain.has_value();
  loaded.deltat = experiment.deltat;
  loaded.duration = experiment.duration;
  loaded.seed = experiment.seed;
  loaded.composition = composition_of(experiment, engines_);
  loaded.sources = scene.sources();
}

void RowPlanner::warn_of_step(const language::Position& place, const std::string& who,
                              const RowPlan& row, const std::string& what) {
  diagnostics_.warning(place, what);
  diagnostics_.note(place, "with subject = " + planned_subject(row).info.name);
  plan_.warnings.push_back(who + ": " + what);
}

bool RowPlanner::add_loaded(LoadedRow loaded, RowPlan row) {
  const Answer answer = accept(loaded, row);
  if (answer != Answer::taken) return answer == Answer::dropped;
  row.engine = loaded.composition.engine;
  row.hash = std::move(loaded.hash);
  hash.add(row.hash);
  inputs.merge(loaded.sources);
  plan_.seeds.insert(loaded.seed);
  if (plan_.rows.empty()) plan_.scene_printed = std::move(loaded.printed);
  row.composition = composition_index(std::move(loaded.composition));
  plan_.rows.push_back(std::move(row));
  return true;
}

int RowPlanner::composition_index(SubjectInfo made) {
  const auto key = std::make_tuple(made.engine, made.law, made.integrator, made.settings);
  const auto [place, fresh] =
      compositions_.try_emplace(key, static_cast<int>(plan_.compositions.size()));
  if (fresh) plan_.compositions.push_back(std::move(made));
  return place->second;
}

}  // namespace hookpoint::studies
