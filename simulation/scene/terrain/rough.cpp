// Terrain.Rough: smooth random ground.
#include "language/tree/fields.h"
#include "simulation/scene/terrain/classes.h"

namespace hookpoint::simulation {

using language::append;
using language::Fields;
using language::FieldSchema;
using language::integer_field;
using language::number_field;

namespace {

const Fields<RoughGround>& rough_fields() {
  static const Fields<RoughGround> fields{
      required(not_negative(number_field("amplitude", "m", &RoughGround::amplitude,
                                         "largest height or depth of a vertex; the mean is 0"))),
      required(positive(
          number_field("wavelength", "m", &RoughGround::wavelength, "of the middle of the band"))),
      not_negative(integer_field("seed", &RoughGround::seed,
                                 "another seed, another ground of the same kind")),
      not_negative(number_field("flat_radius", "m", &RoughGround::flat_radius,
                                "up to here from the world's origin the ground is plane, to be "
                                "stood on; it is rough from one wavelength further out")),
      between(0., 1.57,
              number_field("slope", "rad", &RoughGround::slope,
                           "of the plane that the heights are over, below 90 deg")),
      number_field("azimuth", "rad", &RoughGround::azimuth,
                   "direction of the slope's fall, from +x about z"),
  };
  return fields;
}

const Fields<Extent>& extent_fields() {
  static const Fields<Extent> fields{
      without_default(positive(number_field(
          "spacing", "m", &Extent::spacing,
          "edge of a cell of two tiles, at most a quarter of the wavelength; if not given, an "
          "eighth"))),
      grid_size_field(),
  };
  return fields;
}

}  // namespace

void add_rough_class(language::Schema& schema) {
  std::vector<FieldSchema> fields = schemas(rough_fields());
  append(fields, schemas(extent_fields()));
  schema.add(terrain_class(
      "Terrain.Rough",
      "smooth random ground: 64 plane waves of equal amplitude, 1/sqrt(2) to sqrt(2) wavelengths "
      "long, in all directions",
      std::move(fields)));
}

GridSpec load_rough(const language::Object& object, TerrainSpec& terrain, Loading& loading) {
  const RoughGround rough = load_fields(object, rough_fields());
  Extent extent;
  extent.spacing = rough.wavelength / 8.;
  store_fields(object, extent_fields(), extent);
  load_size(object, extent);
  terrain.spacing = extent.spacing;
  const std::string problem = rough_problem(rough, extent);
  if (problem.empty()) return rough_surface(rough, extent);
  loading.error(object.position, problem);
  return {};
}

}  // namespace hookpoint::simulation
