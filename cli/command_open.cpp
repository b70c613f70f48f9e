#include "cli/application.h"
#include "cli/commands.h"
#include "cli/exit_status.h"

namespace hookpoint::cli {

std::optional<bool> holds_study(const std::filesystem::path& file, bool allow_plugins) {
  Application application(allow_plugins);
  const auto root = application.evaluate(file, {});
  if (!root) return std::nullopt;
  return !root->children_of("Study").empty() || !root->children_of("Wall").empty() ||
         !root->children_of("Matrix").empty();
}

}  // namespace hookpoint::cli
