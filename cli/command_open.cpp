#include <vector>

#include "cli/application.h"
#include "cli/commands.h"
#include "cli/study_plans.h"

namespace hookpoint::cli {

std::optional<bool> holds_study(const std::filesystem::path& file, const Settings& settings,
                                bool allow_plugins) {
  std::vector<language::Diagnostics> found;
  Application application(allow_plugins, [&](const language::Diagnostics& diagnostics) {
    found.push_back(diagnostics);
  });
  const auto root = evaluate_file(application, application.find(file), settings).root;
  if (root) return holds_study(*root);
  application.locate(file);
  for (const language::Diagnostics& diagnostics : found) print_diagnostics(diagnostics);
  return std::nullopt;
}

}  // namespace hookpoint::cli
