// Units of the language: those of text/units.h, which tables of numbers have too.
#pragma once

#include "language/dimension.h"
#include "text/units.h"

namespace hookpoint::language {

using text::comparable;
using text::describe_dimension;
using text::find_unit;
using text::fits;
using text::parse_unit;
using text::power;
using text::scan_unit;
using text::ScannedUnit;
using text::Unit;
using text::unit_names;
using text::unit_text;

}  // namespace hookpoint::language
