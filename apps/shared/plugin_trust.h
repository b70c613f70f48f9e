// Which shared libraries may run in this process: those of trusted folders, or all, by the user's
// word.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hookpoint::application {

class PluginTrust {
 public:
  /// `all`: --allow-plugins. `folders`: what lies in them, at any depth, is trusted.
  PluginTrust(bool all, const std::vector<std::filesystem::path>& folders);

  /// "" or why `library` may not be loaded, as a predicate. Its real path counts, so that neither a
  /// link nor `..` leads out of a trusted folder.
  std::string problem(const std::filesystem::path& library) const;

 private:
  bool all_;
  std::vector<std::filesystem::path> folders_;  ///< real paths
};

/// The folders of a list joined by ':' (the environment variable `variable`), without empty ones.
std::vector<std::filesystem::path> folders_of(const char* variable);

}  // namespace hookpoint::application
