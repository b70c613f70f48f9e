// Terrain.Steps: stairs.
#include "language/tree/fields.h"
#include "simulation/scene/terrain/classes.h"

namespace hookpoint::simulation {

using language::append;
using language::Fields;
using language::FieldSchema;
using language::integer_field;
using language::number_field;

namespace {

const Fields<StepsGround>& steps_fields() {
  static const Fields<StepsGround> fields{
      required(
          number_field("height", "m", &StepsGround::height, "of one step; below 0 they go down")),
      required(positive(number_field("run", "m", &StepsGround::run, "from one riser to the next"))),
      without_default(at_least(1., integer_field("count", &StepsGround::count,
                                                 "of steps; if not given, to the ground's edge"))),
      number_field("from", "m", &StepsGround::from,
                   "of the first riser's foot from the world's origin, along the stairs"),
      number_field("azimuth", "rad", &StepsGround::azimuth,
                   "direction of the stairs, from +x about z; risers are exact at quarter turns"),
  };
  return fields;
}

constexpr const char* spacing_field = "spacing";

}  // namespace

void add_steps_class(language::Schema& schema) {
  std::vector<FieldSchema> fields = schemas(steps_fields());
  append(fields, {positive(number_field(spacing_field, "m", "0.02", "edge of a cell of two tiles")),
                  grid_size_field()});
  schema.add(terrain_class(
      "Terrain.Steps",
      "stairs along +x turned by azimuth about z; under touch = points a riser is a ramp one cell "
      "wide, at the foot of its tread",
      std::move(fields)));
}

GridSpec load_steps(const language::Object& object, TerrainSpec& terrain, Loading& loading) {
  const StepsGround steps = load_fields(object, steps_fields());
  Extent extent;
  extent.spacing = object.number(spacing_field);
  load_size(object, extent);
  terrain.spacing = extent.spacing;
  const std::string problem = steps_problem(steps, extent);
  if (problem.empty()) return steps_surface(steps, extent);
  loading.error(object.position, problem);
  return {};
}

}  // namespace hookpoint::simulation
