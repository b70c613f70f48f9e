// The terrain as points and tiles: what a peer's triangles and a picture are made from.
#pragma once

#include <array>
#include <vector>

#include "math/vector3.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// Triangles counter-clockwise from above, two a cell, diagonal from (i, j) to (i+1, j+1).
struct GroundMesh {
  std::vector<Vector3d> vertices;  ///< row by row, world axes [m]
  std::vector<std::array<int, 3>> triangles;
};
/// Of a grid whose cells are `spacing` [m] wide.
GroundMesh grid_mesh(const GridSpec& grid, double spacing);

/// A part of the ground as it is drawn: tiles, each of one material. A plane's cell is a square
/// where both of its halves have the same material; a tread and a riser of stairs are one tile.
struct GroundTiles {
  struct Tile {
    int material = 0;              ///< index into Experiment::materials
    std::array<int, 6> corners{};  ///< vertices, counter-clockwise from outside
    int corner_count = 3;
  };
  std::vector<Vector3d> vertices;  ///< world axes [m]
  std::vector<Tile> tiles;
};

/// The experiment's ground, which it has. A plane without an end is shown for 5 m around the
/// robots and the patches. Beyond `most_cells` a plane of one material has larger squares, which
/// begin where tiles do; any other ground but stairs is cut off around the robots.
GroundTiles visible_ground(const Experiment& experiment, int most_cells = 1 << 14);

}  // namespace hookpoint::simulation
