// Which shared libraries may run in this process, and which engines may be started: those of trusted
// folders, or all, by the user's word.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hookpoint::application {

/// A kind of code that needs consent.
struct TrustKind {
  const char* option;    ///< "--allow-plugins"
  const char* variable;  ///< of the environment, with trusted folders
};
inline constexpr TrustKind plugin_trust{"--allow-plugins", "HOOKPOINT_TRUSTED_PLUGINS"},
    engine_trust{"--allow-engines", "HOOKPOINT_TRUSTED_ENGINES"};

class Trust {
 public:
  /// `all`: the option was given. `installed`: trusted beside the variable's folders; "" for none.
  /// What lies in a trusted folder, at any depth, is trusted.
  Trust(TrustKind kind, bool all, const std::filesystem::path& installed);

  /// "" or why `file` may not be loaded or started, as a predicate. Its real path counts, so that
  /// neither a link nor `..` leads out of a trusted folder.
  std::string problem(const std::filesystem::path& file) const;

 private:
  TrustKind kind_;
  bool all_;
  std::vector<std::filesystem::path> folders_;  ///< real paths
};

/// The folders of a list joined by ':' (the environment variable `variable`), without empty ones.
std::vector<std::filesystem::path> folders_of(const char* variable);

}  // namespace hookpoint::application
