// How a robot can stand on its ground: which of its boundary points touch at once, and the load
// that each carries (docs/contact.md, "Largest stable step").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulation/analysis/analysis_budget.h"
#include "simulation/analysis/joint_loops.h"
#include "simulation/analysis/linear_dynamics.h"

namespace hookpoint::simulation {

/// A boundary point that touches, and what it carries.
struct CarryingPoint {
  dts::BodyPoint<double> point;
  Eigen::MatrixXd lever;                        ///< RobotAtRest::lever of the point
  Vector3d normal;                              ///< of the ground there, unit
  contact::MaterialConstants<double> material;  ///< what the law reads there
  double load = 0.;                             ///< along the normal [N]
};

/// One way to stand.
struct Stance {
  std::vector<CarryingPoint> points;
  /// What keeps its direction while the robot moves: weights, Forces, and what the ground pushes.
  /// Empty where these are not in equilibrium, where they have no stiffness of their own.
  std::vector<SteadyLoad> loads;
};

struct Stances {
  /// Of a robot that the ground carries near its initial state one for each load that its Forces
  /// may make. Of one that falls or tips over, one for each face that it may come to lie on: those
  /// of the hull of its boundary points, of a robot with joints the ones that look down.
  std::vector<Stance> all;
  bool lands = false;            ///< the ground does not carry it near its initial state
  std::int64_t evaluations = 0;  ///< of the law at a point: what the equilibria have cost
};

/// Of a robot with boundary points above a ground, in the experiment's gravity. `control`: the
/// joints that it drives hold their angles, whatever that takes, but for those whose controller has
/// a goal of its own. O(points links^2) for the levers and for each of the tries of an equilibrium,
/// 200 at most for a face, and what convex_hull.h costs.
/// Throws OverBudget.
Stances find_stances(const Experiment& experiment, std::size_t index, const RobotAtRest& rest,
                     const WiredControl& control, AnalysisBudget& budget);

/// Turns the joints of a robot with a fixed base to where it hangs still, from where it is
/// downwards. False where it does already, where a controller holds it, or where it finds no rest.
/// O(links^3) for each of at most 200 tries, or as many as half of the budget is enough for.
bool hang(const Experiment& experiment, std::size_t index, const WiredControl& control,
          RobotSystem& robot, AnalysisBudget& budget);

}  // namespace hookpoint::simulation
