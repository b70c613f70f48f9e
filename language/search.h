// Where the files lie that a file names.
#pragma once

#include <filesystem>
#include <vector>

namespace hookpoint::language {

/// The folders in which a file is looked up that `from` names, in order: its own; the `configs/` in
/// it and in each folder above, so that a project's files find their own project's configs; then
/// those of `search_path`. Only folders that exist, but for the first; none twice. `from` is "" for
/// the command line, which stands in the working directory.
std::vector<std::filesystem::path> search_folders(
    const std::filesystem::path& from, const std::vector<std::filesystem::path>& search_path);

/// The first of them with something by the name `path` in it; empty if there is none. An absolute
/// path is itself.
std::filesystem::path find_along(const std::filesystem::path& path,
                                 const std::filesystem::path& from,
                                 const std::vector<std::filesystem::path>& search_path);

}  // namespace hookpoint::language
