#include <vector>

#include "application/application.h"
#include "application/study_plans.h"
#include "application/tune_plans.h"
#include "cli/commands.h"

namespace hookpoint::cli {

std::optional<std::string> command_for(const std::filesystem::path& file,
                                       const application::Settings& settings, bool allow_plugins) {
  std::vector<language::Diagnostics> found;
  application::Application application(
      allow_plugins,
      [&](const language::Diagnostics& diagnostics) { found.push_back(diagnostics); });
  const auto root = application::evaluate_file(application, application.find(file), settings).root;
  if (root)
    return application::holds_study(*root)  ? "study"
           : application::holds_tune(*root) ? "tune"
                                            : "run";
  application.locate(file);
  for (const language::Diagnostics& diagnostics : found)
    application::print_diagnostics(diagnostics);
  return std::nullopt;
}

}  // namespace hookpoint::cli
