#include "view/schema.h"

#include "simulation/scene/fields.h"

namespace hookpoint::view {
namespace {

using namespace simulation;

const std::vector<std::string> widgets{"Window", "Window.", "Valuator.",
                                       "Button", "Button.", "Controller."};

/// Sizes on the screen are in pixels, which the language leaves without a unit.
std::vector<FieldSchema> frame_fields() {
  return {
      positive(number_field("width", "", "", "pixels; if not given, as wide as what it holds")),
      positive(number_field("height", "", "", "pixels; if not given, as high as what it holds")),
      positive(list_field("size", "", 2, 2, "", "width,height in pixels")),
      text_field("label", "title; if not given, the name"),
  };
}

language::ClassSchema window_class() {
  language::ClassSchema window;
  window.name = "Window";
  window.doc = "a window, or a frame within one, that holds cameras, sliders and buttons";
  window.top_level = true;
  window.children = widgets;
  window.fields = frame_fields();
  return window;
}

language::ClassSchema camera_class() {
  language::ClassSchema camera;
  camera.name = "Window.grob";
  camera.doc = "a camera's picture of a world";
  camera.top_level = true;
  camera.fields = frame_fields();
  append(camera.fields,
         {required(object_field("drawer", "World", "the world that it shows")),
          with_port(Direction::both, positive(number_field("zoom", "", "1", "magnification"))),
          with_port(Direction::both,
                    positive(number_field("distance", "m", "3", "from the point looked at"))),
          with_port(Direction::both,
                    number_field("euler1", "rad", "0.6", "turn of the camera about the world's z")),
          with_port(Direction::both, number_field("euler2", "rad", "0.4",
                                                  "its height as an angle above the horizon"))});
  return camera;
}

language::ClassSchema slider_class() {
  language::ClassSchema slider;
  slider.name = "Valuator.Slider";
  slider.doc = "a slider, wired to the input that it sets";
  slider.naming = language::Naming::required;
  slider.top_level = true;
  slider.default_input = slider.default_output = "value";
  slider.fields = {
      list_field("range", "?", 2, 2, "",
                 "least and greatest value; if not given, those of the input wired to it"),
      with_port(Direction::both,
                number_field("value", "?", "",
                             "where it stands at first; if not given, the input's own value")),
      text_field("label", "shown beside it; if not given, the name"),
  };
  return slider;
}

language::ClassSchema button_class(const char* name, const char* doc, const char* value) {
  language::ClassSchema button;
  button.name = name;
  button.doc = doc;
  button.naming = language::Naming::required;
  button.top_level = true;
  button.default_input = button.default_output = "value";
  button.fields = {
      port_only(Direction::both, boolean_field("value", "", value)),
      text_field("label", "shown on it; if not given, the name"),
  };
  return button;
}

}  // namespace

void add_display_classes(language::Schema& schema) {
  schema.add(window_class());
  schema.add(camera_class());
  schema.add(slider_class());
  schema.add(button_class("Button", "a push button", "true while it is pressed"));
  schema.add(button_class("Button.Light", "a button that stays down and is lit until pressed again",
                          "true while it is lit"));
}

}  // namespace hookpoint::view
