// What a base and a link share: shapes, the points that may touch the ground, what is published.
#include "simulation/scene/body.h"

#include "contact/force_law.h"
#include "contact/terrain/boundary_points.h"
#include "language/values/budget.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {
namespace {

std::vector<Vector3d> sample(const Box& box, int density) {
  return contact::box_points(box.dimensions, density);
}
std::vector<Vector3d> sample(const Sphere& sphere, int density) {
  return contact::sphere_points(sphere.radius, density);
}
std::vector<Vector3d> sample(const Cylinder& cylinder, int density) {
  return contact::cylinder_points(cylinder.radius, cylinder.length, density);
}
std::vector<Vector3d> sample(const Legcone& cone, int density) {
  return contact::legcone_points(cone.length, cone.proximal_radius, cone.distal_radius, density);
}

/// A sphere whose surface is not to be sampled: it rolls.
const Sphere* rolling_sphere(const ShapeSpec& shape) {
  return shape.boundary_points == 0 ? std::get_if<Sphere>(&shape.geometry) : nullptr;
}

void add_point(const Vector3d& p_BP, double radius, BodySpec& body) {
  body.boundary_points.push_back(p_BP);
  if (radius == 0.) return;
  body.boundary_radii.resize(body.boundary_points.size(), 0.);
  body.boundary_radii.back() = radius;
}

/// False, after one error, where all bodies together have more points than may be asked for.
bool may_have_points(const language::Object& shape, std::size_t count, Loading& loading) {
  constexpr std::size_t most = 2'000'000;
  const bool already = loading.boundary_points > most;
  loading.boundary_points += count;
  if (loading.boundary_points <= most) return true;
  if (already) return false;
  loading.error(place_of(shape, boundary_points_field),
                "with this shape the bodies ask for " +
                    language::too_many(static_cast<double>(loading.boundary_points), most,
                                       "boundary points") +
                    ": make `boundary_points` smaller");
  return false;
}

void add_shape_points(const language::Object& object, const ShapeSpec& shape, BodySpec& body,
                      Loading& loading) {
  if (!may_have_points(object, 0, loading)) return;
  if (const Sphere* sphere = rolling_sphere(shape))
    return add_point(shape.location, sphere->radius, body);
  const auto sampled =
      std::visit([&](const auto& geometry) { return sample(geometry, shape.boundary_points); },
                 shape.geometry);
  if (!may_have_points(object, sampled.size(), loading)) return;
  for (const Vector3d& p_SP : sampled)
    add_point(shape.location + rotate(shape.orientation, p_SP), 0., body);
}

}  // namespace

std::vector<FieldSchema> contact_ports() {
  return {
      port_only(Direction::output,
                vector_field("contact.force", "N", "",
                             "impulse of the ground on the body over the last step by the step's "
                             "length, world axes; at first 0")),
      port_only(Direction::output,
                number_field("contact.count", "", "",
                             "boundary points that carried force in the last step"))};
}

std::vector<FieldSchema> acceleration_ports(const std::string& body) {
  return {port_only(Direction::output,
                    vector_field("linear_acceleration", "m/s^2", "",
                                 "change of `velocity` of " + body +
                                     " over the last step by its length, world axes; at first 0")),
          port_only(Direction::output, vector_field("angular_acceleration", "rad/s^2", "",
                                                    "the same of `angular_velocity`"))};
}

std::vector<FieldSchema> motion_ports(const std::string& position, const std::string& body) {
  return {
      port_only(Direction::output,
                vector_field(position, "m", "", "of " + body + " frame's origin, world axes")),
      port_only(Direction::output,
                orientation_field("orientation", body + " to world axes, w,x,y,z")),
      port_only(Direction::output,
                vector_field("velocity", "m/s", "", "of " + body + " frame's origin, world axes")),
      port_only(Direction::output,
                vector_field("angular_velocity", "rad/s", "", "of " + body + ", world axes")),
  };
}

BodySpec load_body(const language::Object& object, std::string name, bool must_have_inertia,
                   Loading& loading) {
  BodySpec body;
  body.name = std::move(name);
  const std::size_t errors_before = loading.diagnostics.error_count();
  const std::vector<const language::Object*> shape_objects = object.children_of("Shape.");
  std::vector<ShapeSpec> all;
  for (const language::Object* shape : shape_objects) all.push_back(load_shape(*shape, loading));
  if (loading.diagnostics.error_count() != errors_before) return body;
  body.mass = load_mass(object, all, shape_objects, must_have_inertia, loading);
  for (const language::Object* point : object.children_of("ContactPoint")) {
    const BallSpec ball = load_contact_point(*point);
    add_point(ball.location, ball.radius, body);
  }
  std::vector<ShapePoints> shapes;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!shape_objects[i]->boolean(contact_field)) {
      body.shapes_without_contact.push_back(all[i]);
      continue;
    }
    body.shapes.push_back(all[i]);
    const std::size_t before = body.boundary_points.size();
    add_shape_points(*shape_objects[i], all[i], body, loading);
    shapes.push_back({shape_objects[i],
                      &all[i],
                      {body.boundary_points.begin() + static_cast<std::ptrdiff_t>(before),
                       body.boundary_points.end()}});
  }
  const Experiment& experiment = loading.experiment;
  if (experiment.terrain && experiment.engine == "dts" &&
      contact::find_force_law(experiment.contact)) {
    if (const auto overlap = find_overlap(shapes)) loading.overlaps.push_back(*overlap);
  }
  return body;
}

}  // namespace hookpoint::simulation
