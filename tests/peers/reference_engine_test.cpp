// What every peer promises beside its physics: the same bytes on any number of threads, failures
// with time, body and advice, gaps named, and a table of every setting.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "reference/engines.h"
#include "reference/experiment_checks.h"
#include "reference/ode/engine.h"
#include "simulation/experiment/material_fields.h"
#include "tests/support/reference_scenes.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;

/// The block's motion over 0.3 s, thrown at the ground so that the solver has work. Every other
/// pair of runs falls on the tiles of a grid, where the peer has grids, and every third block
/// carries a pendulum.
std::vector<double> trace(const reference::Peer& peer, int run) {
  simulation::Experiment experiment = sloped_block(15. * degree, 0.1 * run, 0.5, 1e-3);
  experiment.robots[0].location += Vector3d{0., 0., 0.02};
  experiment.robots[0].angular_velocity = {0.3, -0.5, 0.2 * run};
  if (run / 2 % 2 == 1 && !refuses(peer, reference::feature::height_field)) {
    experiment.terrain->spacing = 0.07;
    experiment.terrain->surface =
        simulation::GridSpec{20, 20, std::vector<double>(400, 0.), -0.7, -0.7};
  }
  if (run % 3 == 2) {
    for (const double x : {-0.1, 0.1})
      for (const double y : {-0.1, 0.1})
        experiment.robots[0].base.boundary_points.push_back({x, y, -0.05});
    simulation::LinkSpec& link = experiment.robots[0].chains.emplace_back().links.emplace_back();
    link.alpha = 1.;
    link.body.mass = {0.3, {0.1, 0., 0.}, {1e-3, 1e-3, 1e-3, 0., 0., 0.}};
  }
  const auto engine = peer.make(experiment);
  std::vector<double> values;
  for (int i = 0; i < 300 && engine->step().ok(); ++i) {
    const auto& body = engine->state().bodies[0];
    values.insert(values.end(), {body.position.x, body.position.y, body.position.z,
                                 body.orientation.w, body.velocity.x, body.contact_force.z});
  }
  return values;
}

TEST(PeerEngine, GivesTheSameBytesOnAnyNumberOfThreads) {
  constexpr int runs = 8;
  for (const auto& peer : reference::peers()) {
    std::vector<std::vector<double>> alone(runs), together(runs);
    for (int i = 0; i < runs; ++i) alone[i] = trace(peer, i);
    {
      const auto half = [&](int first) {
        for (int i = first; i < runs; i += 2) together[i] = trace(peer, i);
      };
      const std::jthread even(half, 0), odd(half, 1);
    }
    for (int i = 0; i < runs; ++i) {
      ASSERT_EQ(alone[i].size(), 1800u) << peer.name;
      ASSERT_EQ(alone[i].size(), together[i].size()) << peer.name;
      EXPECT_EQ(std::memcmp(alone[i].data(), together[i].data(), 1800 * sizeof(double)), 0)
          << peer.name << " run " << i;
    }
  }
}

TEST(PeerEngine, StopsWhereTheStateIsNotFinite) {
  for (const auto& peer : reference::peers()) {
    simulation::Experiment experiment = sloped_block(15. * degree, 0., 0.5, 1e-3);
    const auto engine = peer.make(experiment);
    simulation::ForceSpec force;
    force.force = {std::numeric_limits<double>::infinity(), 0., 0.};
    experiment.forces.push_back(force);
    const auto broken = peer.make(experiment);
    const auto status = broken->step();
    EXPECT_EQ(status.kind, simulation::StepStatus::Kind::not_finite) << peer.name;
    EXPECT_EQ(status.body, "block.base") << peer.name;
    EXPECT_EQ(status.time, 0.) << peer.name;
    EXPECT_FALSE(status.advice.empty()) << peer.name;
    EXPECT_EQ(broken->state().step, 0) << peer.name;
    EXPECT_EQ(broken->state().bodies[0].position, experiment.robots[0].location) << peer.name;
    EXPECT_FALSE(broken->step().ok()) << peer.name;
    EXPECT_TRUE(engine->step().ok()) << peer.name;
  }
}

TEST(PeerEngine, NeitherCrashesNorPublishesNonsenseAtAbsurdSpeeds) {
  for (const auto& peer : reference::peers()) {
    simulation::Experiment experiment = sloped_block(15. * degree, 0., 0.5, 1e-3);
    experiment.robots[0].velocity = {1e300, 0., 1e300};
    experiment.robots[0].angular_velocity = {0., 1e300, 0.};
    const auto engine = peer.make(experiment);
    for (int i = 0; i < 10; ++i) {
      engine->step();
      EXPECT_TRUE(std::isfinite(norm(1e-200 * engine->state().bodies[0].position))) << peer.name;
      EXPECT_TRUE(std::isfinite(norm(1e-200 * engine->state().bodies[0].velocity))) << peer.name;
    }
  }
}

TEST(PeerEngine, LeavesAFixedBodyWhereItIs) {
  for (const auto& peer : reference::peers()) {
    simulation::Experiment experiment = sloped_block(15. * degree, 0., 0.5, 1e-3);
    simulation::RobotSpec post = block();
    post.name = "post";
    post.mobile = false;
    post.location = {3., 0., 2.};
    experiment.robots.insert(experiment.robots.begin(), post);
    const auto engine = peer.make(experiment);
    ASSERT_TRUE(run_until(*engine, 1e-3, 0.1));
    EXPECT_EQ(engine->state().bodies[0].position, post.location) << peer.name;
    EXPECT_NEAR(engine->state().bodies[1].contact_force.z, g, 0.1 * g) << peer.name;
  }
}

void expect_refusal(const simulation::Experiment& experiment, const std::string& named) {
  for (const auto& peer : reference::peers()) {
    const std::string message = refusal(peer, experiment);
    EXPECT_NE(message.find("engine " + std::string(peer.name)), std::string::npos) << message;
    EXPECT_NE(message.find(named), std::string::npos) << message;
  }
}

TEST(PeerEngine, NamesWhatItCannotRun) {
  const simulation::Experiment good = sloped_block(15. * degree, 0., 0.5, 1e-3);
  simulation::Experiment shapeless = good;
  shapeless.robots[0].base.shapes.clear();
  expect_refusal(shapeless, "no shape");
  simulation::Experiment massless = good;
  massless.robots[0].base.mass.mass = 0.;
  expect_refusal(massless, "mass above 0");
  simulation::Experiment settings = good;
  settings.settings = "best";
  expect_refusal(settings, ": choose default, recommended");
  settings.settings = "noslip";
  for (const auto& peer : reference::peers())
    if (peer.name != "mujoco") {
      EXPECT_NE(refusal(peer, settings).find("default, recommended or matched"), std::string::npos);
    }
}

TEST(PeerEngine, NamesTheGapThatAnExperimentMeets) {
  simulation::Experiment experiment = sloped_block(15. * degree, 0., 0.5, 1e-3);
  simulation::ChainSpec& leg = experiment.robots[0].chains.emplace_back();
  leg.name = "leg";
  leg.links.emplace_back().body.name = "shin";  // without mass
  for (const auto& peer : reference::peers()) {
    const auto gaps = peer.describe().gaps;
    const bool lacks = std::ranges::any_of(
        gaps, [](const auto& gap) { return gap.feature == "links without mass"; });
    const std::string message = refusal(peer, experiment);
    EXPECT_EQ(message.find("leg.shin carries no mass") != std::string::npos, lacks) << message;
    EXPECT_FALSE(gaps.empty()) << peer.name;
    for (const auto& gap : gaps) EXPECT_FALSE(gap.feature.empty() || gap.instead.empty());
  }
}

TEST(PeerEngine, SaysThatItTakesTheKineticOfTwoFrictions) {
  simulation::Experiment experiment = sloped_block(15. * degree, 0., 0.2, 1e-3);
  experiment.materials[0].constants.static_friction = 0.8;
  for (const auto& peer : reference::peers()) {
    if (!gap_of(peer, reference::feature::two_frictions)) continue;  // it takes both
    const auto engine = peer.make(experiment);
    ASSERT_EQ(engine->state().notices.size(), 1u) << peer.name;
    EXPECT_NE(engine->state().notices[0].find("kinetic"), std::string::npos) << peer.name;
    ASSERT_TRUE(run_until(*engine, 1e-3, 0.5));
    EXPECT_GT(norm(engine->state().bodies[0].velocity), 0.1) << peer.name;  // 0.8 would hold it
  }
}

// MuJoCo and Simbody have no restitution, Bullet has one only for large steps; at `matched` no
// engine reads it.
TEST(PeerEngine, SaysWhereItDoesNotReadTheRestitution) {
  simulation::Experiment experiment = sloped_block(0., 0., 0.5, 1e-3);
  for (const auto& peer : reference::peers()) {
    const auto notices = [&](double restitution, const char* settings) {
      experiment.materials[0].constants.restitution = restitution;
      experiment.settings = settings;
      return peer.make(experiment)->state().notices;
    };
    EXPECT_TRUE(notices(0., "matched").empty()) << peer.name;
    const auto matched = notices(0.5, "matched");
    ASSERT_EQ(matched.size(), 1u) << peer.name;
    EXPECT_NE(matched[0].find("restitution"), std::string::npos) << matched[0];
    const bool always = gap_of(peer, reference::feature::restitution).has_value();
    EXPECT_EQ(notices(0.5, "default").size(), always ? 1u : 0u) << peer.name;
    EXPECT_EQ(always, peer.name == "mujoco" || peer.name == "simbody" || peer.name == "bullet");
  }
}

TEST(PeerEngine, SaysWhichConstantsItDoesNotRead) {
  for (const auto& peer : reference::peers()) {
    if (!peer.found()) continue;
    for (const std::string& settings : peer.settings_names()) {
      simulation::Experiment experiment = sloped_block(15. * degree, 0.2, 0.5, 1e-3, settings);
      experiment.materials[0].name = "clay";
      for (const simulation::MaterialField& field : simulation::material_fields())
        experiment.materials[0].meant.push_back(field.member);
      const auto notices = peer.make(experiment)->state().notices;
      const auto told = std::ranges::find_if(notices, [&](const std::string& notice) {
        return notice.find("of material 'clay' are not read at `settings = " + settings + "`") !=
               std::string::npos;
      });
      ASSERT_NE(told, notices.end()) << peer.name << " " << settings;
      const std::string list = told->substr(0, told->find(" of material"));
      const std::vector<double> as_it_is =
          thrown(peer, settings, &contact::MaterialConstants<double>::normal_stiffness, 1.);
      for (const simulation::MaterialField& field : simulation::material_fields()) {
        const bool friction =
            field.member == &contact::MaterialConstants<double>::static_friction ||
            field.member == &contact::MaterialConstants<double>::kinetic_friction;
        // Nothing is a factor of 0, and friction has notices of its own.
        if (friction || contact::MaterialConstants<double>{}.*field.member == 0.) continue;
        const bool reads = thrown(peer, settings, field.member, 0.7) != as_it_is;
        const bool said = list.find("`" + std::string(field.name) + "`") != std::string::npos;
        EXPECT_NE(reads, said) << peer.name << " " << settings << " " << field.name;
      }
    }
  }
}

TEST(PeerEngine, SaysNothingOfConstantsThatNobodyMeans) {
  for (const auto& peer : reference::peers()) {
    if (!peer.found()) continue;
    for (const std::string& notice :
         peer.make(sloped_block(15. * degree, 0., 0.5, 1e-3))->state().notices)
      EXPECT_EQ(notice.find("not read"), std::string::npos) << notice;
  }
}

// Without samples there is nothing to touch with in its place.
TEST(PeerEngine, RunsALegconeOrNamesIt) {
  simulation::Experiment experiment = sloped_block(0., 0., 0.5, 1e-3);
  experiment.robots[0].base.shapes[0].geometry = simulation::Legcone{0.3, 0.05, 0.05};
  experiment.robots[0].base.shapes[0].location = {-0.15, 0., 0.};
  for (const auto& peer : reference::peers()) {
    if (gap_of(peer, reference::feature::legcone)) {
      EXPECT_NE(refusal(peer, experiment).find("no shape"), std::string::npos) << peer.name;
      continue;
    }
    const auto engine = peer.make(experiment);
    ASSERT_TRUE(run_until(*engine, 1e-3, 1.));
    EXPECT_NEAR(engine->state().bodies[0].position.z, 0.05, 5e-4);
  }
}

// With a mixing of 0 four corners on a plane are a singular system (docs/reference_engines.md).
TEST(PeerEngine, NeverRunsOdeWithoutMixing) {
  for (const reference::Peer* ode : {&reference::ode_peer, &reference::ode_quickstep_peer})
    for (const char* settings : {"default", "recommended", "matched"}) {
      const auto constants =
          ode->constraint_constants(sloped_block(15. * degree, 0., 0.5, 1e-3, settings));
      EXPECT_GE(constants.normal_mixing, 1e-10) << ode->name << settings;
      EXPECT_GE(constants.tangential_mixing, 1e-10) << ode->name << settings;
    }
}

TEST(PeerEngine, OfALibraryThatTheBuildLacksIsKnownAndRefuses) {
  reference::Peer absent = reference::ode_peer;
  absent.version = {};
  absent.make_world = nullptr;
  EXPECT_FALSE(absent.describe().found);
  try {
    reference::make_peer_engine(sloped_block(15. * degree, 0., 0.5, 1e-3), absent);
    FAIL() << "an engine without a library";
  } catch (const simulation::ExperimentError& error) {
    EXPECT_STREQ(error.what(),
                 "engine ode: this build has no ODE; install libode-dev and build again");
  }
}

TEST(PeerEngine, DescribesItselfAndEverySetting) {
  for (const auto& peer : reference::peers()) {
    const auto description = peer.describe();
    EXPECT_EQ(description.name, peer.name);
    EXPECT_EQ(description.precision, "double");
    EXPECT_FALSE(description.version.empty());
    std::vector<std::string> settings{"default", "recommended", "matched"};
    if (peer.name == "mujoco") settings.insert(settings.end(), {"noslip", "file"});
    EXPECT_EQ(description.settings, settings);
    for (const auto& row : peer.settings_table()) {
      EXPECT_FALSE(row.default_.empty() || row.recommended.empty() || row.matched.empty())
          << row.quantity;
      EXPECT_FALSE(row.source.empty()) << row.quantity;
    }
  }
  EXPECT_THROW(reference::peer_named("no_engine"), std::invalid_argument);
}

}  // namespace
}  // namespace hookpoint
