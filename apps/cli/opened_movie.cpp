#include "apps/cli/opened_movie.h"

#include <fmt/format.h>

#include "apps/cli/exit_status.h"
#include "apps/cli/interrupt.h"
#include "language/document/document.h"
#include "simulation/scene/load.h"

namespace hookpoint::cli {
OpenedMovie::OpenedMovie(const std::filesystem::path& file, application::Consent consent)
    : reader_(file), application_(consent), folder_("movie") {}

simulation::Experiment OpenedMovie::load() {
  const output::MovieHeader& header = reader_.header();
  std::vector<simulation::FileSpec> files;
  for (std::size_t i = 0; i < header.files.size(); ++i) {
    const output::MovieFile& file = header.files[i];
    const std::filesystem::path place =
        folder_.path() /
        fmt::format("{}-{}", i, std::filesystem::path(file.name).filename().string());
    output::write_file(place, file.content);
    files.push_back({file.name, place.string()});
  }
  const std::filesystem::path text = folder_.path() / "experiment.hook";
  output::write_file(text, header.experiment);
  const auto fail = [] {
    throw output::MovieError("the experiment inside the movie cannot be loaded");
  };
  if (!application_.load_plugins(text)) fail();
  root_ = application_.evaluate(text, {});
  if (!root_) fail();
  language::Diagnostics diagnostics;
  auto experiment = simulation::load_experiment(*root_, diagnostics, {}, files);
  application::print_diagnostics(diagnostics);
  if (!experiment) fail();
  return *experiment;
}

simulation::World OpenedMovie::make_world(const simulation::Experiment& experiment) const {
  return {experiment, application_.make_engine(experiment)};
}

double seconds(const std::string& text, const char* option) {
  if (const auto value = language::number_of(text, "s")) return *value;
  throw output::MovieError(
      fmt::format("{} takes a time such as \"2.5 s\" or \"300 ms\", not `{}`", option, text));
}

int use_movie(simulation::Rewind& rewind, const std::function<int()>& work) {
  const InterruptGuard guard;
  rewind.stop_when(guard.stop());
  const int status = use_movie(work);
  return guard.stop() ? guard.status() : status;
}

int use_movie(const std::function<int()>& work) {
  try {
    return work();
  } catch (const output::MovieError& error) {
    application::print_error(error.what());
  } catch (const simulation::ExperimentError& error) {
    application::print_error(error.what());
  }
  return wrong_input;
}

}  // namespace hookpoint::cli
