// Scenes of public bug reports on other engines (tests/cases/), each with its truth, as a user runs them:
// under the laws that can, and in the other engines.
// ctest: long, released
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "reference/engines.h"
#include "tests/support/command.h"

namespace hookpoint {
namespace {

struct Case {
  std::string name;
  std::vector<std::string> subjects;  ///< what is asked of the run
};

std::vector<std::string> laws(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) all.push_back("--contact " + name);
  return all;
}

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Those that this build has.
std::vector<std::string> engines(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const reference::Peer& peer : reference::peers())
    if (std::ranges::find(names, peer.name) != names.end())
      all.push_back("--engine " + std::string(peer.name));
  return all;
}

// The constants of these scenes make the other force laws soft: bodies sink in by more than is judged, and
// hunt_crossley, whose friction creeps, drifts on a floor that shakes.
const std::vector<std::string> linear =
    laws({"hookpoint", "hookpoint_reset", "nominal", "lugre", "elastoplastic"});
const std::vector<std::string> soft = laws({"hunt_crossley", "azad_featherstone", "exponential"});
const std::vector<std::string> impulses = laws({"impulse", "impulse_reversal"});

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"wheel_rolls", linear + soft + impulses + engines({"ode", "bullet", "mujoco"})},
      {"ball_stops", linear + soft},
      {"treadmill", linear + soft + impulses},
      {"shaking_floor", linear + laws({"azad_featherstone", "exponential"}) + impulses},
      {"kicked_ball", linear + soft + impulses},
      {"two_soles", linear + laws({"azad_featherstone", "exponential"}) + impulses},
      {"sole_over_edge", linear + impulses + engines({"ode", "bullet", "mujoco", "dart"})},
      {"ball_in_groove", linear + impulses + engines({"ode", "bullet", "mujoco", "dart"})},
      {"ball_at_riser", linear + impulses + engines({"ode", "dart"})},
      {"leg_at_riser", linear + impulses + engines({"ode", "bullet", "mujoco", "dart"})},
      {"sole_pressure", linear + soft},
      {"magnet_foot", laws({"hookpoint", "hookpoint_reset", "lugre", "elastoplastic"})},
      {"skate", linear + soft},
  };
  return all;
}

class PublicCase : public ::testing::TestWithParam<Case> {};

TEST_P(PublicCase, HoldsItsTruth) {
  const testing::Workplace work;
  for (const std::string& subject : GetParam().subjects) {
    const testing::CommandResult run =
        work.hookpoint(fmt::format("run '{}/tests/cases/{}.hook' {} --out here",
                                   testing::source_folder(), GetParam().name, subject));
    EXPECT_EQ(run.status, 0) << subject << '\n' << run.out << run.err;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, PublicCase, ::testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace hookpoint
