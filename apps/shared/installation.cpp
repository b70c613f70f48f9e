#include "apps/shared/installation.h"

namespace hookpoint::application {

Installation find_installation() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  // PREFIX/bin/hookpoint, as cmake/hookpoint_install.cmake lays it out.
  const std::filesystem::path prefix = program.parent_path().parent_path();
  const std::filesystem::path configs = prefix / "share/hookpoint/configs";
  if (error || !std::filesystem::is_directory(configs, error)) return {HOOKPOINT_CONFIGS, {}};
  return {configs, prefix / "lib/hookpoint/plugins"};
}

}  // namespace hookpoint::application
