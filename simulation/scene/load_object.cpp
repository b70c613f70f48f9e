#include <fmt/format.h>

#include <algorithm>

#include "language/search.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {
namespace {

std::filesystem::path remember(const std::string& name, std::filesystem::path path,
                               Loading& loading) {
  const std::string absolute = std::filesystem::absolute(path).string();
  std::vector<FileSpec>& files = loading.experiment.files;
  const auto same = [&](const FileSpec& file) {
    return file.name == name && file.path == absolute;
  };
  if (std::ranges::none_of(files, same)) files.push_back({name, absolute});
  return path;
}

}  // namespace

std::vector<const language::Object*> collect_all(const language::Object& parent,
                                                 std::string_view type) {
  std::vector<const language::Object*> found;
  for (const auto& child : parent.children) {
    const bool family = type.ends_with('.') && child->type.starts_with(type);
    if (family || child->type == type) found.push_back(child.get());
    std::ranges::copy(collect_all(*child, type), std::back_inserter(found));
  }
  return found;
}

std::string name_within(const language::Object& object, const language::Object& ancestor) {
  std::string name = object.name;
  for (const language::Object* above = object.parent; above != nullptr && above != &ancestor;
       above = above->parent) {
    if (!above->name.empty()) name = above->name + "." + name;
  }
  return name;
}

const language::Position& place_of(const language::Object& object, std::string_view field) {
  const language::Field* found = object.find(field);
  return found != nullptr && found->given ? found->position : object.position;
}

Vector3d vector_of(const language::Object& object, std::string_view field) {
  const std::vector<double>& numbers = object.numbers(field);
  return {numbers[0], numbers[1], numbers[2]};
}

std::filesystem::path find_file(const std::string& name, const language::Position& from,
                                Loading& loading) {
  const auto given = std::ranges::find(loading.given, name, &FileSpec::name);
  if (given != loading.given.end()) return remember(name, given->path, loading);
  const std::filesystem::path file = from.file == nullptr ? "" : from.file->path;
  const std::filesystem::path found = language::find_along(name, file, loading.search_path);
  if (std::filesystem::is_regular_file(found)) return remember(name, found, loading);
  loading.error(from, fmt::format("there is no file \"{}\" beside this one, in the configs/ of a "
                                  "folder above it or along the search path (HOOKPOINT_PATH, the "
                                  "installation's configs/)",
                                  name));
  return {};
}

}  // namespace hookpoint::simulation
