// Stairs as they are: level treads, vertical risers.
#pragma once

#include "contact/geometry/surface.h"
#include "contact/terrain/terrain.h"

namespace hookpoint::contact {

/// Treads k = 0 ... count at heights k h, tread 0 before the first riser and the last to infinity;
/// riser k stands between the treads k and k + 1. Sideways all of them are without end. Faces: 2 k is
/// tread k, 2 k + 1 riser k.
class StairsSurface final : public Surface {
 public:
  StairsSurface(const StairsProfile& profile, int material)
      : profile_(profile),
        sideways_{-profile.uphill.y, profile.uphill.x, 0.},
        last_(static_cast<std::int64_t>(profile.count)),
        material_(material) {}

  bool contains(const Vector3d& place) const override;
  Face face(std::int64_t id) const override;
  Face nearest_face(const Vector3d& inside) const override;
  std::int64_t face_over(const Vector3d& inside, const Vector3d& outward) const override;
  bool is_clear_of(const Region& region) const override;
  void faces(const Region& region, Visit<Face> visit) const override;
  void ridges(const Region& region, Visit<Ridge> visit) const override;
  void corners(const Region& /*region*/, Visit<Corner> /*visit*/) const override {}

 private:
  /// The tread over (or under) a place `along` the stairs [m].
  std::int64_t tread_at(double along) const;
  double along(const Vector3d& place) const { return dot(place, profile_.uphill); }
  /// Of riser k [m].
  double riser(std::int64_t k) const {
    return profile_.from + static_cast<double>(k) * profile_.run;
  }
  double level(std::int64_t k) const { return static_cast<double>(k) * profile_.height; }
  Face tread(std::int64_t k) const;
  Face riser_face(std::int64_t k) const;
  /// First and last tread that a region may meet.
  struct Range {
    std::int64_t first, last;
  };
  Range treads(const Region& region) const;

  StairsProfile profile_;
  Vector3d sideways_;
  std::int64_t last_;  ///< tread
  int material_;
};

}  // namespace hookpoint::contact
