// The classes of a display as the language sees them: windows, cameras, sliders, buttons, text,
// tables, plots, ghosts.
#pragma once

#include <string_view>

#include "language/schema/schema.h"

namespace hookpoint::view {

/// Adds them to the classes of an experiment, whose World a Ghost varies.
void add_display_classes(language::Schema& schema);

/// Whether it is a class of which something is shown: a Window or what stands in one.
bool is_widget(std::string_view type);

}  // namespace hookpoint::view
