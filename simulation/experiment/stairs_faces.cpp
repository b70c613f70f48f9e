#include "simulation/experiment/stairs_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simulation/experiment/painted_parts.h"

namespace hookpoint::simulation {
namespace {

using Polygon = std::vector<Vector3d>;

/// The part of a convex polygon where `side` . p >= least.
Polygon clipped(const Polygon& polygon, const Vector3d& side, double least) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double before = dot(side, from) - least, after = dot(side, to) - least;
    if (before >= 0.) kept.push_back(from);
    if ((before > 0. && after < 0.) || (before < 0. && after > 0.))
      kept.push_back(from + before / (before - after) * (to - from));
  }
  return kept;
}

/// Stairs over one part of the plan.
class PartOfStairs {
 public:
  PartOfStairs(const contact::StairsProfile& stairs, const PaintedPart& part,
               std::vector<StairsFace>& faces)
      : stairs_(stairs), part_(part), faces_(faces) {
    const auto [least, most] = std::ranges::minmax(
        part.corners, {}, [&](const Vector3d& corner) { return dot(stairs.uphill, corner); });
    lowest_ = dot(stairs.uphill, least);
    highest_ = dot(stairs.uphill, most);
  }

  void add() const {
    for (double k = tread_at(lowest_); k <= tread_at(highest_); ++k) {
      add_tread(k);
      if (k < stairs_.count && riser(k) >= lowest_ && riser(k) < highest_) add_riser(k);
    }
  }

 private:
  double riser(double k) const { return stairs_.from + k * stairs_.run; }
  double tread_at(double along) const {
    return std::clamp(std::floor((along - stairs_.from) / stairs_.run) + 1., 0., stairs_.count);
  }

  void add_tread(double k) const {
    Polygon tread = part_.corners;
    if (k > 0.) tread = clipped(tread, stairs_.uphill, riser(k - 1.));
    if (k < stairs_.count) tread = clipped(tread, -stairs_.uphill, -riser(k));
    if (tread.size() < 3) return;
    for (Vector3d& corner : tread) corner.z = k * stairs_.height;
    faces_.push_back({part_.material, std::move(tread)});
  }
  /// It looks downhill where the stairs rise.
  void add_riser(double k) const {
    const Vector3d sideways{-stairs_.uphill.y, stairs_.uphill.x, 0.};
    const Polygon behind = clipped(part_.corners, stairs_.uphill, riser(k));
    double left = -std::numeric_limits<double>::infinity(), right = -left;
    for (const Vector3d& corner : behind) {
      if (dot(stairs_.uphill, corner) - riser(k) > 1e-9 * stairs_.run) continue;
      left = std::max(left, dot(sideways, corner));
      right = std::min(right, dot(sideways, corner));
    }
    if (!(left > right)) return;
    const auto at = [&](double aside, double level) {
      Vector3d place = riser(k) * stairs_.uphill + aside * sideways;
      place.z = level * stairs_.height;
      return place;
    };
    Polygon face{at(left, k), at(right, k), at(right, k + 1.), at(left, k + 1.)};
    faces_.push_back({part_.material, std::move(face)});
  }

  const contact::StairsProfile& stairs_;
  const PaintedPart& part_;
  std::vector<StairsFace>& faces_;
  double lowest_ = 0., highest_ = 0.;  ///< along the stairs [m]
};

}  // namespace

bool has_risers(const Experiment& experiment) {
  if (!experiment.terrain) return false;
  const auto* grid = std::get_if<GridSpec>(&experiment.terrain->surface);
  return grid != nullptr && grid->stairs && experiment.touch == "shapes" &&
         experiment.engine == "dts";
}

std::vector<StairsFace> stairs_faces(const contact::Terrain& ground) {
  const auto& grid = std::get<GridSpec>(ground.description().surface);
  const double spacing = ground.description().spacing;
  const CellRow columns = cells_of_extent(grid.origin_x, spacing, (grid.columns - 1) * spacing);
  const CellRow rows = cells_of_extent(grid.origin_y, spacing, (grid.rows - 1) * spacing);
  std::vector<StairsFace> faces;
  for (const PaintedPart& part : painted_parts(ground, columns, rows))
    PartOfStairs(*grid.stairs, part, faces).add();
  return faces;
}

}  // namespace hookpoint::simulation
