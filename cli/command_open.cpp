#include "cli/application.h"
#include "cli/commands.h"
#include "cli/study_plans.h"

namespace hookpoint::cli {

std::optional<bool> holds_study(const std::filesystem::path& file, bool allow_plugins) {
  Application application(allow_plugins);
  const auto root = application.evaluate(application.locate(file), {});
  if (!root) return std::nullopt;
  return holds_study(*root);
}

}  // namespace hookpoint::cli
