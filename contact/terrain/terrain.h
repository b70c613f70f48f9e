// The ground: a fixed-spacing triangular tiling over a grid of heights (Reichler & Delcomyn
// 2000, 3.3). Two triangles a cell, diagonal from vertex (i,j) to (i+1,j+1), a material for every
// tile. The one tile that a point can touch is indexed by the point's x and y: no search.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "math/rotation.h"

namespace hookpoint::contact {

/// The level plane z = height [m].
struct FlatSurface {
  double height = 0.;
};
/// The plane through the world's origin that falls along +x turned by `azimuth` about z:
/// z = -tan(angle) (x cos azimuth + y sin azimuth). Radians, 0 <= angle < pi/2.
struct SlopeSurface {
  double angle = 0.;
  double azimuth = 0.;
};
/// The largest grid that is made or read from an image.
inline constexpr int most_grid_vertices = 1 << 24;  ///< 4096 x 4096, or as many in another shape
inline constexpr int most_grid_side = 1 << 16;

/// Stairs along a horizontal direction: risers at from, from + run, ..., each `height` high.
struct StairsProfile {
  Vector3d uphill{1., 0., 0.};  ///< unit, horizontal
  double from = 0.;             ///< of the first riser along `uphill` [m]
  double run = 1.;              ///< from one riser to the next [m]
  double height = 0.;           ///< of one step; below 0 the stairs go down [m]
  double count = 1.;            ///< of steps, finite
};

/// heights[row * columns + column] [m] at (origin_x + column spacing, origin_y + row spacing).
struct GridSurface {
  int columns = 0, rows = 0;  ///< vertices along x and y, at least 2 each
  std::vector<double> heights;
  double origin_x = 0., origin_y = 0.;    ///< world position of vertex (0,0) [m]
  std::optional<StairsProfile> stairs{};  ///< what the heights are sampled from
};

/// Paints the tiles whose centroid lies within the rectangle [m]; later patches cover earlier ones.
struct MaterialPatch {
  double from_x = 0., from_y = 0., to_x = 0., to_y = 0.;
  int material = 0;
};

struct TerrainDescription {
  std::variant<FlatSurface, SlopeSurface, GridSurface> surface;
  double spacing = 1.;              ///< edge of a cell [m]
  double size_x = 0., size_y = 0.;  ///< extent of a plane, centred on the origin [m]; 0: unbounded.
                                    ///< A grid has its own.
  int material = 0;                 ///< of every tile that no patch covers
  std::vector<MaterialPatch> patches;
};

/// The tile under (or over) a point, and where the point is against it.
struct TilePoint {
  Vector3d normal;       ///< unit normal of the tile, out of the ground
  double depth = 0.;     ///< delta, along the normal: vertical depth * n_z, > 0 inside [m]
  double height = 0.;    ///< z of the tile's plane at the point's x, y [m]
  int material = 0;      ///< index that the description gave
  bool outside = false;  ///< the point's x, y are off the terrain; its edge tile was continued
};

/// Where a body lies on the ground: `orientation` turns body to world axes, z to the tile's normal.
struct TilePose {
  Vector3d position;  ///< on the tile's plane at the requested x, y [m]
  Quaterniond orientation;
  TilePoint tile;
};

class Terrain {
 public:
  /// What is wrong with a description, in words for its author; empty when a Terrain can be built
  /// from it.
  static std::string problem(const TerrainDescription& description);

  /// The description must be without `problem`.
  explicit Terrain(TerrainDescription description);

  /// The tile at a point's x, y and the point's depth in it. Off the terrain the nearest edge
  /// tile's plane continues and `outside` is set, for the caller to report once (outside_message).
  /// O(1), plus the number of patches for a plane. Const without caches: any number of threads may
  /// ask.
  TilePoint query(const Vector3d& point) const;
  TilePoint query(double x, double y, double z) const { return query(Vector3d{x, y, z}); }

  /// A depth that no point of a box exceeds but by rounding (under 1 nm within 1000 km): the depth
  /// of its deepest corner in a plane without edges; over a grid, for a box that lies higher than
  /// all of it, its height over the highest vertex times the least n_z; infinite where only `query`
  /// knows. `center` p_WC [m], `R_WB` the box's axes, `half` half its edges [m]. O(1).
  double deepest(const Vector3d& center, const Matrix3d& R_WB, const Vector3d& half) const;

  /// What to tell the user, once, when a point has left the terrain.
  std::string outside_message(const Vector3d& point) const;

  /// Lies a body on the tile at (x, y) [m]: first turned by `yaw` [rad] about the world's z, then
  /// tilted by the shortest rotation that takes z to the tile's normal (the same as tilting first
  /// and then turning about the normal).
  TilePose pose_on_tile(double x, double y, double yaw) const;

  const TerrainDescription& description() const { return description_; }

 private:
  /// One triangle: cell and half, and whether the queried point lies off the terrain.
  struct Tile {
    double column = 0., row = 0.;  ///< the cell's lower left vertex, in cells from `origin`
    bool upper = false;            ///< the half left of (above) the diagonal
    bool outside = false;
  };
  struct Plane {
    double height = 0.;  ///< at the queried point [m]
    Vector3d normal;     ///< unit, out of the ground
  };

  static Vector3d normal_of(double gradient_x, double gradient_y);
  TilePoint point_on(const Plane& plane, const Vector3d& point) const;
  Tile tile_at(double x, double y) const;
  Plane plane_of(const Tile& tile, double x, double y) const;
  /// Finds what `deepest` asks of a grid.
  void measure(const GridSurface& grid);
  /// `reach`: of a box along the world's axes, half [m].
  double deepest_over_grid(const Vector3d& center, const Vector3d& reach) const;
  int painted_material(const Tile& tile) const;
  int material_of(const Tile& tile) const;

  TerrainDescription description_;
  double origin_x_ = 0., origin_y_ = 0.;  ///< world position of vertex (0,0) [m]
  double columns_ = 0., rows_ = 0.;       ///< cells along x and y; infinite for an unbounded plane
  bool unbounded_x_ = false, unbounded_y_ = false;
  double gradient_x_ = 0., gradient_y_ = 0.;  ///< of a plane
  Vector3d normal_;                           ///< of a plane
  std::vector<int> tile_materials_;           ///< of a grid with patches: two a cell, row by row
  double highest_ = 0.;                       ///< vertex of a grid [m]
  double least_normal_z_ = 0.;                ///< no tile of a grid has less
};

}  // namespace hookpoint::contact
