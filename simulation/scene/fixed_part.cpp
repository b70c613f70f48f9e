#include "simulation/scene/fixed_part.h"

#include <algorithm>
#include <array>

#include "dts/mass_properties.h"

namespace hookpoint::simulation {
namespace {

dts::MassProperties<double> properties(const MassSpec& mass) {
  return {mass.mass, mass.center_of_mass, mass.inertia};
}

/// One value a boundary point, as far as the body has any.
template <class Value>
void append_values(const std::vector<Value>& part, std::size_t points_before, const Value& none,
                   std::vector<Value>& values) {
  if (part.empty()) return;
  values.resize(points_before, none);
  values.insert(values.end(), part.begin(), part.end());
}

void append_shapes(const std::vector<ShapeSpec>& part, const Pose& X_BP, std::size_t points_before,
                   std::vector<ShapeSpec>& shapes) {
  for (ShapeSpec shape : part) {
    const Pose X_BS = X_BP * Pose{shape.location, shape.orientation};
    shape.location = X_BS.position;
    shape.orientation = X_BS.orientation;
    shape.first_point += points_before;
    shapes.push_back(std::move(shape));
  }
}

}  // namespace

bool is_fixed(const language::Object& object) {
  return object.type == "Link" && object.word("joint") == fixed_joint;
}

bool is_part(const language::Object& object) {
  if (object.type != "Chain") return is_fixed(object);
  const std::vector<const language::Object*> links = object.children_of("Link");
  return !links.empty() &&
         std::ranges::all_of(links, [](const auto* link) { return is_fixed(*link); });
}

void add_part(const BodySpec& part, const Pose& X_BP, BodySpec& body) {
  const dts::MassProperties<double> both = dts::combined(std::array{
      properties(body.mass), dts::placed(properties(part.mass), X_BP.position, X_BP.orientation)});
  body.mass = {both.mass, both.center_of_mass, both.inertia};
  const std::size_t before = body.boundary_points.size();
  append_shapes(part.shapes, X_BP, before, body.shapes);
  append_shapes(part.shapes_without_contact, X_BP, before, body.shapes_without_contact);
  append_values(part.boundary_radii, before, 0., body.boundary_radii);
  append_values(part.boundary_materials, before, no_material, body.boundary_materials);
  for (const Vector3d& p_PQ : part.boundary_points)
    body.boundary_points.push_back(X_BP.position + rotate(X_BP.orientation, p_PQ));
}

}  // namespace hookpoint::simulation
