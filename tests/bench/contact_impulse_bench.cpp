// What the impulse laws cost: one collision, and a resting block's microcollisions.
#include <benchmark/benchmark.h>

#include <cmath>

#include "contact/impulse/impulse_advance.h"

namespace hookpoint::contact {
namespace {

void collision(benchmark::State& state, const Symmetric3d& K) {
  const CollisionProblem problem{K, {5e-4, 3e-4, -1e-3}, {0., 0., 1.}, 0.5, 0., 1e-3};
  for (auto _ : state) benchmark::DoNotOptimize(resolve_collision(problem));
}
BENCHMARK_CAPTURE(collision, closed_form, {1., 1., 1., 0., 0., 0.});
// Lower corner of the block of issue 2.
BENCHMARK_CAPTURE(collision, curved, {3.1, 3.1, 5.8, -1.5, 1.2, 1.2});

/// A resting block on a slope of 15 degrees, 1 ms a step; the counter is the time of one impact
/// with its share of the flight.
void resting_block(benchmark::State& state, ImpulseLaw law) {
  const double theta = 0.2617993877991494;
  MaterialConstants<double> material;
  material.kinetic_friction = 0.5;
  const Vector3d normal{std::sin(theta), 0., std::cos(theta)};
  const auto ground = [&](const Vector3d& p) {
    return GroundPoint{dot(p, normal), normal, &material};
  };
  ImpulseBody body;
  body.mass = 1.;
  body.inertia = {0.05 / 12., 0.05 / 12., 0.08 / 12., 0., 0., 0.};
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double z : {-0.05, 0.05}) body.boundary_points.push_back({x, y, z});
    }
  }
  ImpulseAdvance engine(body, law);
  ImpulseState s{0.05 * normal, exponential(Vector3d{0., theta, 0.}), {}, {}};
  double impacts = 0.;
  for (auto _ : state) {
    impacts +=
        static_cast<double>(engine.advance(s, 1e-3, {{0., 0., -9.81}, {}, {}}, ground).impacts);
  }
  state.counters["impact"] =
      benchmark::Counter(impacts, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(resting_block, impulse, ImpulseLaw::impulse);
BENCHMARK_CAPTURE(resting_block, impulse_reversal, ImpulseLaw::impulse_reversal);

}  // namespace
}  // namespace hookpoint::contact
