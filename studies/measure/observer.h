// One step of a run as metrics see it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "contact/terrain/rolling.h"
#include "studies/measure/run_context.h"
#include "studies/measure/touching_shapes.h"

namespace hookpoint::studies {

/// A boundary point of the measured robot: its base's first, then its links', chain by chain.
struct PointObservation {
  Vector3d position;  ///< world [m]; of a ball, where it meets the ground, less what rolling made
                      ///< of that since the start: it moves by slip
  double depth = 0.;  ///< along the ground's normal, > 0 inside [m]; minus infinity without ground
};

/// The foot of a chain of the measured robot: of the boundary points of its last link the one that
/// is deepest in the ground, or nearest to it. Where shapes matter, of the places in which its last
/// link touches the ground or an obstacle the deepest.
struct FootObservation {
  std::size_t chain = 0;  ///< among the robot's
  std::size_t point = 0;  ///< among the link's
  double depth = 0.;      ///< along the ground's normal, > 0 inside [m]
  Vector3d position;      ///< where it meets the ground, or would, world [m]
  Vector3d normal;        ///< of the ground there
  Vector3d slip;     ///< of the material there along the ground since the step before [m]; 0 if
                     ///< another point was deepest then
  int contacts = 0;  ///< of the link: boundary points that carried ground force
};

/// One step as metrics see it.
struct Observation {
  const simulation::WorldState& world;
  const simulation::BodyState& body;  ///< at rest at the origin in a world without bodies
  double displacement = 0.;           ///< of the body's origin since the start, downhill [m]
  double height = 0.;  ///< of the body's origin over the ground, along its normal [m]; infinite
                       ///< without ground
  std::span<const PointObservation> points;         ///< empty unless a metric needs them
  const simulation::WorldInputs* inputs = nullptr;  ///< of the step to come, where they are known
  std::span<const FootObservation> feet{};  ///< empty unless a metric needs them, or without ground
  /// One a chain, above 0.5 while its leg is to stand; empty unless a metric needs them and a gait
  /// tells.
  std::span<const double* const> stance{};
  /// Of the measured robot, since the start [J]; nothing unless a metric needs it and the engine tells.
  std::optional<double> numerical_energy{};
  double driven_work = 0.;  ///< with it, work of what drives the robot since the start [J]
};

/// Whether `settle` has come. Half a step before counts: times are multiples of the step, rounded.
inline bool settled(const RunContext& context, const Observation& observation) {
  return observation.world.time >= context.settle - 0.5 * context.experiment->deltat;
}

/// A ball at the last observation, and how far it has rolled.
struct RolledBall {
  contact::BallFrame frame;
  Vector3d rolled;  ///< [m]
};

/// A foot as an Observer follows it.
struct FollowedFoot {
  std::size_t chain = 0;  ///< among the robot's
  std::size_t body = 0;   ///< of its link in WorldState::bodies
  const simulation::BodySpec* spec = nullptr;
  contact::BallFrame frame{};      ///< how its deepest point stood at the last observation
  simulation::BodyState before{};  ///< at the last observation
};

/// Makes observations of a run; its buffers are sized once.
class Observer {
 public:
  Observer(const RunContext& context, bool with_points, bool with_feet = false);
  /// Valid until the next call. Where shapes matter and `inputs` are not known, feet and points are
  /// held against the tiles below them.
  Observation observe(const simulation::WorldState& world,
                      const simulation::WorldInputs* inputs = nullptr);

 private:
  void observe_points(const simulation::WorldState& world);
  void observe_feet(const simulation::WorldState& world);
  /// Puts what shapes touch in place of what the tiles below say.
  void observe_shapes(const simulation::WorldState& world, const simulation::WorldInputs& inputs);
  /// The next point: a ball of `radius` about p_WP on a body that is turned by R_WB.
  void observe_point(const Vector3d& p_WP, const Quaterniond& R_WB, double radius);

  const RunContext& context_;
  std::vector<PointObservation> points_;   // reserved for all points; no room when nobody asks
  std::vector<std::size_t> first_points_;  // of each of the robot's bodies, where there is room
  std::vector<RolledBall> balls_;          // one a point, once they were seen
  std::vector<FollowedFoot> followed_;     // one a foot that is needed
  std::vector<FootObservation> feet_;      // of these, once they were seen
  std::optional<TouchingShapes> shapes_;   // where they matter
  double shown_ = 0.;                      // time of the last observation [s]
};

}  // namespace hookpoint::studies
