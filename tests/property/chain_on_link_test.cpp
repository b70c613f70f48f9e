// A chain on the last link of another is the same robot as one long chain: whatever asks a robot
// anything gives the same answer for both, and a robot written so in the language is that robot.
// ctest: released
#include <gtest/gtest.h>

#include <algorithm>

#include "simulation/analysis/controller_terms.h"
#include "simulation/analysis/dynamics_report.h"
#include "simulation/analysis/stability.h"
#include "simulation/dts_engine/dts_engine.h"
#include "tests/support/folders.h"
#include "tests/support/load_text.h"
#include "tests/support/printed_run.h"
#include "tests/support/run_text.h"

namespace hookpoint {
namespace {

using simulation::Experiment;

Experiment scene(const char* file) {
  const Loaded loaded =
      load_file(std::filesystem::path(testing::source_folder()) / "configs" / file);
  EXPECT_TRUE(loaded.experiment) << loaded.diagnostics;
  return *loaded.experiment;
}

/// The same robots, every link a chain of its own on the link before it.
Experiment cut(Experiment experiment) {
  for (simulation::RobotSpec& robot : experiment.robots) {
    std::vector<simulation::ChainSpec> pieces;
    std::size_t body = 0;
    for (const simulation::ChainSpec& chain : robot.chains) {
      for (const simulation::LinkSpec& link : chain.links) {
        simulation::ChainSpec& piece = pieces.emplace_back();
        piece.name = chain.name;
        piece.links = {link};
        if (&link != &chain.links.front()) {
          piece.carrier = body;
        } else {
          piece.hip_distance = chain.hip_distance;
          piece.hip_orientation = chain.hip_orientation;
        }
        ++body;
      }
    }
    robot.chains = std::move(pieces);
  }
  return experiment;
}

/// The largest difference of bodies' places and joints' angles after `steps`.
double difference(const Experiment& a, const Experiment& b, int steps) {
  const auto one = simulation::make_dts(a), other = simulation::make_dts(b);
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(one->step().ok() && other->step().ok());
  double largest = 0.;
  for (std::size_t i = 0; i < one->state().bodies.size(); ++i)
    largest = std::max(largest,
                       norm(one->state().bodies[i].position - other->state().bodies[i].position));
  for (std::size_t i = 0; i < one->state().joints.size(); ++i)
    largest =
        std::max(largest, std::abs(one->state().joints[i].angle - other->state().joints[i].angle));
  return largest;
}

TEST(ChainOnLink, MovesAsTheLinkWouldUnderEveryIntegrator) {
  for (const char* integrator :
       {"explicit_euler", "semi_implicit_euler", "rk4", "cvode_bdf", "cvode_adams"})
    for (const char* file : {"scenes/standing_hexapod.hook", "paper/fig7_two_joint_arm.hook",
                             "scenes/double_pendulum.hook", "scenes/free_flying_hexapod.hook"}) {
      Experiment whole = scene(file);
      whole.integrator = integrator;
      whole.deltat = std::min(whole.deltat, 2e-4);
      // The arm moves: its fixed base keeps chains from feeling each other.
      for (simulation::ChainSpec& chain : whole.robots[0].chains)
        for (simulation::LinkSpec& link : chain.links) link.rate += 0.5;
      // An adaptive integrator makes both right within its tolerances.
      const bool adapts = std::string(integrator).starts_with("cvode");
      EXPECT_LT(difference(whole, cut(whole), 100), adapts ? 1e-7 : 1e-9)
          << file << ' ' << integrator;
    }
}

TEST(ChainOnLink, IsStruckAsTheLinkWouldBe) {
  Experiment whole = scene("scenes/standing_hexapod.hook");
  whole.contact = "impulse";
  whole.robots[0].location.z += 1e-3;
  EXPECT_LT(difference(whole, cut(whole), 200), 1e-9);
}

TEST(ChainOnLink, HasTheSameStableStepAndTerms) {
  const Experiment whole = scene("scenes/standing_hexapod.hook"), pieces = cut(whole);
  const double step = simulation::stability_bound(whole).step;
  EXPECT_NEAR(simulation::stability_bound(pieces).step, step, 1e-9 * step);
  const simulation::ControllerTerms a(whole, 0), b(pieces, 0);
  const auto expect_equal = [](const std::vector<double>& found, const std::vector<double>& truth,
                               double tolerance) {
    ASSERT_EQ(found.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(found[i], truth[i], tolerance);
  };
  expect_equal(b.mass_matrix(), a.mass_matrix(), 1e-13);
  expect_equal(b.bias_forces(), a.bias_forces(), 1e-12);
  for (std::size_t body = 0; body < a.bodies().size(); ++body)
    expect_equal(b.jacobian(body, {0.1, 0.2, 0.3}), a.jacobian(body, {0.1, 0.2, 0.3}), 1e-14);
  // Gravity's own stiffness and the springs of the joints are in the linearisation.
  const std::vector<double> none(18);
  expect_equal(b.linearised(none).A, a.linearised(none).A, 1e-3);
}

TEST(ChainOnLink, PullsAtItsLinkWithWhatTheWholeChainPullsAtTheBase) {
  const Experiment whole = scene("scenes/free_flying_hexapod.hook");
  const auto a = simulation::evaluate_dynamics(whole).robots[0];
  const auto b = simulation::evaluate_dynamics(cut(whole)).robots[0];
  for (std::size_t leg = 0; leg < 6; ++leg) {
    EXPECT_LT(norm(b.chains[3 * leg].hip_force - a.chains[leg].hip_force), 1e-12);
    EXPECT_LT(norm(b.chains[3 * leg].hip_moment - a.chains[leg].hip_moment), 1e-12);
    EXPECT_EQ(b.chains[3 * leg].carrier, "base");
    EXPECT_EQ(b.chains[3 * leg + 2].carrier, a.chains[leg].name + ".femur");
  }
}

const std::string lower =
    "Link lower { dhlength = 0.9; dhtwist = 20 deg; angle = 0.4; mass = 0.5 kg; center_of_mass = "
    "0.3, 0.1, 0; inertia = 1e-3, 1e-3, 1e-3, 0, 0, 0; }";

std::string arm(const std::string& inside, const std::string& after) {
  return "World w { deltat = 0.2 ms; Robot r { Base.fixed { orientation = 90 deg, 0, 0; } Chain "
         "arm "
         "{ Link upper { dhangle = 10 deg; mass = 1 kg; center_of_mass = 1, 0, 0; inertia = 1e-3, "
         "1e-3, 1e-3, 0, 0, 0; " +
         inside + " } " + after + " } } }";
}

TEST(ChainOnLink, IsWrittenInTheLinkThatCarriesIt) {
  Running serial(load_text(arm("", lower)));
  Running nested(load_text(arm("Chain fore { " + lower + " }", "")));
  serial.step(500);
  nested.step(500);
  EXPECT_NEAR(nested["r.arm.upper.fore.lower.angle"], serial["r.arm.lower.angle"], 1e-12);
  EXPECT_NEAR(nested["r.arm.upper.fore.lower.location.x"], serial["r.arm.lower.location.x"], 1e-12);
}

TEST(ChainOnLink, CountsLinksOfAChainBeforeThoseOfWhatItCarries) {
  const std::string link = " { mass = 1 kg; inertia = 1, 1, 1, 0, 0, 0; ";
  const Loaded loaded =
      load_text("World w { Robot r { Base.fixed; Chain a { Link l1" + link + "Chain b { Link l3" +
                link + "} } Chain c { Link l4" + link + "Chain d { Link l5" + link +
                "} } } } } Link l2" + link + "} } Chain e { Link l6" + link +
                "} } } Force push { body = r.a.l1.c.l4; force = 1, 0, 0; } }");
  ASSERT_TRUE(loaded.experiment) << loaded.diagnostics;
  const simulation::RobotSpec& robot = loaded.experiment->robots[0];
  std::vector<std::string> names;
  std::vector<std::size_t> carriers;
  for (const simulation::ChainSpec& chain : robot.chains) {
    names.push_back(chain.name);
    carriers.push_back(chain.carrier);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"a", "a.l1.b", "a.l1.c", "a.l1.c.l4.d", "e"}));
  EXPECT_EQ(carriers, (std::vector<std::size_t>{0, 1, 1, 4, 0}));
  EXPECT_EQ(loaded.experiment->forces.at(0).body, 4);
}

TEST(ChainOnLink, AJointThatMovesNoInertiaIsToldOfOnlyWhereNothingThatItCarriesHasOne) {
  const std::string massless = "Chain arm { Link upper { Chain fore { Link lower { ";
  const Loaded good =
      load_text("World w { Robot r { Base.fixed; " + massless +
                "mass = 1 kg; center_of_mass = 1, 0, 0; inertia = 1, 1, 1, 0, 0, 0; "
                "} } } } } }");
  EXPECT_TRUE(good.experiment) << good.diagnostics;
  const Loaded bad = load_text("World w { Robot r { Base.fixed; " + massless + "} } } } } }");
  EXPECT_FALSE(bad.experiment);
  EXPECT_NE(bad.diagnostics.find("the joint of `upper` moves no inertia"), std::string::npos);
  EXPECT_NE(bad.diagnostics.find("the joint of `lower` moves no inertia"), std::string::npos);
}

TEST(ChainOnLink, PrintsAsAFileThatMeansTheSame) {
  testing::expect_printed_runs_alike("scenes/tumbling_acrobat.hook",
                                     "world.acrobat.waist.torso.arm[1].lower.location.x,"
                                     "world.acrobat.waist.torso.neck.hip_force.z");
}

}  // namespace
}  // namespace hookpoint
