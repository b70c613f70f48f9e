// Forward dynamics of one robot: beside Bullet's articulated-body algorithm on the same robot in
// the same run, and how its cost grows with the number of chains m and of links a chain N
// (docs/performance.md).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "dts/configuration.h"
#include "dts/forward_dynamics.h"
#include "tests/support/bullet_multibody.h"
#include "tests/support/hexapod.h"

namespace hookpoint::tests {
namespace {

const Vector3d gravity{0., 0., -9.81};

/// A robot in motion, ready to be timed.
struct Subject {
  dts::RobotDescription robot;
  dts::Model<double> model{robot};
  dts::Workspace<double> workspace{model};
  dts::State<double> state = dts::zero_state(model);
  std::vector<double> torques = std::vector<double>(model.link_count(), 0.1);

  explicit Subject(const dts::RobotDescription& description) : robot(description) {
    state.base_orientation = exponential(Vector3d{0.1, -0.2, 0.3});
    state.base_velocity = {0.1, 0.2, -0.1};
    state.base_angular_velocity = {0.3, -0.4, 0.5};
    for (std::size_t l = 0; l < model.link_count(); ++l) {
      state.joint_positions[l] = 0.3 * std::sin(1. + double(l));
      state.joint_rates[l] = 0.5 * std::cos(2. + double(l));
    }
  }

  void solve() {
    dts::forward_kinematics(model, state, workspace);
    solve_cached();
  }
  void solve_cached() {
    dts::forward_dynamics(model, gravity, torques, workspace);
    benchmark::DoNotOptimize(workspace.joint_accelerations.data());
    benchmark::ClobberMemory();
  }
};

/// Nanoseconds a call over one short batch.
template <class Call>
double batch_ns(const Call& call, int calls) {
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < calls; ++i) call();
  const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
  return elapsed.count() / calls;
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
  return values[values.size() / 2];
}

/// The least of several medians: what the machine does when nobody else uses it.
template <class Call>
double quietest_median_ns(const Call& call, int calls) {
  double least = INFINITY;
  for (int group = 0; group < 5; ++group) {
    std::vector<double> times;
    for (int repetition = 0; repetition < 15; ++repetition) times.push_back(batch_ns(call, calls));
    least = std::min(least, median(times));
  }
  return least;
}

/// The largest difference of joint accelerations, relative to the largest: that both sides solve
/// the same robot.
double difference(Subject& subject, BulletMultibody& bullet) {
  subject.solve();
  bullet.set_state(subject.state, gravity, subject.torques);
  constexpr double dt = 1e-3;  // Bullet clips velocities at 100
  bullet.compute_accelerations(dt);
  double worst = 0.;
  double largest = 0.;
  for (std::size_t l = 0; l < subject.model.link_count(); ++l) {
    const double theirs = (bullet.joint_rate(int(l)) - subject.state.joint_rates[l]) / dt;
    worst = std::max(worst, std::abs(theirs - subject.workspace.joint_accelerations[l]));
    largest = std::max(largest, std::abs(theirs));
  }
  bullet.set_state(subject.state, gravity, subject.torques);
  return worst / largest;
}

/// Ours counts sines, cosines and the world poses and velocities of all bodies; Bullet's has its
/// rotations cached.
void against_bullet(benchmark::State& run, const dts::RobotDescription& robot) {
  Subject subject(robot);
  BulletMultibody bullet(robot);
  run.counters["difference"] = difference(subject, bullet);
  double ours = INFINITY;
  double cached = INFINITY;
  double theirs = INFINITY;
  for (auto _ : run) {
    ours = std::min(ours, quietest_median_ns([&] { subject.solve(); }, 200));
    cached = std::min(cached, quietest_median_ns([&] { subject.solve_cached(); }, 200));
    theirs = std::min(theirs, quietest_median_ns([&] { bullet.compute_accelerations(0.); }, 100));
  }
  run.counters["dts_ns"] = ours;
  run.counters["bullet_ns"] = theirs;
  run.counters["ratio"] = ours / theirs;
  run.counters["dts_cached_ns"] = cached;
  run.counters["ratio_cached"] = cached / theirs;
}

void forward_dynamics(benchmark::State& run, const dts::RobotDescription& robot) {
  Subject subject(robot);
  for (auto _ : run) subject.solve();
}

/// Slope of log(time) over log(size), least squares, for robots of `size` from `robot_of`.
void exponent(benchmark::State& run, dts::RobotDescription (*robot_of)(std::size_t),
              std::initializer_list<std::size_t> sizes) {
  double slope = 0.;
  for (auto _ : run) {
    double n = 0., sx = 0., sy = 0., sxx = 0., sxy = 0.;
    for (const std::size_t size : sizes) {
      Subject subject(robot_of(size));
      const int calls = std::max(5, int(2000 / subject.model.link_count()));
      const double ns = quietest_median_ns([&] { subject.solve(); }, calls);
      run.counters["ns_a_joint_" + std::to_string(size)] = ns / double(subject.model.link_count());
      const double x = std::log(double(size));
      const double y = std::log(ns);
      n += 1., sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  }
  run.counters["exponent"] = slope;
}

/// `robot` with a fixed transform ahead of every link, as a URDF has it.
dts::RobotDescription placed(dts::RobotDescription robot) {
  for (dts::ChainDescription& chain : robot.chains) {
    for (dts::LinkDescription& link : chain.links) {
      link.joint_position = {0.02, -0.03, 0.01};
      link.joint_orientation = exponential(Vector3d{0.3, -0.2, 0.1});
    }
  }
  return robot;
}
dts::RobotDescription with_chains(std::size_t m) { return generic_robot(m, 3); }
dts::RobotDescription with_links(std::size_t n) { return generic_robot(6, n); }
dts::RobotDescription with_branches(std::size_t m) { return branching_robot(m, 3); }

BENCHMARK_CAPTURE(forward_dynamics, hexapod, hexapod());
BENCHMARK_CAPTURE(forward_dynamics, generic, generic_robot(6, 3));
BENCHMARK_CAPTURE(forward_dynamics, branching, branching_robot(6, 3));
BENCHMARK_CAPTURE(forward_dynamics, placed, placed(generic_robot(6, 3)));
BENCHMARK_CAPTURE(against_bullet, hexapod, hexapod())->Iterations(3);
BENCHMARK_CAPTURE(against_bullet, generic, generic_robot(6, 3))->Iterations(3);
BENCHMARK_CAPTURE(against_bullet, branching, branching_robot(6, 3))->Iterations(3);
BENCHMARK_CAPTURE(against_bullet, placed, placed(generic_robot(6, 3)))->Iterations(3);
BENCHMARK_CAPTURE(against_bullet, one_leg, generic_robot(1, 3))->Iterations(3);
BENCHMARK_CAPTURE(exponent, chains, with_chains, {1, 2, 4, 8, 16, 32, 64})->Iterations(1);
BENCHMARK_CAPTURE(exponent, branches, with_branches, {1, 2, 4, 8, 16, 32, 64})->Iterations(1);
BENCHMARK_CAPTURE(exponent, links, with_links, {2, 3, 4, 6, 8, 12, 16})->Iterations(1);

}  // namespace
}  // namespace hookpoint::tests
