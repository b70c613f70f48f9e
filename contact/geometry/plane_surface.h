// The ground as one plane.
#pragma once

#include <cmath>

#include "contact/geometry/surface.h"

namespace hookpoint::contact {

class PlaneSurface final : public Surface {
 public:
  /// Through `point` [m] with the unit `normal`.
  PlaneSurface(const Vector3d& point, const Vector3d& normal, int material) {
    face_.normal = normal;
    face_.point = point;
    face_.material = material;
  }
  bool contains(const Vector3d& place) const override { return face_.height(place) < 0.; }
  Face face(std::int64_t /*id*/) const override { return face_; }
  bool is_clear_of(const Region& region) const override {
    const Vector3d half = 0.5 * (region.high - region.low);
    const Vector3d& n = face_.normal;
    return face_.height(region.low + half) >
           std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
  }
  Face nearest_face(const Vector3d& /*inside*/) const override { return face_; }
  void faces(const Region& /*region*/, Visit<Face> visit) const override { visit(face_); }
  void ridges(const Region& /*region*/, Visit<Ridge> /*visit*/) const override {}
  void corners(const Region& /*region*/, Visit<Corner> /*visit*/) const override {}

 private:
  Face face_;
};

}  // namespace hookpoint::contact
