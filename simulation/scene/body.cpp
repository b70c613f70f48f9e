#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "contact/force_law.h"
#include "contact/terrain/boundary_points.h"
#include "language/values/budget.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {
namespace {

ShapeGeometry load_geometry(const language::Object& object, Loading& loading) {
  if (object.type == "Shape.Sphere") return Sphere{object.number("radius")};
  if (object.type == "Shape.Cylinder")
    return Cylinder{object.number("radius"), object.number("length")};
  if (object.type == "Shape.Legcone") {
    const Legcone cone{object.number("length"), object.number("proximal_radius"),
                       object.number("distal_radius")};
    if (cone.proximal_radius == 0. && cone.distal_radius == 0.) {
      loading.error(object.position,
                    "both radii of this Shape.Legcone are 0; one of them must be positive");
    }
    return cone;
  }
  return Box{vector_of(object, "dimensions")};
}

/// The least density of a round shape that encloses a volume; 0 leaves the choice to the shape.
int least_density(const ShapeGeometry& geometry) {
  if (std::holds_alternative<Box>(geometry)) return 1;
  return std::holds_alternative<Sphere>(geometry) ? 2 : 3;
}

ShapeSpec load_shape(const language::Object& object, Loading& loading) {
  ShapeSpec shape{load_geometry(object, loading), vector_of(object, "location"),
                  orientation_of(object, "orientation"),
                  static_cast<int>(object.number("boundary_points"))};
  if (shape.boundary_points != 0 && shape.boundary_points < least_density(shape.geometry)) {
    loading.error(place_of(object, "boundary_points"),
                  fmt::format("boundary_points of a {} is 0 (its default) or at least {}",
                              object.type, least_density(shape.geometry)));
  }
  return shape;
}

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
  loading.error(place_of(shape, "boundary_points"),
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

BodySpec load_body(const language::Object& object, std::string name, bool must_have_inertia,
                   Loading& loading) {
  BodySpec body;
  body.name = std::move(name);
  const std::size_t errors_before = loading.diagnostics.error_count();
  const std::vector<const language::Object*> shape_objects = object.children_of("Shape.");
  for (const language::Object* shape : shape_objects)
    body.shapes.push_back(load_shape(*shape, loading));
  if (loading.diagnostics.error_count() != errors_before) return body;
  body.mass = load_mass(object, body.shapes, shape_objects, must_have_inertia, loading);
  for (const language::Object* point : object.children_of("ContactPoint")) {
    add_point(vector_of(*point, "location"), point->number("radius"), body);
  }
  std::vector<ShapePoints> shapes;
  for (std::size_t i = 0; i < body.shapes.size(); ++i) {
    const std::size_t before = body.boundary_points.size();
    add_shape_points(*shape_objects[i], body.shapes[i], body, loading);
    shapes.push_back({shape_objects[i],
                      &body.shapes[i],
                      {body.boundary_points.begin() + static_cast<std::ptrdiff_t>(before),
                       body.boundary_points.end()}});
  }
  const Experiment& experiment = loading.experiment;
  if (experiment.terrain && experiment.engine == "dts" &&
      contact::find_force_law(experiment.contact))
    warn_of_overlap(shapes, object.trail(), loading);
  return body;
}

std::string missing_port(const Experiment& experiment, const language::Object& object,
                         const language::FieldSchema& field) {
  const bool detail = !field.setting && (object.type == "ContactPoint" || object.type == "Chain");
  const bool peer = experiment.engine != "dts";
  // A peer publishes ContactPoints, but no hips.
  const bool published = peer ? object.type == "ContactPoint"
                              : contact::find_force_law(experiment.contact).has_value();
  if (!detail || published) return "";
  return fmt::format(
      "{} {} does not publish `{}` of a {}: choose engine dts and a force law, such "
      "as hookpoint",
      peer ? "engine" : "contact law", peer ? experiment.engine : experiment.contact, field.name,
      object.type);
}

void load_points(Loading& loading) {
  for (const auto& [object, at] : loading.bodies) {
    int point = 0;
    for (const language::Object* child : object->children_of("ContactPoint"))
      loading.experiment.points.push_back({loading.trails.at(child), at.robot, at.body, point++});
  }
  // Not in the order of addresses, which is another in each run.
  std::ranges::sort(loading.experiment.points, {}, [](const PointSpec& point) {
    return std::tuple(point.robot, point.body, point.point);
  });
}

}  // namespace hookpoint::simulation
