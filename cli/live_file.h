// A file whose run people may change: loaded again with what they edited, and as it now stands when
// it was saved.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "application/application.h"
#include "simulation/run/live_run.h"

namespace hookpoint::cli {

class LiveFile {
 public:
  /// `settings`: of the command line. Throws nothing.
  LiveFile(std::filesystem::path file, application::Settings settings, bool allow_plugins);

  /// For a run of it. `fields`: of the World, set beside the command line's: a subject's. The
  /// function refers to this.
  simulation::Load loader(std::vector<std::pair<std::string, std::string>> fields = {});
  /// The file is read from the disk again when it is next loaded.
  void read_anew();

  application::Application& application() { return application_; }
  const std::filesystem::path& file() const { return file_; }
  /// Of the run itself, as loaded last.
  const language::Object& root() const { return *root_; }

 private:
  std::optional<simulation::LoadedExperiment> load(
      const std::vector<std::pair<std::string, std::string>>& fields,
      const std::vector<std::string>& overrides, std::string& problem);

  std::string told_;  ///< what was wrong with the last load
  application::Application application_;
  std::filesystem::path file_;
  application::Settings settings_;
  std::unique_ptr<language::Object> root_;
};

}  // namespace hookpoint::cli
