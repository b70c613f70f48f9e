// A body's contact.force is the mean over the last step in every engine: with gravity it changes
// the momentum by itself times the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "reference/engines.h"
#include "reference/robot_tree.h"
#include "tests/support/reference_scenes.h"

namespace hookpoint {
namespace {

using namespace reference_scenes;

Vector3d momentum(const reference::RobotTree& tree, const simulation::WorldState& state) {
  Vector3d sum;
  for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
    const simulation::MassSpec& mass = tree.bodies[i].body->mass;
    const simulation::BodyState& body = state.bodies[i];
    const Vector3d arm = rotate(body.orientation, mass.center_of_mass);
    sum += mass.mass * (body.velocity + cross(body.angular_velocity, arm));
  }
  return sum;
}

/// Greatest of |dp - (F + m g) dt| in a step, and of their sum, over the greatest impulse of a step
/// and over all impulses.
struct Imbalance {
  double step = 0., sum = 0.;
};
Imbalance imbalance(const reference::Peer& peer, const simulation::Experiment& experiment,
                    double duration) {
  const auto engine = peer.make(experiment);
  const reference::RobotTree tree = reference::robot_tree(experiment);
  double mass = 0.;
  for (const auto& body : tree.bodies) mass += body.body->mass.mass;
  double greatest = 0., total = 0.;
  Imbalance worst;
  Vector3d left, before = momentum(tree, engine->state());
  while (engine->state().time < duration) {
    if (!engine->step().ok()) {
      ADD_FAILURE() << peer.name << " stopped";
      return worst;
    }
    Vector3d impulse;
    for (const auto& body : engine->state().bodies)
      impulse += experiment.deltat * body.contact_force;
    const Vector3d after = momentum(tree, engine->state());
    const Vector3d gap = after - before - impulse - mass * experiment.deltat * experiment.gravity;
    worst.step = std::max(worst.step, norm(gap));
    left += gap;
    greatest = std::max(greatest, norm(impulse));
    total += norm(impulse);
    before = after;
  }
  EXPECT_GT(total, 0.5 * mass * 9.81 * duration) << peer.name << ": it never landed";
  return {worst.step / greatest, norm(left) / total};
}

// A block thrown on a slope, which bounces, slides and rocks.
TEST(ContactForce, IsTheMomentumThatTheGroundGaveABodyInTheStep) {
  for (const auto& peer : reference::peers())
    for (const std::string settings : {"default", "recommended", "matched"}) {
      simulation::Experiment experiment = sloped_block(0.2, 0.3, 0.5, 2e-3, settings);
      experiment.robots[0].location += Vector3d{0., 0., 0.01};
      experiment.robots[0].velocity = {0.5, 0.3, -0.4};
      experiment.robots[0].angular_velocity = {1., -2., 0.5};
      const Imbalance found = imbalance(peer, experiment, 0.5);
      // MuJoCo's Newton iterations end at a tolerance.
      const double rounding = peer.name == "mujoco" ? 1e-6 : 1e-11;
      EXPECT_LT(found.step, rounding) << peer.name << " " << settings;
      EXPECT_LT(found.sum, rounding) << peer.name << " " << settings;
    }
}

// Touching by points, with a link that swings. Its joint forces are inner ones; in joint
// coordinates a step keeps the momentum of bodies to its own order only.
TEST(ContactForce, IsTheMomentumThatTheGroundGaveARobotWithALink) {
  for (const auto& peer : reference::peers()) {
    simulation::Experiment experiment = sloped_block(0.1, 0., 0.5, 2e-4, "matched");
    experiment.robots[0].location += Vector3d{0., 0., 0.01};
    for (const double x : {-0.1, 0.1})
      for (const double y : {-0.1, 0.1})
        experiment.robots[0].base.boundary_points.push_back({x, y, -0.05});
    simulation::LinkSpec& link = experiment.robots[0].chains.emplace_back().links.emplace_back();
    link.alpha = 1.;
    link.damping = 0.01;
    link.body.mass = {0.1, {0.1, 0., 0.}, {1e-3, 1e-3, 1e-3, 0., 0., 0.}};
    const double tolerance = peer.name == "simbody" ? 1e-5 : 2e-3;
    EXPECT_LT(imbalance(peer, experiment, 0.4).sum, tolerance) << peer.name;
  }
}

}  // namespace
}  // namespace hookpoint
