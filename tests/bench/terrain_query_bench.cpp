// What one question to the ground costs, and that the size of a grid and the number of its patches
// do not enter but by the memory's distance: points close together, as a robot's are, and anywhere.
#include <benchmark/benchmark.h>

#include <random>

#include "contact/terrain/terrain.h"

namespace hookpoint::contact {
namespace {

std::vector<Vector3d> points_within(double reach) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> at(-reach, reach);
  std::vector<Vector3d> points;
  for (int n = 0; n < 1024; ++n) points.push_back({at(generator), at(generator), -1e-3});
  return points;
}

void ask(benchmark::State& state, const Terrain& terrain, const std::vector<Vector3d>& points) {
  std::size_t n = 0;
  for (auto _ : state) benchmark::DoNotOptimize(terrain.query(points[n++ % points.size()]));
}

/// A grid of `side` x `side` vertices 10 mm apart, with `patches` patches.
Terrain grid(int side, int patches) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> height(0., 1e-3);
  TerrainDescription description;
  GridSurface surface{side, side, {}, -0.005 * (side - 1), -0.005 * (side - 1)};
  for (int n = 0; n < side * side; ++n) surface.heights.push_back(height(generator));
  description.surface = std::move(surface);
  description.spacing = 0.01;
  for (int n = 0; n < patches; ++n) description.patches.push_back({-0.1, -0.1, 0.01 * n, 0.1, n});
  return Terrain(description);
}

void nearby(benchmark::State& state) {
  const Terrain terrain = grid(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  ask(state, terrain, points_within(0.1));
}
BENCHMARK(nearby)->Args({33, 0})->Args({129, 0})->Args({513, 0})->Args({2049, 0})->Args({513, 16});

void anywhere(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  ask(state, grid(side, 0), points_within(0.0049 * (side - 1)));
}
BENCHMARK(anywhere)->Arg(33)->Arg(129)->Arg(513)->Arg(2049);

void slope(benchmark::State& state) {
  TerrainDescription description;
  description.surface = SlopeSurface{0.2, 0.3};
  ask(state, Terrain(description), points_within(0.1));
}
BENCHMARK(slope);

}  // namespace
}  // namespace hookpoint::contact
