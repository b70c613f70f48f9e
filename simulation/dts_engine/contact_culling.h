// Culling of contacts: bodies too far above the ground for any of their boundary points to feel it
// are passed over, and nothing that is published differs but by the time that it takes.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "contact/terrain/terrain.h"
#include "dts/workspace.h"
#include "simulation/dts_engine/contact_point.h"

namespace hookpoint::simulation {

class ContactCulling {
 public:
  explicit ContactCulling(std::size_t bodies) : boxes_(bodies), culled_(bodies) {}

  /// From now on the body, which has those boundary points, may be culled. `reach` [m]: farthest
  /// above any ground where the law still acts.
  void allow(std::size_t body, std::span<const ContactPoint> points, double reach);

  /// Whether the body may be culled, and none of its boundary points is within the law's reach.
  bool is_above(std::size_t body, const dts::BodyMotion<double>& motion,
                const contact::Terrain& ground) const;
  /// An accepted state has been evaluated, at which the body was above the ground or not. True
  /// where it is culled from here on: its points have left the ground.
  bool accept(std::size_t body, bool above);
  /// Whether the body was passed over at the last accepted state.
  bool is_culled(std::size_t body) const { return culled_[body] > 0; }
  /// A step is committed. False where that changes no memory of the body: it has been culled for as
  /// many steps as are remembered.
  bool commits(std::size_t body);
  /// No body is culled until the next accepted state.
  void forget();

 private:
  /// The smallest box, along its body's axes, that holds the boundary points of a body.
  struct PointsBox {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    Vector3d center;                              ///< body axes [m]
    Vector3d half{infinity, infinity, infinity};  ///< half its edges [m]; not finite: not culled
    double reach = 0.;                            ///< of the law [m]
  };

  std::vector<PointsBox> boxes_;  ///< of each body
  std::vector<int> culled_;       ///< of each body: 0, or 1 and the commits since it is culled
};

/// Whether nothing shows it when a body of robot `robot` with these boundary points is passed over:
/// balls roll on in the air, and points that the experiment publishes are shown there.
bool may_be_culled(const Experiment& experiment, std::size_t robot, std::size_t body,
                   std::span<const ContactPoint> points);

}  // namespace hookpoint::simulation
