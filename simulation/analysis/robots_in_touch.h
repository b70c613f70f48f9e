// Where shapes touch at the start: which robots hold together, what each place carries, and all of it as
// one linear dynamics (docs/contact.md, "Largest stable step").
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "simulation/analysis/linear_dynamics.h"
#include "simulation/experiment/contact_materials.h"

namespace hookpoint::simulation {

/// A place where two shapes touch, or are so near that they do at the first step.
struct TouchingPlace {
  struct Side {
    std::size_t robot = 0;
    dts::BodyPoint<double> point;
  };
  std::optional<Side> a, b;  ///< none: terrain, an obstacle, or a robot that nothing moves
  Vector3d normal;           ///< unit, out of b
  double weight = 1.;        ///< of the law's force
  contact::MaterialConstants<double> material;
  double load = 0.;  ///< along the normal [N]
};

struct RobotsInTouch {
  std::vector<std::size_t> robots;    ///< by number, ascending
  std::vector<TouchingPlace> places;  ///< of these robots
};

/// The robots that touch something as shapes, in groups that touch each other. Loads are estimates: the
/// weight of a group, in equal parts on the places that hold it up. `robots`: all of the experiment's, at
/// their initial state. None under `touch = points`. O(detection + places).
std::vector<RobotsInTouch> robots_in_touch(const Experiment& experiment,
                                           const contact::Terrain* ground,
                                           const WorldInputs& inputs,
                                           std::span<const std::unique_ptr<RobotSystem>> robots);

/// The part of a group that is robot `robot` alone.
RobotsInTouch alone(const RobotsInTouch& group, std::size_t robot);

/// A place as springs: stiffness and damping along the normal and across [N/m, N s/m].
struct PlaceSpring {
  Eigen::Matrix3d stiffness, damping;
};

/// All robots of `group` on their places: coordinates and joints of one robot after the other. `rests`:
/// one a robot of the experiment; `springs`: one a place. A place that leads to a robot outside of the
/// group counts twice: with x = (x_a, x_b), |J_a x_a - J_b x_b|^2 <= 2 |J_a x_a|^2 + 2 |J_b x_b|^2, so that
/// the bounds of the parts hold for the whole. O(places size^2 + size^3).
LinearDynamics linear_dynamics(const RobotsInTouch& group, std::span<const RobotAtRest> rests,
                               std::span<const PlaceSpring> springs, const Vector3d& gravity);

}  // namespace hookpoint::simulation
