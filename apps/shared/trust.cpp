#include "apps/shared/trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace hookpoint::application {

Trust::Trust(TrustKind kind, bool all, const std::filesystem::path& installed)
    : kind_(kind), all_(all) {
  std::vector<std::filesystem::path> folders = folders_of(kind.variable);
  if (!installed.empty()) folders.push_back(installed);
  for (const std::filesystem::path& folder : folders) {
    std::error_code error;
    std::filesystem::path real = std::filesystem::canonical(folder, error);
    if (!error) folders_.push_back(std::move(real));
  }
}

std::string Trust::problem(const std::filesystem::path& file) const {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(file, error);
  if (error) return "cannot be read: " + error.message();
  const bool trusted = std::ranges::any_of(folders_, [&real](const std::filesystem::path& folder) {
    // Part by part: /opt/plugins-of-others does not lie in /opt/plugins.
    return std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first ==
           folder.end();
  });
  if (all_ || trusted) return "";
  return fmt::format(
      "is refused, since it would run with all of your rights: allow it with {}, or put its folder "
      "`{}` into {}",
      kind_.option, real.parent_path().string(), kind_.variable);
}

std::vector<std::filesystem::path> folders_of(const char* variable) {
  std::vector<std::filesystem::path> folders;
  if (const char* listed = std::getenv(variable)) {
    std::stringstream list(listed);
    for (std::string folder; std::getline(list, folder, ':');) {
      if (!folder.empty()) folders.emplace_back(folder);
    }
  }
  return folders;
}

}  // namespace hookpoint::application
