// The 18-joint hexapod of the speed measurements, and a generic robot of any number and length of
// legs.
#pragma once

#include <numbers>

#include "dts/mass_properties.h"

namespace hookpoint::tests {

/// A leg segment `length` long and `mass` heavy, a legcone along the link's x.
inline dts::LinkDescription leg_segment(double a, double alpha, double length, double mass) {
  dts::LinkDescription link;
  link.a = a;
  link.alpha = alpha;
  link.mass = dts::legcone_mass(mass, length, 0.015, 0.01);
  return link;
}

/// Base 2 kg, 0.3 x 0.2 x 0.06 m; hips at x -0.12, 0, 0.12, y +-0.1; coxa 0.05 m 0.1 kg, femur 0.10
/// m 0.15 kg, tibia 0.15 m 0.12 kg. The coxa yaws, femur and tibia pitch.
inline dts::RobotDescription hexapod() {
  dts::RobotDescription robot;
  robot.mobile = true;
  robot.base = dts::box_mass(2., {0.3, 0.2, 0.06});
  for (const double x : {-0.12, 0., 0.12}) {
    for (const double side : {-1., 1.}) {
      dts::ChainDescription leg;
      leg.hip_position = {x, side * 0.1, 0.};
      leg.hip_orientation = exponential(Vector3d{0., 0., side * std::numbers::pi / 2.});
      leg.links = {leg_segment(0., 0., 0.05, 0.1),
                   leg_segment(0.05, std::numbers::pi / 2., 0.10, 0.15),
                   leg_segment(0.10, 0., 0.15, 0.12)};
      robot.chains.push_back(leg);
    }
  }
  return robot;
}

/// `chains` legs of `links` links with no zero among their numbers, so that no structure is there
/// by accident.
inline dts::RobotDescription generic_robot(std::size_t chains, std::size_t links) {
  dts::RobotDescription robot;
  robot.mobile = true;
  robot.base = {2., {0.01, -0.02, 0.015}, {0.03, 0.04, 0.05, 0.001, -0.002, 0.003}};
  for (std::size_t k = 0; k < chains; ++k) {
    const double turn = 0.7 + 1.1 * double(k);
    dts::ChainDescription leg;
    leg.hip_position = {0.15 * std::cos(turn), 0.12 * std::sin(turn), 0.01};
    leg.hip_orientation = exponential(Vector3d{0.2, -0.1, turn});
    for (std::size_t n = 0; n < links; ++n) {
      const double s = double(n + 1) / double(links);
      dts::LinkDescription link;
      link.a = 0.04 + 0.03 * s;
      link.alpha = 1.3 - 2.1 * s;
      link.d = 0.02 - 0.03 * s;
      link.theta = 0.4 * s;
      link.mass = {0.12, {0.03, 0.005, -0.004}, {1e-4, 2e-4, 2.2e-4, 1e-5, -1.5e-5, 2e-5}};
      leg.links.push_back(link);
    }
    robot.chains.push_back(leg);
  }
  return robot;
}

/// `chains` legs of such a robot, of which each after the first two hangs on the end of one before:
/// a tree in which every leg carries two.
inline dts::RobotDescription branching_robot(std::size_t chains, std::size_t links) {
  dts::RobotDescription robot = generic_robot(chains, links);
  for (std::size_t k = 2; k < chains; ++k) robot.chains[k].carrier = (k / 2) * links;
  return robot;
}

}  // namespace hookpoint::tests
