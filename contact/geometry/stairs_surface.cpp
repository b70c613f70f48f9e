#include "contact/geometry/stairs_surface.h"

#include <algorithm>
#include <cmath>

#include "contact/geometry/border.h"
#include "contact/geometry/cell_number.h"

namespace hookpoint::contact {
namespace {

constexpr Vector3d up{0., 0., 1.};

}  // namespace

std::int64_t StairsSurface::tread_at(double along) const {
  return cell_number((along - profile_.from) / profile_.run + 1., last_ + 1);
}

bool StairsSurface::contains(const Vector3d& place) const {
  return place.z < level(tread_at(along(place)));
}

// At a riser that goes up, the foot of the riser is a concave edge of the tread before it, and its
// head a convex one of the tread behind it; at one that goes down it is the other way round.
Face StairsSurface::tread(std::int64_t k) const {
  const bool rises = profile_.height > 0.;
  Face face;
  face.id = 2 * k;
  face.normal = up;
  face.point = level(k) * up;
  face.material = material_;
  const auto end = [&](std::int64_t k_riser, double outward, bool convex) {
    face.edges[face.edge_count++] = {riser(k_riser) * profile_.uphill + level(k) * up,
                                     outward * profile_.uphill,
                                     convex ? Fold::convex : Fold::concave, 2 * k_riser + 1};
  };
  if (k > 0) end(k - 1, -1., rises);
  if (k < last_) end(k, 1., !rises);
  return face;
}

Face StairsSurface::riser_face(std::int64_t k) const {
  const bool rises = profile_.height > 0.;
  Face face;
  face.id = 2 * k + 1;
  face.normal = (rises ? -1. : 1.) * profile_.uphill;
  face.point = riser(k) * profile_.uphill + level(k) * up;
  face.material = material_;
  const auto end = [&](std::int64_t k_tread, bool is_head) {
    face.edges[face.edge_count++] = {riser(k) * profile_.uphill + level(k_tread) * up,
                                     (is_head ? 1. : -1.) * up,
                                     is_head ? Fold::convex : Fold::concave, 2 * k_tread};
  };
  end(k, !rises);
  end(k + 1, rises);
  return face;
}

Face StairsSurface::face(std::int64_t id) const {
  return id % 2 == 0 ? tread(id / 2) : riser_face(id / 2);
}

Face StairsSurface::nearest_face(const Vector3d& inside) const {
  const std::int64_t k = tread_at(along(inside));
  Face nearest = tread(k);
  const bool rises = profile_.height > 0.;
  const std::int64_t before = rises ? k - 1 : k;
  if (before < 0 || before >= last_) return nearest;
  const Face beside = riser_face(before);
  const double foot = std::min(level(before), level(before + 1));
  return inside.z > foot && beside.height(inside) > nearest.height(inside) ? beside : nearest;
}

// Flush with a riser that is behind it a corner is under the tread.
std::int64_t StairsSurface::face_over(const Vector3d& inside, const Vector3d& outward) const {
  const Face nearest = nearest_face(inside);
  const bool is_behind = on_border(nearest, inside) && outward != Vector3d{} &&
                         !points_against(outward, nearest.normal);
  return is_behind ? 2 * tread_at(along(inside)) : nearest.id;
}

StairsSurface::Range StairsSurface::treads(const Region& region) const {
  const Vector3d center = 0.5 * (region.low + region.high), half = 0.5 * (region.high - region.low);
  const double reach = std::abs(profile_.uphill.x) * half.x + std::abs(profile_.uphill.y) * half.y;
  const std::int64_t first = tread_at(along(center) - reach),
                     last = tread_at(along(center) + reach);
  return {std::max<std::int64_t>(first - 1, 0), std::min(last + 1, last_)};
}

bool StairsSurface::is_clear_of(const Region& region) const {
  const Range range = treads(region);
  return region.low.z > std::max(level(range.first), level(range.last));
}

void StairsSurface::faces(const Region& region, Visit<Face> visit) const {
  const Range range = treads(region);
  for (std::int64_t k = range.first; k <= range.last; ++k) {
    if (region.low.z <= level(k)) visit(tread(k));
    if (k < range.last && region.low.z <= std::max(level(k), level(k + 1)) &&
        region.high.z >= std::min(level(k), level(k + 1)))
      visit(riser_face(k));
  }
}

void StairsSurface::ridges(const Region& region, Visit<Ridge> visit) const {
  const Range range = treads(region);
  const bool rises = profile_.height > 0.;
  for (std::int64_t k = range.first; k < range.last; ++k) {
    const double head = level(rises ? k + 1 : k);
    if (region.low.z > head || region.high.z < head) continue;
    Ridge ridge;
    ridge.id = k;
    ridge.point = riser(k) * profile_.uphill + head * up;
    ridge.along = sideways_;
    ridge.normals = {up, (rises ? -1. : 1.) * profile_.uphill};
    ridge.outwards = {(rises ? -1. : 1.) * profile_.uphill, up};
    ridge.material = material_;
    visit(ridge);
  }
}

}  // namespace hookpoint::contact
