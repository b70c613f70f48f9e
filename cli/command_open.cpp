#include "cli/application.h"
#include "cli/commands.h"
#include "cli/exit_status.h"

namespace hookpoint::cli {

std::optional<bool> holds_study(const std::filesystem::path& file) {
  Application application;
  const auto root = application.evaluate(file, {});
  if (!root) return std::nullopt;
  return !root->children_of("Study").empty();
}

}  // namespace hookpoint::cli
