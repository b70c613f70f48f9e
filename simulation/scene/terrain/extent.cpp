// How far a computed ground reaches.
#include "language/tree/fields.h"
#include "simulation/scene/terrain/classes.h"

namespace hookpoint::simulation {

using language::FieldSchema;
using language::list_field;

FieldSchema grid_size_field() {
  return positive(list_field(size_field, "m", 1, 2, "10",
                             "extent along x,y (one number: both), centred on the world's origin "
                             "and made up to an even number of cells"));
}

void load_size(const language::Object& object, Extent& extent) {
  const std::vector<double>& size = object.numbers(size_field);
  extent.size_x = size.front();
  extent.size_y = size.back();
}

}  // namespace hookpoint::simulation
