#include "simulation/scene/urdf/mesh_path.h"

#include <algorithm>
#include <optional>
#include <string_view>

namespace hookpoint::simulation {
namespace {

namespace fs = std::filesystem;

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }

/// The folder of `robot` and those above it, innermost first.
std::vector<fs::path> folders_above(const fs::path& robot) {
  std::error_code ignored;
  std::vector<fs::path> folders;
  fs::path folder = fs::absolute(robot, ignored).lexically_normal().parent_path();
  for (; !folder.empty(); folder = folder.parent_path()) {
    folders.push_back(folder);
    if (folder == folder.parent_path()) break;
  }
  return folders;
}

/// NAME/REST in two.
struct NamedPlace {
  fs::path name, rest;
};
std::optional<NamedPlace> split_uri(std::string_view uri, std::string_view scheme) {
  // Some exporters leave an empty place before the name: package:///NAME/REST.
  std::string_view name_and_rest = uri.substr(scheme.size());
  if (name_and_rest.starts_with('/')) name_and_rest.remove_prefix(1);
  const std::size_t slash = std::min(name_and_rest.find('/'), name_and_rest.size());
  const fs::path name(name_and_rest.substr(0, slash));
  const fs::path rest(name_and_rest.substr(std::min(slash + 1, name_and_rest.size())));
  if (name.empty() || rest.empty() || rest.is_absolute()) return std::nullopt;
  return NamedPlace{name, rest};
}

std::vector<fs::path> package_places(const NamedPlace& place, const fs::path& robot,
                                     const std::vector<fs::path>& search_path) {
  const std::vector<fs::path> above = folders_above(robot);
  std::error_code ignored;
  std::vector<fs::path> places;
  for (const fs::path& folder : above) {
    if (folder.filename() == place.name || fs::exists(folder / "package.xml", ignored))
      places.push_back(folder / place.rest);
  }
  for (const fs::path& folder : above) places.push_back(folder / place.name / place.rest);
  for (const fs::path& folder : search_path) {
    places.push_back(folder / place.name / place.rest);
    places.push_back(folder / place.rest);
  }
  return places;
}

constexpr std::string_view model_scheme = "model://";

}  // namespace

std::vector<fs::path> mesh_places(const std::string& filename, const fs::path& robot,
                                  const std::vector<fs::path>& search_path) {
  if (std::ranges::any_of(filename, is_control)) return {};
  const std::string_view text = filename;
  for (const std::string_view scheme : {std::string_view("package://"), model_scheme}) {
    if (!text.starts_with(scheme)) continue;
    const std::optional<NamedPlace> place = split_uri(text, scheme);
    return place ? package_places(*place, robot, search_path) : std::vector<fs::path>{};
  }
  constexpr std::string_view file_scheme = "file://";
  const bool has_scheme = text.starts_with(file_scheme);
  if (!has_scheme && text.find("://") != std::string_view::npos) return {};
  const fs::path path(has_scheme ? text.substr(file_scheme.size()) : text);
  if (path.empty()) return {};
  if (path.is_absolute()) return {path};
  std::vector<fs::path> places{robot.parent_path() / path};
  for (const fs::path& folder : search_path) places.push_back(folder / path);
  return places;
}

std::vector<fs::path> model_places(const std::string& uri, const fs::path& file,
                                   const std::vector<fs::path>& search_path) {
  if (!uri.starts_with(model_scheme)) return mesh_places(uri, file, search_path);
  const std::optional<NamedPlace> place = split_uri(uri, model_scheme);
  if (!place || std::ranges::any_of(uri, is_control)) return {};
  std::vector<fs::path> places;
  for (const fs::path& folder : folders_above(file)) {
    if (folder.filename() == place->name) places.push_back(folder / place->rest);
    places.push_back(folder / place->name / place->rest);
  }
  for (const fs::path& folder : search_path) places.push_back(folder / place->name / place->rest);
  return places;
}

fs::path first_file(const std::vector<fs::path>& places) {
  std::error_code ignored;
  const auto found = std::ranges::find_if(
      places, [&](const fs::path& path) { return fs::is_regular_file(path, ignored); });
  return found == places.end() ? fs::path() : found->lexically_normal();
}

}  // namespace hookpoint::simulation
