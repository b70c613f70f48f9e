#include <vector>

#include "apps/cli/commands.h"
#include "apps/shared/application.h"
#include "apps/shared/task_file.h"

namespace hookpoint::cli {

std::optional<std::string> command_for(const std::filesystem::path& file,
                                       const application::Settings& settings,
                                       application::Consent consent) {
  std::vector<language::Diagnostics> found;
  application::Application application(
      consent, [&](const language::Diagnostics& diagnostics) { found.push_back(diagnostics); });
  const auto root = application::evaluate_file(application, application.find(file), settings).root;
  if (root) {
    for (const application::TaskCommand* command : application::task_commands)
      if (studies::holds_task(*root, command->name)) return command->name;
    return "run";
  }
  application.locate(file);
  for (const language::Diagnostics& diagnostics : found)
    application::print_diagnostics(diagnostics);
  return std::nullopt;
}

}  // namespace hookpoint::cli
