// Where the files lie that a robot's file names: meshes, models.
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

/// The same of a model of SDFormat: `model://NAME/REST` is in a folder NAME alone, whatever package is
/// around it.
std::vector<std::filesystem::path> model_places(
    const std::string& uri, const std::filesystem::path& file,
    const std::vector<std::filesystem::path>& search_path);

/// The first of them that is a file; empty, where none is.
std::filesystem::path first_file(const std::vector<std::filesystem::path>& places);

}  // namespace hookpoint::simulation
