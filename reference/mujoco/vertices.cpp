#include "reference/mujoco/vertices.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

namespace hookpoint::reference {

std::vector<Vector3d> mujoco_vertices(const simulation::ShapeGeometry& geometry) {
  if (const auto* hull = std::get_if<simulation::Hull>(&geometry)) return hull->vertices;
  const auto* cone = std::get_if<simulation::Legcone>(&geometry);
  if (cone == nullptr) return {};
  constexpr int sides = 32;
  std::vector<Vector3d> corners;
  for (const auto& [x, radius] :
       {std::pair{0., cone->proximal_radius}, std::pair{cone->length, cone->distal_radius}})
    for (int i = 0; i < sides; ++i) {
      const double angle = 2. * std::numbers::pi * i / sides;
      corners.push_back({x, radius * std::cos(angle), radius * std::sin(angle)});
    }
  return corners;
}

}  // namespace hookpoint::reference
