#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "simulation/scene/load_parts.h"
#include "simulation/scene/terrain/ascii_grid.h"
#include "simulation/scene/terrain/png_grid.h"
#include "simulation/scene/terrain/surface.h"

namespace hookpoint::simulation {
namespace {

bool is_png(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char letter) { return std::tolower(letter); });
  return extension == ".png";
}

/// `low` and `high` stand beside an image, which has no heights of its own, and nowhere else.
bool has_range_of_its_kind(const language::Object& object, bool png, Loading& loading) {
  for (const char* field : {"low", "high"}) {
    if (object.given(field) == png) continue;
    loading.error(
        place_of(object, png ? "file" : field),
        png ? fmt::format("a PNG needs `{}`, the height of its {}", field,
                          field == std::string("low") ? "black" : "white")
            : fmt::format("`{}` goes with a PNG; a text file has its heights in metres", field));
    return false;
  }
  return true;
}

/// The heights of a file, and where the file says that they are.
std::optional<AsciiGrid> read_heights(const language::Object& object, Loading& loading) {
  const language::Position& place = place_of(object, "file");
  const std::string& name = object.word("file");
  const std::filesystem::path path = find_file(name, place, loading);
  if (path.empty() || !has_range_of_its_kind(object, is_png(path), loading)) return std::nullopt;
  if (is_png(path)) {
    PngGridResult result = read_png_grid(path, object.number("low"), object.number("high"));
    if (result.grid) {
      return AsciiGrid{
          result.grid->columns, result.grid->rows, std::move(result.grid->heights), {}, {}, {}};
    }
    loading.error(place, fmt::format("\"{}\" cannot be read as heights: {}", name, result.message));
    return std::nullopt;
  }
  AsciiGridResult result = read_ascii_grid(path);
  if (!result.grid) {
    loading.error(
        place, fmt::format("\"{}\" cannot be read as a grid of heights: {}", name, result.message));
  }
  return std::move(result.grid);
}

GridSpec load_grid(const language::Object& object, TerrainSpec& terrain, Loading& loading) {
  std::optional<AsciiGrid> grid = read_heights(object, loading);
  if (!grid) return {};
  const language::Field* spacing = object.find("spacing");
  terrain.spacing = spacing != nullptr ? spacing->numbers[0] : grid->spacing.value_or(1.);
  GridSpec surface{grid->columns, grid->rows, std::move(grid->heights), 0., 0.};
  surface.origin_x = grid->origin_x.value_or(-0.5 * (grid->columns - 1) * terrain.spacing);
  surface.origin_y = grid->origin_y.value_or(-0.5 * (grid->rows - 1) * terrain.spacing);
  if (object.given("origin")) {
    surface.origin_x = object.numbers("origin")[0];
    surface.origin_y = object.numbers("origin")[1];
  }
  for (double& height : surface.heights) height += object.number("height");
  return surface;
}

Extent extent_of(const language::Object& object, double default_spacing) {
  const language::Field* spacing = object.find("spacing");
  const std::vector<double>& size = object.numbers("size");
  return {spacing != nullptr ? spacing->numbers[0] : default_spacing, size.front(), size.back()};
}

GridSpec load_rough(const language::Object& object, TerrainSpec& terrain, Loading& loading) {
  RoughGround rough;
  rough.amplitude = object.number("amplitude");
  rough.wavelength = object.number("wavelength");
  rough.seed = static_cast<std::uint64_t>(object.number("seed"));
  rough.flat_radius = object.number("flat_radius");
  rough.slope = object.number("slope");
  rough.azimuth = object.number("azimuth");
  const Extent extent = extent_of(object, rough.wavelength / 8.);
  terrain.spacing = extent.spacing;
  const std::string problem = rough_problem(rough, extent);
  if (problem.empty()) return rough_surface(rough, extent);
  loading.error(object.position, problem);
  return {};
}

GridSpec load_steps(const language::Object& object, TerrainSpec& terrain, Loading& loading) {
  StepsGround steps;
  steps.height = object.number("height");
  steps.run = object.number("run");
  steps.count =
      object.given("count") ? object.number("count") : std::numeric_limits<double>::infinity();
  steps.from = object.number("from");
  steps.azimuth = object.number("azimuth");
  const Extent extent = extent_of(object, 0.02);
  terrain.spacing = extent.spacing;
  const std::string problem = steps_problem(steps, extent);
  if (problem.empty()) return steps_surface(steps, extent);
  loading.error(object.position, problem);
  return {};
}

void load_plane_extent(const language::Object& object, TerrainSpec& terrain) {
  terrain.spacing = object.number("spacing");
  const std::vector<double>& size = object.numbers("size");
  terrain.size_x = size.front();
  terrain.size_y = size.back();
}

}  // namespace

void load_surface(const language::Object& object, TerrainSpec& terrain, Loading& loading) {
  if (object.type == "Terrain.Grid") {
    terrain.surface = load_grid(object, terrain, loading);
  } else if (object.type == "Terrain.Rough") {
    terrain.surface = load_rough(object, terrain, loading);
  } else if (object.type == "Terrain.Steps") {
    terrain.surface = load_steps(object, terrain, loading);
  } else {
    load_plane_extent(object, terrain);
    if (object.type == "Terrain.Slope") {
      terrain.surface = SlopeSpec{object.number("angle"), object.number("azimuth")};
    } else {
      terrain.surface = FlatSpec{object.number("height")};
    }
  }
}

}  // namespace hookpoint::simulation
