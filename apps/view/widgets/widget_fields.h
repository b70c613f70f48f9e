// Fields of the display's classes, by the names under which files give them; for the schema and for
// those that read the objects.
#pragma once

#include <array>

namespace hookpoint::view::widget_field {

inline constexpr const char *width = "width", *height = "height", *size = "size", *label = "label";

// Of a Ghost, which has a label too.
inline constexpr const char* colour = "colour";

// Of a Window.grob.
inline constexpr const char *drawer = "drawer", *follow = "follow", *zoom = "zoom",
                            *distance = "distance", *euler1 = "euler1", *euler2 = "euler2",
                            *exaggeration = "exaggeration";
/// What a camera shows or leaves out.
struct Switch {
  const char *name, *default_text, *doc;
};
inline constexpr std::array<Switch, 12> switches{{
    {"shapes", "true", "the bodies' shapes"},
    {"terrain", "true", "the ground, coloured by material"},
    {"edges", "true", "the edges of its tiles"},
    {"contact_forces", "false", "the ground's forces, where they act"},
    {"hooks", "false", "the contacts' hooks and how far they are stretched"},
    {"slip_traces", "false", "where contacts have slipped over the ground"},
    {"penetration", "false", "how deep contacts are in the ground, as a colour"},
    {"frames", "false", "the bodies' frames: x red, y green, z blue"},
    {"centers_of_mass", "false", "the bodies' centres of mass"},
    {"inertia", "false", "boxes of the bodies' inertia: of equal mass, evenly filled"},
    {"joint_axes", "false", "axes that joints turn about or slide along"},
    {"sensors", "false", "where sensors are"},
}};

// Of Valuators and Buttons.
inline constexpr const char *value = "value", *range = "range", *increment = "increment",
                            *choices = "choices";
// Of Text and Table.
inline constexpr const char *text = "text", *values = "values", *digits = "digits", *rows = "rows";
// Of Plots and what stands in them.
inline constexpr const char *show = "show", *x_range = "x_range", *window = "window",
                            *overlay = "overlay", *x = "x", *y = "y", *z = "z";

}  // namespace hookpoint::view::widget_field
