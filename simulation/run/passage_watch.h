// Bodies that pass through an obstacle: one warning a run, with what would hold them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/dts_engine/shape_object.h"
#include "simulation/run/world.h"

namespace hookpoint::simulation {

/// Checks every few steps whether the middle of a shape crosses the middle plane of an obstacle inside the
/// obstacle: a convex body gets there only if it penetrates deeper than the obstacle is thick, or passes it
/// in one step. Of engine dts. O(shapes x obstacles) a check.
class PassageWatch {
 public:
  PassageWatch(const Experiment& experiment, const World& world);

  /// After each step.
  void observe() {
    if (!shapes_.empty() && finding_.empty()) look();
  }

  /// "'b.base' passed through Obstacle 'shelf' ...", or "".
  const std::string& finding() const { return finding_; }

 private:
  struct Shape {
    std::size_t object = 0;
    std::size_t body = 0;  ///< in WorldState::bodies
    Vector3d middle;       ///< body axes [m]
  };
  /// The plane through the middle of an obstacle, across its shortest side.
  struct Middle {
    std::size_t object = 0;
    Vector3d center, across;  ///< obstacle's axes [m, unit]
    double thickness = 0.;    ///< [m]
  };
  void look();
  Vector3d place(const Shape& shape, const Middle& middle) const;
  bool passes(const Middle& middle, const Vector3d& from, const Vector3d& to) const;
  std::string describe(const Shape& shape, const Middle& middle, double way) const;

  static constexpr std::int64_t interval = 8;  ///< from check to check [steps]

  const Experiment& experiment_;
  const World& world_;
  std::vector<ShapeObject> objects_;
  std::vector<Shape> shapes_;
  std::vector<Middle> middles_;
  std::int64_t step_ = -1;        ///< of `before_`; -1: none
  std::vector<Vector3d> before_;  ///< of each shape in the axes of each obstacle [m]
  std::string finding_;
};

}  // namespace hookpoint::simulation
