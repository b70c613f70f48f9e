// Shape: the bodies' forms, which are drawn, collide and have mass.
#include <fmt/format.h>

#include "language/wording.h"
#include "simulation/scene/body.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"
#include "simulation/scene/urdf/hull.h"
#include "simulation/scene/urdf/mesh.h"

namespace hookpoint::simulation {

using language::append;
using language::boolean_field;
using language::Fields;
using language::FieldSchema;
using language::integer_field;
using language::list_field;
using language::number_field;
using language::orientation_field;
using language::text_field;
using language::vector_field;

namespace {

const Fields<Box>& box_fields() {
  static const Fields<Box> fields{
      required(
          positive(vector_field("dimensions", "m", &Box::dimensions, "edge lengths along x,y,z"))),
  };
  return fields;
}

const Fields<Sphere>& sphere_fields() {
  static const Fields<Sphere> fields{
      required(positive(number_field("radius", "m", &Sphere::radius, "radius"))),
  };
  return fields;
}

const Fields<Cylinder>& cylinder_fields() {
  static const Fields<Cylinder> fields{
      required(positive(number_field("radius", "m", &Cylinder::radius, "radius"))),
      required(positive(number_field("length", "m", &Cylinder::length, "along z"))),
  };
  return fields;
}

const Fields<Legcone>& legcone_fields() {
  static const Fields<Legcone> fields{
      required(positive(number_field("length", "m", &Legcone::length, "along x"))),
      required(not_negative(number_field("proximal_radius", "m", &Legcone::proximal_radius,
                                         "of the face at the origin"))),
      required(not_negative(
          number_field("distal_radius", "m", &Legcone::distal_radius, "of the far face"))),
  };
  return fields;
}
const Fields<Capsule>& capsule_fields() {
  static const Fields<Capsule> fields{
      required(positive(number_field("radius", "m", &Capsule::radius, "radius"))),
      required(positive(number_field("length", "m", &Capsule::length,
                                     "of the cylindrical part, along z; the capsule is longer by "
                                     "two radii"))),
  };
  return fields;
}

const Fields<Cylinder>& disc_fields() {
  static const Fields<Cylinder> fields{
      required(positive(number_field("radius", "m", &Cylinder::radius, "radius"))),
  };
  return fields;
}

/// Of the vertices of a Hull.
constexpr int least_hull_points = 4;
constexpr int most_hull_vertices = 64;

namespace hull_field {
constexpr const char *points = "points", *file = "file", *scale = "scale";
}

std::vector<FieldSchema> hull_fields() {
  return {
      list_field(hull_field::points, "m", 3 * least_hull_points, 3 * most_hull_vertices, "",
                 "x,y,z of one point after the other; their convex hull is the solid"),
      text_field(hull_field::file,
                 "instead of points: a mesh (STL, OBJ or DAE), looked up beside the .hook file, "
                 "then along the search path; of a hull with more than 64 vertices those are kept "
                 "that spread farthest"),
      vector_field(hull_field::scale, "", "1,1,1", "the mesh's x,y,z times these"),
  };
}

/// What every shape has; `density` says what boundary_points counts.
Fields<ShapeSpec> placed_fields(const std::string& density = "") {
  return {
      vector_field("location", "m", &ShapeSpec::location, "of the shape's frame in its body"),
      orientation_field("orientation", &ShapeSpec::orientation,
                        "shape to body axes: quaternion w,x,y,z, or roll,pitch,yaw angles"),
      not_negative(number_field(mass_field::mass, "kg", "",
                                "of this shape; if not given, its share of the body's by volume")),
      boolean_field(contact_field, "true",
                    "false: nothing of it touches the ground, in any engine; it has its mass and "
                    "is drawn"),
      between(0., 500.,
              integer_field(boundary_points_field, &ShapeSpec::boundary_points,
                            "how densely its surface may touch the ground: " + density)),
  };
}

/// A shape: what it has of its own, then what every shape has.
language::ClassSchema shape_class(const char* name, const char* doc, std::vector<FieldSchema> own,
                                  const std::string& density) {
  language::ClassSchema shape;
  shape.name = name;
  shape.doc = doc;
  shape.fields = std::move(own);
  append(shape.fields, schemas(placed_fields(density)));
  shape.fields.push_back(foot_material_field(""));
  return shape;
}

/// The points that a Shape.Hull or an Obstacle.Hull gives; none after an error.
std::vector<Vector3d> hull_points(const language::Object& object, Loading& loading) {
  if (object.given(hull_field::points) == object.given(hull_field::file)) {
    loading.error(object.position, fmt::format("{} has either `points` or a `file`",
                                               language::with_article(object.type)));
    return {};
  }
  std::vector<Vector3d> points;
  if (object.given(hull_field::points)) {
    const std::vector<double>& numbers = object.numbers(hull_field::points);
    if (numbers.size() % 3 != 0)
      loading.error(place_of(object, hull_field::points),
                    fmt::format("points are three numbers each, and {} are no multiple of three",
                                numbers.size()));
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
      points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    return numbers.size() % 3 == 0 ? points : std::vector<Vector3d>{};
  }
  const language::Position& place = place_of(object, hull_field::file);
  const std::filesystem::path path = find_file(object.word(hull_field::file), place, loading);
  if (path.empty()) return {};
  const MeshPoints mesh = read_mesh(path);
  if (!mesh.problem.empty()) {
    loading.error(place,
                  fmt::format("the mesh {} cannot be read: {}", path.string(), mesh.problem));
    return {};
  }
  const Vector3d scale = vector_of(object, hull_field::scale);
  for (const Vector3d& p : mesh.vertices)
    points.push_back({scale.x * p.x, scale.y * p.y, scale.z * p.z});
  return spread_points(hull_vertices(points), most_hull_vertices);
}

Hull load_hull(const language::Object& object, Loading& loading) {
  const std::vector<Vector3d> points = hull_points(object, loading);
  if (points.empty()) return {};
  Hull hull = convex_hull(points);
  if (hull.faces.empty())
    loading.error(
        place_of(object, object.given(hull_field::points) ? hull_field::points : hull_field::file),
        "these points lie in a plane, or nearly: a convex hull needs four that do not");
  return hull;
}

}  // namespace

std::vector<FieldSchema> geometry_fields(std::string_view kind) {
  if (kind == "Sphere") return schemas(sphere_fields());
  if (kind == "Cylinder") return schemas(cylinder_fields());
  if (kind == "Capsule") return schemas(capsule_fields());
  if (kind == "Hull") return hull_fields();
  return schemas(box_fields());
}

ShapeGeometry load_geometry(const language::Object& object, Loading& loading) {
  const std::string_view kind = std::string_view(object.type).substr(object.type.find('.') + 1);
  if (kind == "Sphere") return load_fields(object, sphere_fields());
  if (kind == "Cylinder") return load_fields(object, cylinder_fields());
  if (kind == "Capsule") return load_fields(object, capsule_fields());
  if (kind == "Disc") return load_fields(object, disc_fields());
  if (kind == "Hull") return load_hull(object, loading);
  if (kind == "Legcone") {
    const Legcone cone = load_fields(object, legcone_fields());
    if (cone.proximal_radius == 0. && cone.distal_radius == 0.) {
      loading.error(object.position,
                    "both radii of this Shape.Legcone are 0; one of them must be positive");
    }
    return cone;
  }
  return load_fields(object, box_fields());
}

namespace {

/// The least density of a round shape that encloses a volume; 0 leaves the choice to the shape.
int least_density(const ShapeGeometry& geometry) {
  if (std::holds_alternative<Box>(geometry) || std::holds_alternative<Hull>(geometry)) return 1;
  const bool has_poles =
      std::holds_alternative<Sphere>(geometry) || std::holds_alternative<Capsule>(geometry);
  return has_poles ? 2 : 3;
}

}  // namespace

ShapeSpec load_shape(const language::Object& object, Loading& loading) {
  ShapeSpec shape = load_fields(object, placed_fields());
  shape.geometry = load_geometry(object, loading);
  if (shape.boundary_points != 0 && shape.boundary_points < least_density(shape.geometry)) {
    loading.error(place_of(object, boundary_points_field),
                  fmt::format("boundary_points of {} is 0 (its default) or at least {}",
                              language::with_article(object.type), least_density(shape.geometry)));
  }
  return shape;
}

void add_shape_classes(language::Schema& schema) {
  const std::string parts = "parts an edge is cut into; 0 means 1, the corners";
  const std::string rims = "points on each rim; 0 means 8";
  const std::vector<FieldSchema> box = schemas(box_fields());
  schema.add(shape_class("Shape.Cube", "a box, centred on its frame", box, parts));
  schema.add(shape_class("Shape.Box", "a box, centred on its frame", box, parts));
  schema.add(shape_class("Shape.Sphere", "a ball, centred on its frame", schemas(sphere_fields()),
                         "0 makes it a ball that rolls; n > 1 a polyhedron, its meridians cut into "
                         "n parts"));
  schema.add(shape_class("Shape.Cylinder", "a cylinder about z, centred on its frame",
                         schemas(cylinder_fields()), rims));
  schema.add(shape_class("Shape.Legcone",
                         "a solid truncated cone along +x, its proximal face at its frame's origin",
                         schemas(legcone_fields()), rims));
  schema.add(shape_class("Shape.Capsule",
                         "a cylinder about z with half a ball at each end, centred on its frame",
                         schemas(capsule_fields()),
                         "0 makes its ends balls that roll; n > 1 a polyhedron, the meridians of "
                         "its ends cut into n parts"));
  schema.add(shape_class("Shape.Disc", "a thin disc about z, centred on its frame: one rim",
                         schemas(disc_fields()), "points on its rim; 0 means 8"));
  schema.add(shape_class("Shape.Hull", "the convex hull of points, in its frame", hull_fields(),
                         "its vertices touch, whatever this says"));
}

}  // namespace hookpoint::simulation
