#include "cli/live_file.h"

#include <sstream>

#include "simulation/scene/load.h"

namespace hookpoint::cli {

LiveFile::LiveFile(std::filesystem::path file, application::Settings settings, bool allow_plugins)
    : application_(allow_plugins,
                   [this](const language::Diagnostics& diagnostics) {
                     application::print_diagnostics(diagnostics);
                     if (!diagnostics.has_errors()) return;
                     std::ostringstream text;
                     diagnostics.print(text, false);
                     told_ += text.str();
                   }),
      file_(application_.locate(file)),
      settings_(std::move(settings)) {}

simulation::Load LiveFile::loader(std::vector<std::pair<std::string, std::string>> fields) {
  return [this, fields = std::move(fields)](const std::vector<std::string>& overrides,
                                            std::string& problem) {
    return load(fields, overrides, problem);
  };
}

void LiveFile::read_anew() { application_.read_anew(); }

std::optional<simulation::LoadedExperiment> LiveFile::load(
    const std::vector<std::pair<std::string, std::string>>& fields,
    const std::vector<std::string>& overrides, std::string& problem) {
  told_.clear();
  application::Settings settings = settings_;
  settings.world.insert(settings.world.end(), fields.begin(), fields.end());
  settings.trails.insert(settings.trails.end(), overrides.begin(), overrides.end());
  auto root = application_.evaluate_set(file_, settings);
  auto experiment = root ? application_.load(*root) : std::nullopt;
  if (!experiment) {
    problem = told_.empty() ? "the file cannot be loaded" : told_;
    return std::nullopt;
  }
  simulation::write_chosen_step(*experiment, *root);
  simulation::LoadedExperiment loaded{std::move(*experiment), language::print(*root),
                                      language::sources_of(*root), {}, {}};
  loaded.engine = application_.describe_engine(loaded.experiment);
  loaded.make_engine = [this](const simulation::Experiment& made) {
    return application_.make_engine(made);
  };
  if (fields.empty()) root_ = std::move(root);
  return loaded;
}

}  // namespace hookpoint::cli
