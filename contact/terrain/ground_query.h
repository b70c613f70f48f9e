// The ground as the impulse laws see it, point by point.
#pragma once

#include <type_traits>

#include "contact/vocabulary.h"

namespace hookpoint::contact {

/// The tile under a point.
struct GroundPoint {
  double gap = 0.;  ///< distance to the tile's plane, > 0 above it [m]
  Vector3d normal;  ///< unit, out of the ground
  const MaterialConstants<double>* material = nullptr;
};

/// Any callable `GroundPoint(const Vector3d& world_point)`, or with `int foot_material`, the number of
/// the point's own material, as a second argument; referred to, not owned.
class GroundQuery {
 public:
  template <class Ground>
  requires(!std::is_same_v<Ground, GroundQuery>) GroundQuery(
      const Ground& ground)  // NOLINT(google-explicit-constructor): a view, like std::span
      : ground_(&ground),
        query_([](const void* self, const Vector3d& point, int foot_material) -> GroundPoint {
          const auto& query = *static_cast<const Ground*>(self);
          if constexpr (std::is_invocable_v<const Ground&, const Vector3d&, int>)
            return query(point, foot_material);
          else
            return query(point);
        }) {}
  GroundPoint operator()(const Vector3d& point, int foot_material) const {
    return query_(ground_, point, foot_material);
  }

 private:
  const void* ground_;
  GroundPoint (*query_)(const void*, const Vector3d&, int);
};

}  // namespace hookpoint::contact
