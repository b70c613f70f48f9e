// Shapes of one body that share surface: stiffness is per boundary point, so that what they share
// carries more than once.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/scene/load_parts.h"

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

}  // namespace

void warn_of_overlap(const std::vector<ShapePoints>& shapes, const std::string& body,
                     Loading& loading) {
  const auto shares = [](const ShapePoints& of, const ShapePoints& with) {
    double size = 0.;
    for (const Vector3d& p_BP : of.points) size = std::max(size, norm(p_BP - of.points.front()));
    return std::ranges::any_of(of.points, [&](const Vector3d& p_BP) {
      const Vector3d p_SP = rotate(conjugate(with.shape->orientation), p_BP - with.shape->location);
      return std::visit([&](const auto& form) { return holds(form, p_SP, touching * size); },
                        with.shape->geometry);
    });
  };
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!shares(shapes[i], shapes[j]) && !shares(shapes[j], shapes[i])) continue;
      loading.diagnostics.warning(
          shapes[i].object->position,
          fmt::format("this {} and another shape of {} overlap or touch: each boundary point has "
                      "the ground's whole stiffness, so that where they meet two points carry for "
                      "one, and two half boxes are not one box; make them one shape, move them "
                      "apart, or give the body ContactPoints and its mass instead of shapes",
                      shapes[i].object->type, body));
      loading.diagnostics.note(shapes[j].object->position, "the other is here");
      return;
    }
  }
}

}  // namespace hookpoint::simulation
