// Shape: the bodies' forms, which are drawn, collide and have mass.
#include <fmt/format.h>

#include "language/wording.h"
#include "simulation/scene/body.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {
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

/// What every shape has; `density` says what boundary_points counts.
Fields<ShapeSpec> placed_fields(const std::string& density = "") {
  return {
      vector_field("location", "m", &ShapeSpec::location, "of the shape's frame in its body"),
      orientation_field("orientation", &ShapeSpec::orientation,
                        "shape to body axes: quaternion w,x,y,z, or roll,pitch,yaw angles"),
      not_negative(number_field(mass_field::mass, "kg", "",
                                "of this shape; if not given, its share of the body's by volume")),
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
  return shape;
}

ShapeGeometry load_geometry(const language::Object& object, Loading& loading) {
  if (object.type == "Shape.Sphere") return load_fields(object, sphere_fields());
  if (object.type == "Shape.Cylinder") return load_fields(object, cylinder_fields());
  if (object.type == "Shape.Legcone") {
    const Legcone cone = load_fields(object, legcone_fields());
    if (cone.proximal_radius == 0. && cone.distal_radius == 0.) {
      loading.error(object.position,
                    "both radii of this Shape.Legcone are 0; one of them must be positive");
    }
    return cone;
  }
  return load_fields(object, box_fields());
}

/// The least density of a round shape that encloses a volume; 0 leaves the choice to the shape.
int least_density(const ShapeGeometry& geometry) {
  if (std::holds_alternative<Box>(geometry)) return 1;
  return std::holds_alternative<Sphere>(geometry) ? 2 : 3;
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
}

}  // namespace hookpoint::simulation
