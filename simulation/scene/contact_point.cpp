// ContactPoint: a point of a body, or a ball about it, that may touch the ground.
#include <algorithm>
#include <tuple>

#include "language/tree/fields.h"
#include "simulation/scene/body.h"
#include "simulation/scene/load_parts.h"
#include "simulation/scene/schema.h"

namespace hookpoint::simulation {

using language::append;
using language::boolean_field;
using language::Direction;
using language::Fields;
using language::FieldSchema;
using language::number_field;
using language::port_only;
using language::vector_field;

namespace {

const Fields<BallSpec>& ball_fields() {
  static const Fields<BallSpec> fields{
      vector_field("location", "m", &BallSpec::location, "in the body's frame"),
      not_negative(number_field("radius", "m", &BallSpec::radius,
                                "of a ball about `location`, which rolls on the ground")),
  };
  return fields;
}

}  // namespace

void add_contact_point_class(language::Schema& schema) {
  language::ClassSchema point;
  point.name = "ContactPoint";
  point.doc =
      "a point of its own that may touch the ground; a body with ContactPoints and no shapes "
      "touches there only";
  const auto computed = [](FieldSchema field) {
    return port_only(Direction::output, std::move(field));
  };
  const std::string where = "; engine dts with a force law only";
  point.fields = schemas(ball_fields());
  point.fields.push_back(foot_material_field(""));
  append(
      point.fields,
      {
          computed(vector_field(
              "position", "m", "",
              "where it is, world axes; of a ball, where it meets the ground" + where)),
          computed(vector_field("contact.force", "N", "",
                                "of the ground on the robot at this point, world axes" + where)),
          computed(number_field("contact.depth", "m", "",
                                "how deep it is in the ground, below 0 outside" + where)),
          computed(boolean_field("contact.sliding", "", "whether it slips on the ground" + where)),
          computed(number_field("contact.normal_load", "N", "",
                                "part of the force along the ground's normal" + where)),
          computed(number_field("contact.tangential_load", "N", "",
                                "size of the part along the ground" + where)),
          computed(
              vector_field("contact.hook", "m", "",
                           "its anchor on the ground, world axes; the point itself while it is "
                           "free" +
                               where)),
      });
  schema.add(std::move(point));
}

BallSpec load_contact_point(const language::Object& object) {
  return load_fields(object, ball_fields());
}

void load_points(Loading& loading) {
  for (const auto& [object, at] : loading.bodies) {
    auto point = static_cast<int>(at.first_point);
    for (const language::Object* child : object->children_of("ContactPoint"))
      loading.experiment.points.push_back({loading.trails.at(child), at.robot, at.body, point++});
  }
  // Not in the order of addresses, which is another in each run.
  std::ranges::sort(loading.experiment.points, {}, [](const PointSpec& point) {
    return std::tuple(point.robot, point.body, point.point);
  });
}

}  // namespace hookpoint::simulation
