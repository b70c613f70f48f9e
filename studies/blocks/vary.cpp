#include "studies/blocks/vary.h"

#include "studies/blocks/block.h"

namespace hookpoint::studies {

using language::Diagnostics;
using language::Object;

namespace {

enum class RangeScale { linear, logarithmic };

struct VaryBlock {
  Placed<double> from, to;
  RangeScale scale = RangeScale::linear;
};

const Fields<VaryBlock>& vary_fields() {
  static const Fields<VaryBlock> fields{
      required(number_field("from", "?", &VaryBlock::from, "least value")),
      required(number_field("to", "?", &VaryBlock::to, "greatest value")),
      choice_field("scale", {"linear", "log"}, &VaryBlock::scale, "how its range is searched")};
  return fields;
}

}  // namespace

void add_vary_class(language::Schema& schema) {
  schema.add(block_class("Vary",
                         "A constant to tune: a Param of the terrain's file or of the scene, a "
                         "field of the Material, or one of the World.",
                         schemas(vary_fields())));
}

VaryRange load_vary(const Object& object, Diagnostics& diagnostics) {
  const VaryBlock block = load_fields(object, vary_fields());
  const language::Field &from = *block.from.field, &to = *block.to.field;
  if (!language::fits(to.dimension, from.dimension) ||
      !language::fits(from.dimension, to.dimension))
    diagnostics.error(to.position, "`from` and `to` are of different units");
  VaryRange range{written_unit(from), 0.,         1., block.scale == RangeScale::logarithmic,
                  from.position,      to.position};
  range.from = tidy(range.unit.from_si(*block.from));
  range.to = tidy(range.unit.from_si(*block.to));
  if (!(range.from < range.to))
    diagnostics.error(to.position, "`to` must be greater than `from`");
  else if (range.logarithmic && !(range.from > 0.))
    diagnostics.error(from.position, "a range on a log scale begins above 0");
  return range;
}

void check_varied(const Object& object, const language::Dimension& wanted,
                  const std::string& problem, Diagnostics& diagnostics) {
  const VaryBlock block = load_fields(object, vary_fields());
  for (const Placed<double>& end : {block.from, block.to})
    if (!language::fits(end.field->dimension, wanted)) diagnostics.error(end.position(), problem);
}

}  // namespace hookpoint::studies
