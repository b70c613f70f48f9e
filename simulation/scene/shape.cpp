#include "simulation/scene/schema.h"
#include "simulation/scene/fields.h"

namespace hookpoint::simulation {
namespace {

/// A shape: what it has of its own, then what every shape has. `density` says what boundary_points
/// counts.
language::ClassSchema shape_class(const char* name, const char* doc, std::vector<FieldSchema> own,
                                  const std::string& density) {
  language::ClassSchema shape;
  shape.name = name;
  shape.doc = doc;
  shape.fields = std::move(own);
  append(shape.fields,
         {vector_field("location", "m", "0,0,0", "of the shape's frame in its body"),
          orientation_field("orientation",
                            "shape to body axes: quaternion w,x,y,z, or roll,pitch,yaw angles"),
          not_negative(number_field(
              "mass", "kg", "", "of this shape; if not given, its share of the body's by volume")),
          between(0., 500.,
                  integer_field("boundary_points", "0",
                                "how densely its surface may touch the ground: " + density))});
  return shape;
}

FieldSchema edges() {
  return required(positive(vector_field("dimensions", "m", "", "edge lengths along x,y,z")));
}

FieldSchema radius() { return required(positive(number_field("radius", "m", "", "radius"))); }

}  // namespace

void add_shape_classes(language::Schema& schema) {
  const std::string box = "parts an edge is cut into; 0 means 1, the corners";
  schema.add(shape_class("Shape.Cube", "a box, centred on its frame", {edges()}, box));
  schema.add(shape_class("Shape.Box", "a box, centred on its frame", {edges()}, box));
  schema.add(shape_class("Shape.Sphere", "a ball, centred on its frame", {radius()},
                         "0 makes it a ball that rolls; n > 1 a polyhedron, its meridians cut into "
                         "n parts"));
  schema.add(shape_class("Shape.Cylinder", "a cylinder about z, centred on its frame",
                         {radius(), required(positive(number_field("length", "m", "", "along z")))},
                         "points on each rim; 0 means 8"));
  schema.add(shape_class(
      "Shape.Legcone", "a solid truncated cone along +x, its proximal face at its frame's origin",
      {required(positive(number_field("length", "m", "", "along x"))),
       required(
           not_negative(number_field("proximal_radius", "m", "", "of the face at the origin"))),
       required(not_negative(number_field("distal_radius", "m", "", "of the far face")))},
      "points on each rim; 0 means 8"));

  language::ClassSchema point;
  point.name = "ContactPoint";
  point.doc =
      "a point of its own that may touch the ground; a body with ContactPoints and no shapes "
      "touches there only";
  const auto computed = [](FieldSchema field) {
    return port_only(Direction::output, std::move(field));
  };
  const std::string where = "; engine dts with a force law only";
  point.fields = {
      vector_field("location", "m", "0,0,0", "in the body's frame"),
      not_negative(number_field("radius", "m", "0",
                                "of a ball about `location`, which rolls on the ground")),
      computed(
          vector_field("position", "m", "",
                       "where it is, world axes; of a ball, where it meets the ground" + where)),
      computed(vector_field("contact.force", "N", "",
                            "of the ground on the robot at this point, world axes" + where)),
      computed(number_field("contact.depth", "m", "",
                            "how deep it is in the ground, below 0 outside" + where)),
      computed(boolean_field("contact.sliding", "", "whether it slips on the ground" + where)),
      computed(vector_field("contact.hook", "m", "",
                            "its anchor on the ground, world axes; the point itself while it is "
                            "free" +
                                where)),
  };
  schema.add(point);
}

}  // namespace hookpoint::simulation
