// What a base and a link share: shapes, the points that may touch the ground, what is published.
#include "simulation/scene/body.h"

#include <fmt/format.h>

#include "contact/force_law.h"
#include "contact/terrain/boundary_points.h"
#include "language/values/budget.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {

using language::append;
using language::Direction;
using language::FieldSchema;
using language::number_field;
using language::orientation_field;
using language::port_only;
using language::vector_field;

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
std::vector<Vector3d> sample(const Capsule& capsule, int density) {
  return contact::capsule_points(capsule.radius, capsule.length, density);
}
std::vector<Vector3d> sample(const Hull& hull, int) { return hull.vertices; }

/// A sphere whose surface is not to be sampled: it rolls.
const Sphere* rolling_sphere(const ShapeSpec& shape) {
  return shape.boundary_points == 0 ? std::get_if<Sphere>(&shape.geometry) : nullptr;
}

/// The same of a capsule: a ball at each end.
const Capsule* rolling_capsule(const ShapeSpec& shape) {
  return shape.boundary_points == 0 ? std::get_if<Capsule>(&shape.geometry) : nullptr;
}

void add_point(const Vector3d& p_BP, double radius, int material, BodySpec& body) {
  body.boundary_points.push_back(p_BP);
  if (material != no_material) {
    body.boundary_materials.resize(body.boundary_points.size(), no_material);
    body.boundary_materials.back() = material;
  }
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
                "with this shape the bodies require " +
                    language::too_many(static_cast<double>(loading.boundary_points), most,
                                       "boundary points") +
                    ": make `boundary_points` smaller");
  return false;
}

void add_shape_points(const language::Object& object, const ShapeSpec& shape, BodySpec& body,
                      Loading& loading) {
  if (!may_have_points(object, 0, loading)) return;
  if (const Sphere* sphere = rolling_sphere(shape))
    return add_point(shape.location, sphere->radius, shape.material, body);
  if (const Capsule* capsule = rolling_capsule(shape)) {
    for (const double z : {-0.5 * capsule->length, 0.5 * capsule->length}) {
      const Vector3d end = shape.location + rotate(shape.orientation, Vector3d{0., 0., z});
      add_point(end, capsule->radius, shape.material, body);
    }
    return;
  }
  const auto sampled =
      std::visit([&](const auto& geometry) { return sample(geometry, shape.boundary_points); },
                 shape.geometry);
  if (!may_have_points(object, sampled.size(), loading)) return;
  for (const Vector3d& p_SP : sampled)
    add_point(shape.location + rotate(shape.orientation, p_SP), 0., shape.material, body);
}

const std::string of_force_laws = "; engine dts with a force law only";

/// What the contacts come to that `from` has with `on`.
std::vector<FieldSchema> contact_sum_ports(const std::string& from, const std::string& on) {
  const std::string origin = on == "it" ? "its origin" : on + "'s origin";
  return {
      port_only(Direction::output,
                vector_field("contact.moment", "N.m", "",
                             fmt::format("of {} on {} about its origin, world axes{}", from, on,
                                         of_force_laws))),
      port_only(Direction::output,
                vector_field("contact.center_of_pressure", "m", "",
                             fmt::format("mean of the places that touch, by normal load, world "
                                         "axes; without load {}{}",
                                         origin, of_force_laws))),
      port_only(Direction::output,
                number_field("contact.normal_load", "N", "",
                             "sum over the contacts, each along its normal" + of_force_laws)),
      port_only(Direction::output, number_field("contact.tangential_load", "N", "",
                                                "size of the rest of the force" + of_force_laws))};
}

}  // namespace

std::vector<FieldSchema> contact_ports() {
  std::vector<FieldSchema> ports{
      port_only(Direction::output,
                vector_field("contact.force", "N", "",
                             "impulse of the ground on the body over the last step by the step's "
                             "length, world axes; at first 0")),
      port_only(Direction::output,
                number_field("contact.count", "", "",
                             "boundary points that carried force in the last step"))};
  append(ports, contact_sum_ports("the ground", "the body"));
  return ports;
}

std::vector<FieldSchema> surface_contact_ports() {
  std::vector<FieldSchema> ports{
      port_only(Direction::output,
                vector_field("contact.force", "N", "",
                             "impulse of bodies on it over the last step by the step's length, "
                             "world axes; at first 0" +
                                 of_force_laws)),
      port_only(Direction::output,
                number_field("contact.count", "", "", "places that carry force" + of_force_laws))};
  append(ports, contact_sum_ports("bodies", "it"));
  return ports;
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

BodySpec load_single_shape(const language::Object& object, ShapeGeometry geometry,
                           Loading& loading) {
  BodySpec body;
  body.name = "base";
  body.shapes.push_back({std::move(geometry), {}, {}});
  body.shapes[0].material = foot_material(object, no_material, loading);
  body.mass = load_mass(object, body.shapes, {&object}, true, loading);
  add_shape_points(object, body.shapes[0], body, loading);
  body.shapes[0].point_count = body.boundary_points.size();
  return body;
}

BodySpec load_body(const language::Object& object, std::string name, bool must_have_inertia,
                   Loading& loading) {
  BodySpec body;
  body.name = std::move(name);
  const std::size_t errors_before = loading.diagnostics.error_count();
  const std::vector<const language::Object*> shape_objects = object.children_of("Shape.");
  std::vector<ShapeSpec> all;
  const int own_material = foot_material(object, no_material, loading);
  for (const language::Object* shape : shape_objects) {
    all.push_back(load_shape(*shape, loading));
    all.back().material = foot_material(*shape, own_material, loading);
  }
  if (loading.diagnostics.error_count() != errors_before) return body;
  body.mass = load_mass(object, all, shape_objects, must_have_inertia, loading);
  for (const language::Object* point : object.children_of("ContactPoint")) {
    const BallSpec ball = load_contact_point(*point);
    add_point(ball.location, ball.radius, foot_material(*point, own_material, loading), body);
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
    body.shapes.back().first_point = before;
    body.shapes.back().point_count = body.boundary_points.size() - before;
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
