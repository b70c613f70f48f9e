#include "language/search.h"

#include <algorithm>

namespace hookpoint::language {

namespace fs = std::filesystem;

std::vector<fs::path> search_folders(const fs::path& from,
                                     const std::vector<fs::path>& search_path) {
  std::vector<fs::path> folders{from.parent_path()};
  std::error_code ignored;
  const auto add = [&](const fs::path& folder) {
    if (!fs::is_directory(folder, ignored)) return;
    if (std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
  };
  fs::path above = fs::absolute(from.parent_path().empty() ? "." : from.parent_path(), ignored);
  above = (above / "").lexically_normal().parent_path();
  while (!above.empty()) {
    add(above / "configs");
    if (above == above.parent_path()) break;
    above = above.parent_path();
  }
  for (const fs::path& folder : search_path) add(folder);
  return folders;
}

fs::path find_along(const fs::path& path, const fs::path& from,
                    const std::vector<fs::path>& search_path) {
  std::error_code ignored;
  if (path.is_absolute()) return fs::exists(path, ignored) ? path.lexically_normal() : fs::path();
  for (const fs::path& folder : search_folders(from, search_path)) {
    fs::path candidate = (folder / path).lexically_normal();
    if (fs::exists(candidate, ignored)) return candidate;
  }
  return {};
}

}  // namespace hookpoint::language
