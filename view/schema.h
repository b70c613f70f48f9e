// The classes of a display as the language sees them: windows, cameras, sliders, buttons.
#pragma once

#include "language/schema/schema.h"

namespace hookpoint::view {

/// Window, Window.grob, Valuator.Slider, Button, Button.Light.
void add_display_classes(language::Schema& schema);

}  // namespace hookpoint::view
