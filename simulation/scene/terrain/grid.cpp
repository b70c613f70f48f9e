// Terrain.Grid: heights from a file.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "language/tree/fields.h"
#include "simulation/scene/terrain/ascii_grid.h"
#include "simulation/scene/terrain/classes.h"
#include "simulation/scene/terrain/png_grid.h"
#include "text/formats.h"

namespace hookpoint::simulation {

using language::Fields;
using language::list_field;
using language::number_field;
using language::text_field;

namespace {

namespace grid_field {
constexpr const char *file = "file", *origin = "origin", *low = "low", *high = "high";
}

/// What an object says beside its file.
struct GridPlace {
  std::optional<double> spacing;  ///< [m]; none: the file's
  double height = 0.;             ///< [m]
};

const Fields<GridPlace>& grid_fields() {
  static const Fields<GridPlace> fields{
      required(text_field(grid_field::file,
                          "looked up beside the .hook file, then along the search path; "
                          "an image is known by its ending .png")),
      positive(number_field("spacing", "m", &GridPlace::spacing,
                            "edge of a cell, that is from pixel to pixel; if not given, the "
                            "file's cellsize, or 1 m")),
      list_field(grid_field::origin, "m", 2, 2, "",
                 "world x,y of the corner of least x and y; if not given, the file's, or such "
                 "that the grid is centred"),
      number_field("height", "m", &GridPlace::height, "added to every height"),
      number_field(grid_field::low, "m", "", "of a PNG, and needed there: the height of black"),
      number_field(grid_field::high, "m", "", "of a PNG, and needed there: the height of white"),
  };
  return fields;
}

bool is_png(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char letter) { return std::tolower(letter); });
  return extension == ".png";
}

/// `low` and `high` stand beside an image, which has no heights of its own, and nowhere else.
bool has_range_of_its_kind(const language::Object& object, bool png, Loading& loading) {
  for (const char* field : {grid_field::low, grid_field::high}) {
    if (object.given(field) == png) continue;
    loading.error(
        place_of(object, png ? grid_field::file : field),
        png ? fmt::format("a PNG needs `{}`, the height of its {}", field,
                          field == grid_field::low ? "black" : "white")
            : fmt::format("`{}` goes with a PNG; a text file has its heights in metres", field));
    return false;
  }
  return true;
}

/// The heights of a file, and where the file says that they are.
std::optional<AsciiGrid> read_heights(const language::Object& object, Loading& loading) {
  const language::Position& place = place_of(object, grid_field::file);
  const std::string& name = object.word(grid_field::file);
  const std::filesystem::path path = find_file(name, place, loading);
  if (path.empty()) return std::nullopt;
  if (const std::string refusal = text::refusal(path, text::Use::heights); !refusal.empty()) {
    loading.error(place, fmt::format("\"{}\" cannot be read as heights: {}", name, refusal));
    return std::nullopt;
  }
  if (!has_range_of_its_kind(object, is_png(path), loading)) return std::nullopt;
  if (is_png(path)) {
    PngGridResult result =
        read_png_grid(path, object.number(grid_field::low), object.number(grid_field::high));
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

}  // namespace

void add_grid_class(language::Schema& schema) {
  schema.add(terrain_class(
      "Terrain.Grid",
      "heights from a file: an ESRI ASCII grid, a plain matrix whose first line has the least y, "
      "or a grayscale PNG of 8 or 16 bits whose top has the greatest y",
      schemas(grid_fields())));
}

GridSpec load_grid(const language::Object& object, TerrainSpec& terrain, Loading& loading) {
  std::optional<AsciiGrid> grid = read_heights(object, loading);
  if (!grid) return {};
  const GridPlace place = load_fields(object, grid_fields());
  terrain.spacing = place.spacing.value_or(grid->spacing.value_or(1.));
  GridSpec surface{grid->columns, grid->rows, std::move(grid->heights), 0., 0.};
  surface.origin_x = grid->origin_x.value_or(-0.5 * (grid->columns - 1) * terrain.spacing);
  surface.origin_y = grid->origin_y.value_or(-0.5 * (grid->rows - 1) * terrain.spacing);
  if (object.given(grid_field::origin)) {
    surface.origin_x = object.numbers(grid_field::origin)[0];
    surface.origin_y = object.numbers(grid_field::origin)[1];
  }
  for (double& height : surface.heights) height += place.height;
  return surface;
}

}  // namespace hookpoint::simulation
