#include "reference/solids.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace hookpoint::reference {
namespace {

/// How far stairs reach [m].
constexpr double far = 1e3, below = 1.;

void add_stairs(const contact::StairsProfile& stairs, int material, std::vector<Solid>& solids) {
  const double count = std::floor(stairs.count);
  const double bottom = std::min(0., count * stairs.height) - below;
  const Vector3d& uphill = stairs.uphill;
  const Quaterniond turn = exponential(Vector3d{0., 0., std::atan2(uphill.y, uphill.x)});
  for (double tread = 0.; tread <= count; ++tread) {
    const double begin = tread == 0. ? stairs.from - far : stairs.from + (tread - 1.) * stairs.run;
    const double end = tread == count ? begin + far : stairs.from + tread * stairs.run;
    const double top = tread * stairs.height;
    const Vector3d middle = 0.5 * (begin + end) * uphill + Vector3d{0., 0., 0.5 * (top + bottom)};
    solids.push_back(
        {simulation::Box{{end - begin, 2. * far, top - bottom}}, {middle, turn}, material, {}});
  }
}

}  // namespace

std::vector<Solid> solids_of(const simulation::Experiment& experiment) {
  std::vector<Solid> solids;
  if (experiment.terrain)
    if (const auto* grid = std::get_if<simulation::GridSpec>(&experiment.terrain->surface))
      if (grid->stairs) add_stairs(*grid->stairs, experiment.terrain->material, solids);
  for (std::size_t i = 0; i < experiment.obstacles.size(); ++i) {
    const simulation::ObstacleSpec& obstacle = experiment.obstacles[i];
    solids.push_back(
        {obstacle.geometry, {obstacle.location, obstacle.orientation}, obstacle.material, i});
  }
  return solids;
}

}  // namespace hookpoint::reference
