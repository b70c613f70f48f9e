// Dimensions of the language's values: those of text/dimension.h, which tables of numbers have too.
#pragma once

#include "text/dimension.h"

namespace hookpoint::language {

using text::Dimension;

}  // namespace hookpoint::language
