// The bodies and joints of a robot in the order in which they are published: the base, then the
// links chain by chain. Joint l carries body l + 1.
#pragma once

#include <cstddef>
#include <vector>

#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// A link, the joint that carries it, and where they stand in the robot.
struct TreeLink {
  const ChainSpec& chain;
  const LinkSpec& link;
  std::size_t body;    ///< of the robot's bodies; 0 is the base
  std::size_t parent;  ///< the body that carries it: the preceding link, or its chain's carrier

  std::size_t joint() const { return body - 1; }
  bool is_first() const { return &link == &chain.links.front(); }  ///< of its chain
  bool is_last() const { return &link == &chain.links.back(); }    ///< of its chain
};

/// Calls `visit(TreeLink)` for every link. Allocates nothing.
template <class Visit>
void for_each_link(const RobotSpec& robot, Visit&& visit) {
  std::size_t body = 0;
  for (const ChainSpec& chain : robot.chains) {
    std::size_t parent = chain.carrier;
    for (const LinkSpec& link : chain.links) {
      ++body;
      visit(TreeLink{chain, link, body, parent});
      parent = body;
    }
  }
}

/// Calls `visit(BodySpec)` for the base and every link. Allocates nothing.
template <class Visit>
void for_each_body(const RobotSpec& robot, Visit&& visit) {
  visit(robot.base);
  for_each_link(robot, [&](const TreeLink& at) { visit(at.link.body); });
}

std::size_t joint_count(const RobotSpec& robot);
/// The base and the links.
std::size_t body_count(const RobotSpec& robot);
std::vector<const BodySpec*> bodies_of(const RobotSpec& robot);
/// The body that carries each; the base, 0, stands for its own. Its number is the lower.
std::vector<std::size_t> carriers_of(const RobotSpec& robot);
/// Whether a chain hangs on body `body`.
bool carries_chains(const RobotSpec& robot, std::size_t body);
/// Of the base and all links [kg]; `moving_mass` without a base that is fixed.
double robot_mass(const RobotSpec& robot);
double moving_mass(const RobotSpec& robot);

}  // namespace hookpoint::simulation
