// Shapes of one body that share surface: stiffness is per boundary point, so that what they share
// carries more than once.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/geometry/surface.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/urdf/hull.h"

namespace hookpoint::simulation {
namespace {

/// Of a shape's size: so near, a point is on its surface.
constexpr double touching = 1e-6;

bool holds(const Box& box, const Vector3d& p, double near) {
  return std::abs(p.x) <= 0.5 * box.dimensions.x + near &&
         std::abs(p.y) <= 0.5 * box.dimensions.y + near &&
         std::abs(p.z) <= 0.5 * box.dimensions.z + near;
}
bool holds(const Sphere& sphere, const Vector3d& p, double near) {
  return norm(p) <= sphere.radius + near;
}
bool holds(const Cylinder& cylinder, const Vector3d& p, double near) {
  return std::abs(p.z) <= 0.5 * cylinder.length + near &&
         std::hypot(p.x, p.y) <= cylinder.radius + near;
}
bool holds(const Legcone& cone, const Vector3d& p, double near) {
  const double part = std::clamp(p.x / cone.length, 0., 1.);
  const double radius = cone.proximal_radius + part * (cone.distal_radius - cone.proximal_radius);
  return p.x >= -near && p.x <= cone.length + near && std::hypot(p.y, p.z) <= radius + near;
}
bool holds(const Capsule& capsule, const Vector3d& p, double near) {
  const double beyond = std::max(std::abs(p.z) - 0.5 * capsule.length, 0.);
  return norm(Vector3d{p.x, p.y, beyond}) <= capsule.radius + near;
}
bool holds(const Hull& hull, const Vector3d& p, double near) {
  return std::ranges::all_of(hull.faces, [&](const std::vector<std::size_t>& face) {
    return dot(p - hull.vertices[face[0]], face_normal(hull, face)) <= near;
  });
}

double size_of(const Box& box) { return norm(box.dimensions); }
double size_of(const Sphere& sphere) { return sphere.radius; }
double size_of(const Cylinder& cylinder) { return std::hypot(cylinder.radius, cylinder.length); }
double size_of(const Legcone& cone) {
  return std::hypot(cone.length, std::max(cone.proximal_radius, cone.distal_radius));
}
double size_of(const Capsule& capsule) { return capsule.radius + 0.5 * capsule.length; }
double size_of(const Hull& hull) {
  const auto [low, high] = contact::region_about(hull.vertices);
  return norm(high - low);
}

double size_of(const ShapePoints& shape) {
  return std::visit([](const auto& form) { return size_of(form); }, shape.shape->geometry);
}

/// Whether `p_BP` is in the shape or no farther than `near` [m] outside; below 0, inside by that.
bool holds(const ShapePoints& shape, const Vector3d& p_BP, double near) {
  const Vector3d p_SP = rotate(conjugate(shape.shape->orientation), p_BP - shape.shape->location);
  return std::visit([&](const auto& form) { return holds(form, p_SP, near); },
                    shape.shape->geometry);
}

/// Of two shapes: so near, a point of one is on the surface of the other [m].
double near_of(const ShapePoints& one, const ShapePoints& other) {
  return touching * (size_of(one) + size_of(other));
}

bool shares_surface(const ShapePoints& one, const ShapePoints& other) {
  const double near = near_of(one, other);
  const auto touches = [near](const ShapePoints& of, const ShapePoints& with) {
    return std::ranges::any_of(of.points,
                               [&](const Vector3d& p_BP) { return holds(with, p_BP, near); });
  };
  return touches(one, other) || touches(other, one);
}

/// Whether the points of `inner` bear nothing before `outer` does, or instead of it: all are below
/// its surface. The one of a ball is its middle, which may be on it: a foot at the end of a leg.
bool contains(const ShapePoints& outer, const ShapePoints& inner) {
  const bool is_ball =
      inner.points.size() == 1 && std::holds_alternative<Sphere>(inner.shape->geometry);
  const double near = (is_ball ? 1. : -1.) * near_of(outer, inner);
  return std::ranges::all_of(inner.points,
                             [&](const Vector3d& p_BP) { return holds(outer, p_BP, near); });
}

/// "Shape.Box `top`", or "Shape.Box in line 7" where it has no name.
std::string described(const language::Object& shape) {
  if (shape.named) return fmt::format("{} `{}`", shape.type, shape.name);
  return fmt::format("{} in line {}", shape.type, language::line_and_column(shape.position).line);
}

}  // namespace

std::optional<ShapeOverlap> find_overlap(const std::vector<ShapePoints>& shapes) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (shares_surface(shapes[i], shapes[j]) && !contains(shapes[i], shapes[j]) &&
          !contains(shapes[j], shapes[i]))
        return ShapeOverlap{shapes[j].object, shapes[i].object};
    }
  }
  return std::nullopt;
}

void warn_of_overlaps(Loading& loading) {
  if (loading.overlaps.empty()) return;
  const auto& [first, second] = loading.overlaps.front();
  const std::size_t more = loading.overlaps.size() - 1;
  loading.diagnostics.warning(
      second->position,
      fmt::format(
          "{} and {} of {} overlap or touch{}: each boundary point has the ground's whole "
          "stiffness, so that where they meet two points carry for one, and two half boxes "
          "are not one box; give the one that is not to touch the ground `contact = false`, "
          "make them one shape, or move them apart",
          described(*first), described(*second), second->parent->trail(),
          more == 0   ? ""
          : more == 1 ? ", and shapes of another body"
                      : fmt::format(", and shapes of {} more bodies", more)));
  loading.diagnostics.note(first->position, "the other is here");
}

}  // namespace hookpoint::simulation
