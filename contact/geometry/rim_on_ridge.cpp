#include "contact/geometry/rim_on_ridge.h"

#include <algorithm>
#include <cmath>

#include "contact/geometry/folds.h"

namespace hookpoint::contact {
namespace {

/// A ridge and the rim that may cross it. With x(phi) on the rim, tau its tangent there and w the part
/// of x - p across the ridge's line, the places are nearest where w . tau = 0.
class Search {
 public:
  Search(const Ridge& ridge, const Rim& rim) : ridge_(ridge), rim_(rim) {}

  /// By Newton's method from a direction in the rim's plane; false where it does not settle.
  bool settle(Vector3d radial, Vector3d& found) const {
    constexpr int most_rounds = 12;
    constexpr double done = 1e-13, longest = 0.5;  // [rad]
    for (int round = 0; round < most_rounds; ++round) {
      const Vector3d tangent = cross(rim_.axis, radial);
      const Vector3d w = across(radial);
      const double along = dot(tangent, ridge_.along);
      const double slope = rim_.radius * (1. - along * along) - dot(w, radial);
      if (slope == 0.) return false;
      const double turn = std::clamp(-dot(w, tangent) / slope, -longest, longest);
      radial = unit(std::cos(turn) * radial + std::sin(turn) * tangent);
      if (std::abs(turn) < done) {
        found = radial;
        return true;
      }
    }
    return false;
  }
  /// w at a place of the rim [m].
  Vector3d across(const Vector3d& radial) const {
    return tangential(rim_.center + rim_.radius * radial - ridge_.point, ridge_.along);
  }

 private:
  const Ridge& ridge_;
  const Rim& rim_;
};

}  // namespace

RimCrossings rim_on_ridge(const Ridge& ridge, const Rim& rim, double reach) {
  RimCrossings result;
  const Search search(ridge, rim);
  std::array<Vector3d, RimCrossings::most> starts;
  std::size_t start_count = 0;
  // Towards where the ridge pierces the rim's plane, and where it passes over the rim.
  const Vector3d to_line = ridge.point - rim.center;
  const double slope = dot(ridge.along, rim.axis);
  constexpr double parallel = 1e-6;
  if (std::abs(slope) > parallel) {
    const Vector3d pierced = to_line - (dot(to_line, rim.axis) / slope) * ridge.along;
    const double distance = norm(pierced);
    if (distance > parallel * rim.radius && distance < 2. * rim.radius + reach)
      starts[start_count++] = (1. / distance) * pierced;
  }
  const Vector3d flat = tangential(ridge.along, rim.axis);
  if (norm(flat) > parallel) {
    const Vector3d direction = unit(flat);
    const Vector3d beside = tangential(tangential(to_line, rim.axis), direction);
    const double half_2 = rim.radius * rim.radius - dot(beside, beside);
    if (half_2 > 0.) {
      starts[start_count++] = unit(beside + std::sqrt(half_2) * direction);
      starts[start_count++] = unit(beside - std::sqrt(half_2) * direction);
    }
  }
  for (std::size_t i = 0; i < start_count; ++i) {
    Vector3d radial;
    if (!search.settle(starts[i], radial)) continue;
    constexpr double same = 1e-6;
    const auto is_known = [&](const RimCrossing& other) {
      return norm(other.radial - radial) < same;
    };
    if (std::ranges::any_of(result.all(), is_known)) continue;
    const Vector3d place = rim.center + rim.radius * radial;
    const double t = dot(place - ridge.point, ridge.along);
    if (t < ridge.from || t > ridge.to) continue;
    const Vector3d both = cross(cross(rim.axis, radial), ridge.along);
    if (norm(both) < parallel) continue;
    Vector3d normal = unit(both);
    if (dot(normal, ridge.normals[0] + ridge.normals[1]) < 0.) normal = -normal;
    const double depth = -dot(search.across(radial), normal);
    if (depth > -reach) result.crossings[result.count++] = {place, normal, radial, depth};
  }
  return result;
}

}  // namespace hookpoint::contact
