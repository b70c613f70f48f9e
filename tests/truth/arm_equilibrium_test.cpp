// Arms under PD control come to rest where the controllers bear the weight: p (goal - q) = dV/dq,
// with V from the Denavit-Hartenberg numbers of the file, solved here by itself. Through the
// program, as a user runs it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using Angles = std::vector<long double>;

struct Segment {
  long double a, alpha, d;   ///< modified Denavit-Hartenberg
  long double mass, center;  ///< kg; of the centre of mass along the link's x
};

/// Centre of mass of a solid truncated cone of length L from its face of radius R.
long double cone_center(long double L, long double R, long double r) {
  return L * (R * R + 2 * R * r + 3 * r * r) / (4 * (R * R + R * r + r * r));
}

const std::vector<Segment> figure_7{{0., 1.57L, 0.15L, 1., cone_center(1.L, .15L, .1L)},
                                    {0.1L, -1.57L, 0.4L, 1., cone_center(.65L, .1L, .05L)}};
const std::vector<Segment> arm3{
    {0., 0., 0.08L, 2., 0.},
    {0., std::numbers::pi_v<long double> / 2, 0., 1.5L, cone_center(.4L, .06L, .045L)},
    {0.4L, 0., 0., 1., cone_center(.35L, .045L, .03L)}};

/// m g z of all segments, along the chain: Rot_x(alpha) Trans_x(a) Rot_z(q) Trans_z(d).
long double potential(const std::vector<Segment>& arm, const Angles& q) {
  std::array<std::array<long double, 3>, 3> R{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  long double z = 0., V = 0.;
  for (std::size_t i = 0; i < arm.size(); ++i) {
    const Segment& link = arm[i];
    const long double ca = cosl(link.alpha), sa = sinl(link.alpha), cq = cosl(q[i]),
                      sq = sinl(q[i]);
    const std::array<std::array<long double, 3>, 3> T{
        {{cq, -sq, 0}, {sq * ca, cq * ca, -sa}, {sq * sa, cq * sa, ca}}};
    const std::array<long double, 3> p{link.a, -sa * link.d, ca * link.d};
    for (int k = 0; k < 3; ++k) z += R[2][k] * p[k];
    std::array<std::array<long double, 3>, 3> next{};
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        for (int k = 0; k < 3; ++k) next[row][column] += R[row][k] * T[k][column];
    R = next;
    V += link.mass * 9.81L * (z + R[2][0] * link.center);
  }
  return V;
}

long double slope(const std::vector<Segment>& arm, Angles q, std::size_t i) {
  const long double h = 1e-6L, at = q[i];
  q[i] = at + h;
  const long double above = potential(arm, q);
  q[i] = at - h;
  return (above - potential(arm, q)) / (2 * h);
}

/// Newton's method from the goals; one joint at a time is enough, as the springs are stiff.
Angles equilibrium(const std::vector<Segment>& arm, const Angles& goal, const Angles& p) {
  Angles q = goal;
  for (int round = 0; round < 200; ++round) {
    for (std::size_t i = 0; i < arm.size(); ++i) {
      const long double h = 1e-4L;
      Angles ahead = q;
      ahead[i] += h;
      const long double residual = p[i] * (goal[i] - q[i]) - slope(arm, q, i);
      const long double change = -p[i] - (slope(arm, ahead, i) - slope(arm, q, i)) / h;
      q[i] -= residual / change;
    }
  }
  for (std::size_t i = 0; i < arm.size(); ++i)
    EXPECT_LT(fabsl(p[i] * (goal[i] - q[i]) - slope(arm, q, i)), 1e-9L);
  return q;
}

/// The last row of a trace, without its time.
std::vector<double> last_row(const std::string& trace) {
  const std::string rows = trace.substr(0, trace.find_last_not_of('\n') + 1);
  std::istringstream row(rows.substr(rows.rfind('\n') + 1));
  std::vector<double> values;
  for (std::string cell; std::getline(row, cell, ',');) values.push_back(std::stod(cell));
  values.erase(values.begin());
  return values;
}

struct Run {
  std::string file, settings, record;
};
std::vector<double> end_of(const Run& run) {
  const testing::Workplace work;
  const auto result = work.hookpoint("run " + testing::config(run.file) + " --for 20s " +
                                     run.settings + " --record " + run.record + " --out here");
  EXPECT_EQ(result.status, 0) << result.err;
  return last_row(work.read("here/trace.csv"));
}

std::string set(const std::string& trail, long double value) {
  return " --set " + trail + "=" + std::to_string(static_cast<double>(value));
}

TEST(Figure7, SettlesWhereItsControllersBearItsWeight) {
  const std::vector<Angles> goals{{0., 0.}, {0.5, -0.3}, {1.2, 0.9}, {-2.5, 1.5}, {3., -3.}};
  const Angles p{300., 200.}, d{60., 30.};
  for (const Angles& goal : goals) {
    std::string settings;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string pd = "pd" + std::to_string(i + 1) + ".";
      settings +=
          set(pd + "goal", goal[i]) + set(pd + "pconstant", p[i]) + set(pd + "dconstant", d[i]);
    }
    const auto end = end_of({"paper/fig7_two_joint_arm.hook", settings,
                             "simplebot.leg1.link1.angle,simplebot.leg1.link2.angle"});
    const Angles expected = equilibrium(figure_7, goal, p);
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(end.at(i), static_cast<double>(expected[i]), 1e-6)
          << "link" << i + 1 << " of goal " << static_cast<double>(goal[0]);
    EXPECT_GT(fabsl(expected[0] - goal[0]), 1e-3L) << "gravity does nothing here";
  }
}

TEST(Arm3, SettlesWhereItsControllersBearItsWeight) {
  const std::string angles =
      "arm3.arm.shoulder.angle,arm3.arm.upper.angle,arm3.arm.fore.angle,pd2.goal";
  const Angles p{200., 400., 150.};
  const Angles as_written{std::numbers::pi_v<long double> / 6, std::numbers::pi_v<long double> / 4,
                          -std::numbers::pi_v<long double> / 3};
  const auto check = [&](const std::string& settings, const Angles& goal) {
    const auto end = end_of({"scenes/reaching_arm.hook", settings, angles});
    const Angles expected = equilibrium(arm3, goal, p);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(end.at(i), static_cast<double>(expected[i]), 1e-6) << settings << " joint " << i;
    EXPECT_EQ(end.at(3), static_cast<double>(goal[1])) << settings;
  };
  check("", as_written);
  check("--set pd2.goal=-0.4", {as_written[0], -0.4, as_written[2]});
  // A slider that is given a value drives the goal that it is wired to.
  check("--set controllers.joint2.goal.value=0.25", {as_written[0], 0.25, as_written[2]});
}

TEST(Figure7, AMovedSliderMovesTheGoal) {
  Running run(load_file(std::filesystem::path(testing::source_folder()) /
                        "configs/paper/fig7_two_joint_arm.hook"));
  const simulation::Port slider = run.port("controllers.goal_angle.value");
  EXPECT_EQ(run["pd1.goal"], 0.);
  *slider.writable = 0.7;
  run.step();
  EXPECT_EQ(run["pd1.goal"], 0.7);
  EXPECT_EQ(run["pd2.goal"], 0.);
}

}  // namespace
}  // namespace hookpoint
