// Where the file lies that a <mesh filename="..."> names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hookpoint::simulation {

/// The places to look for `filename` in, in order, each once. `package://NAME/REST` (`model://` is
/// the same): REST in the folders above `robot`'s that are called NAME or hold a package.xml, then
/// NAME/REST in each folder above it, then both in the folders of `search_path`. `file://PATH` and
/// an absolute path are themselves; a relative one is meant beside `robot`, then along
/// `search_path`. Empty for another scheme, and for names with control characters.
std::vector<std::filesystem::path> mesh_places(
    const std::string& filename, const std::filesystem::path& robot,
    const std::vector<std::filesystem::path>& search_path);

}  // namespace hookpoint::simulation
