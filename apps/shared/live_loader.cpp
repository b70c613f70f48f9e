#include "apps/shared/live_loader.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "language/document/document.h"
#include "simulation/scene/load.h"
#include "text/number.h"

namespace hookpoint::application {
namespace {

std::string text_of(const language::Diagnostics& diagnostics) {
  std::ostringstream text;
  diagnostics.print(text, false);
  return text.str();
}

}  // namespace

LiveLoader::LiveLoader(std::filesystem::path file, Settings settings, Consent consent,
                       std::optional<std::filesystem::path> movie, const LiveLoader* leader)
    : file_(std::move(file)),
      settings_(std::move(settings)),
      consent_(consent),
      movie_(std::move(movie)),
      leader_(leader) {}

/// Files are read once in an application's life.
void LiveLoader::read_anew() {
  root_.reset();
  application_ =
      std::make_shared<Application>(consent_, [this](const language::Diagnostics& found) {
        if (found.has_errors())
          told_ += text_of(found);
        else
          print_diagnostics(found);
      });
  found_ = application_->find(file_);
  if (!robot_world_) {
    robot_world_ = world_of_robot(*application_, found_, consent_);
    if (!robot_world_) return;
    language::Diagnostics said;
    said.note({}, robot_world_->note);
    application_->tell(said);
  }
  application_->give(robot_world_->file, robot_world_->text);
  found_ = robot_world_->file;
}

const simulation::LoadedExperiment* LiveLoader::load_first(std::string& problem) {
  first_ = evaluate({}, problem);
  return first_ ? &*first_ : nullptr;
}

std::optional<simulation::LoadedExperiment> LiveLoader::load(
    const std::vector<std::string>& overrides, std::string& problem) {
  if (overrides.empty() && first_) return std::exchange(first_, std::nullopt);
  return evaluate(overrides, problem);
}

std::optional<simulation::LoadedExperiment> LiveLoader::evaluate(
    const std::vector<std::string>& overrides, std::string& problem) {
  if (overrides.empty() || !application_) read_anew();
  told_.clear();
  std::unique_ptr<language::Object> root;
  if (application_->load_plugins(found_)) {
    std::vector<std::string> all;
    if (leader_ != nullptr) all = leader_->step_;
    all.insert(all.end(), settings_.trails.begin(), settings_.trails.end());
    for (const auto& [field, value] : settings_.world)
      std::ranges::move(application_->world_settings(found_, field, value, settings_.trails),
                        std::back_inserter(all));
    if (!overrides.empty()) all.insert(all.end(), step_.begin(), step_.end());
    // What is edited last counts.
    all.insert(all.end(), overrides.begin(), overrides.end());
    root = application_->evaluate(found_, all);
  }
  std::optional<simulation::Experiment> experiment;
  if (root) experiment = application_->load(*root);
  if (!experiment) {
    problem = told_;
    while (problem.ends_with('\n')) problem.pop_back();
    return std::nullopt;
  }
  if (overrides.empty()) {
    step_.clear();
    if (experiment->chosen_from)
      step_.push_back(experiment->world + ".deltat=" + text::shortest(experiment->deltat));
  }
  try {
    simulation::write_chosen_step(*experiment, *root);
    if (movie_) simulation::add_movie(*movie_, *experiment);
  } catch (const simulation::ExperimentError& error) {
    problem = error.what();
    return std::nullopt;
  }
  simulation::LoadedExperiment loaded{
      std::move(*experiment), language::print(*root), language::sources_of(*root), {}, {}};
  loaded.engine = application_->describe_engine(loaded.experiment);
  loaded.make_engine = [application = application_](const simulation::Experiment& of) {
    return application->make_engine(of);
  };
  root_ = std::move(root);
  return loaded;
}

}  // namespace hookpoint::application
