#include "apps/view/widgets/schema.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "apps/view/widgets/widget_fields.h"
#include "language/tree/fields.h"

namespace hookpoint::view {
namespace {

using language::append;
using language::boolean_field;
using language::ClassSchema;
using language::Direction;
using language::FieldSchema;
using language::FieldType;
using language::integer_field;
using language::list_field;
using language::make_field;
using language::Naming;
using language::number_field;
using language::object_field;
using language::port_only;
using language::text_field;
using language::words_field;

/// What may stand in a window beside controllers; a name that ends in a dot is a family.
constexpr std::array<std::string_view, 9> widgets{
    "Window", "Window.", "Valuator.", "Button", "Button.", "Text", "Table", "Plot", "Plot."};

FieldSchema shared(FieldSchema field) { return with_port(Direction::both, std::move(field)); }

/// Sizes on the screen are in pixels, which the language leaves without a unit.
std::vector<FieldSchema> frame_fields(const char* label) {
  using namespace widget_field;
  return {
      shared(not_negative(number_field(width, "", "", "pixels; 0 or not given: as it needs"))),
      shared(not_negative(number_field(height, "", "", "pixels; 0 or not given: as it needs"))),
      shared(not_negative(
          list_field(size, "", 2, 2, "", "width,height in pixels, where those are not given"))),
      text_field(widget_field::label, std::string(label) + "; if not given, the name"),
  };
}

ClassSchema widget_class(const char* name, const char* doc, const char* label) {
  ClassSchema widget;
  widget.name = name;
  widget.doc = doc;
  widget.top_level = true;
  widget.fields = frame_fields(label);
  return widget;
}

ClassSchema window_class() {
  ClassSchema window = widget_class(
      "Window", "a window, or a frame within one, that holds what is to be seen", "title");
  window.children.assign(widgets.begin(), widgets.end());
  window.children.emplace_back("Controller.");
  return window;
}

ClassSchema camera_class() {
  using namespace widget_field;
  constexpr double pi = std::numbers::pi;
  ClassSchema camera = widget_class("Window.grob", "a camera's picture of a world", "title");
  append(camera.fields,
         {required(object_field(drawer, "World", "the world that it shows")),
          object_field(follow, "Base.|Link|Obstacle.", "the body that the camera goes with"),
          shared(between(0.1, 10., number_field(zoom, "", "1", "magnification"))),
          shared(between(0.2, 20., number_field(distance, "m", "3", "from the point looked at"))),
          shared(between(
              -pi, pi,
              number_field(
                  euler1, "rad", "0.6",
                  "azimuth of the camera: its turn about the world's z; at 0 it looks along +y"))),
          shared(between(-pi / 2., pi / 2.,
                         number_field(euler2, "rad", "0.4",
                                      "elevation of the camera: its angle above the horizon"))),
          shared(between(1., 1e6,
                         number_field(exaggeration, "", "1",
                                      "displacements of bodies from where they started "
                                      "are drawn that many times as large")))});
  for (const Switch& item : switches)
    camera.fields.push_back(
        shared(boolean_field(item.name, item.default_text, "show " + std::string(item.doc))));
  return camera;
}

/// `value` is both what it shows and what it sets.
ClassSchema input_class(const char* name, const char* doc, FieldSchema value) {
  ClassSchema input = widget_class(name, doc, "shown with it");
  input.naming = Naming::required;
  input.default_input = input.default_output = widget_field::value;
  input.fields.push_back(std::move(value));
  return input;
}

ClassSchema valuator_class(const char* name, const char* doc) {
  using namespace widget_field;
  ClassSchema valuator = input_class(
      name, doc,
      shared(number_field(value, "?", "",
                          "where it stands at first; if not given, the input's own value")));
  append(valuator.fields,
         {shared(list_field(range, "?", 2, 2, "",
                            "least and greatest value; if not given, or both alike, those of the "
                            "input wired to it")),
          shared(not_negative(number_field(increment, "?", "",
                                           "between values that it takes; 0 or not given: any")))});
  return valuator;
}

ClassSchema button_class(const char* name, const char* doc, const char* value) {
  return input_class(name, doc,
                     port_only(Direction::both, boolean_field(widget_field::value, "", value)));
}

ClassSchema choice_class() {
  using namespace widget_field;
  ClassSchema choice = input_class(
      "Button.Choice", "buttons of which one is down",
      shared(not_negative(integer_field(
          value, "",
          "which is down, the first is 0; if not given, as the input wired to it says"))));
  choice.fields.push_back(required(words_field(choices, 100, "what stands on each")));
  return choice;
}

FieldSchema digits_field() {
  return shared(between(1., 17., integer_field(widget_field::digits, "4", "of each number")));
}

ClassSchema text_class() {
  using namespace widget_field;
  ClassSchema shown = widget_class("Text", "words, and numbers of the run among them", "title");
  append(shown.fields, {required(text_field(text,
                                            "{0} stands for the first of `values`, {1} for "
                                            "the second, each with its unit")),
                        words_field(values, 100, "trails of ports"), digits_field()});
  return shown;
}

ClassSchema table_class() {
  using namespace widget_field;
  ClassSchema table = widget_class("Table", "numbers of the run as they are", "title");
  append(table.fields, {required(words_field(rows, 1000,
                                             "trails of ports, a row each; a vector is a row a "
                                             "component; in \"...\" * and ** stand for any names")),
                        digits_field()});
  return table;
}

/// A trace of a Plot or of a Plot.3D; what does not fit, where it stands is told when it is loaded.
ClassSchema trace_class() {
  using namespace widget_field;
  ClassSchema trace;
  trace.name = "Trace";
  trace.doc = "a line of a plot: what it is drawn from";
  trace.fields = {
      make_field(FieldType::port, x, "port along x; if not given, time"),
      required(make_field(FieldType::port, y, "port along y")),
      make_field(FieldType::port, z, "port along z, in a Plot.3D"),
      text_field(label, "in the legend; if not given, the trail"),
  };
  return trace;
}

ClassSchema surface_class() {
  using namespace widget_field;
  ClassSchema surface;
  surface.name = "Surface";
  surface.doc = "a surface of a Plot.3D through all that its three ports have been";
  surface.fields = {
      required(make_field(FieldType::port, x, "port along x")),
      required(make_field(FieldType::port, y, "port along y")),
      required(make_field(FieldType::port, z, "port along z")),
      text_field(label, "in the legend; if not given, the trail"),
  };
  return surface;
}

FieldSchema range_field(const char* name, const char* doc) {
  return shared(list_field(name, "?", 2, 2, "",
                           std::string(doc) + "; if not given, or both alike, as the data need"));
}

FieldSchema history_field() {
  return shared(not_negative(
      number_field(widget_field::window, "s", "",
                   "what it shows up to the present, rolling; 0 or not given: the whole run")));
}

ClassSchema plot_class() {
  using namespace widget_field;
  ClassSchema plot = widget_class("Plot", "numbers of the run over time, or over another", "title");
  plot.children = {"Trace"};
  append(
      plot.fields,
      {words_field(show, 100, "trails of ports over time, in short for a Trace each"),
       range_field(range, "least and greatest value along y"),
       range_field(x_range, "least and greatest value along x"), history_field(),
       object_field(overlay, "Plot|Window.grob",
                    "a plot over which this one is laid, on the same axes, or a camera over whose "
                    "picture it is")});
  return plot;
}

ClassSchema plot_3d_class() {
  ClassSchema plot =
      widget_class("Plot.3D", "trajectories or a surface in three dimensions", "title");
  plot.children = {"Trace", "Surface"};
  plot.fields.push_back(history_field());
  return plot;
}

/// A choice as it is the World's, that may be left alone.
FieldSchema varied(const language::Schema& schema, const char* name, const char* doc) {
  FieldSchema field = make_field(FieldType::choice, name, doc);
  field.choices = schema.find("World")->find(name)->choices;
  return field;
}

ClassSchema ghost_class(const language::Schema& schema) {
  ClassSchema ghost;
  ghost.name = "Ghost";
  ghost.doc =
      "the same experiment under another engine, law, integrator or Params, stepped beside the run "
      "and drawn with it; one that says nothing of these names and colours the run itself";
  ghost.naming = Naming::required;
  ghost.top_level = true;
  ghost.children = {"Fix"};
  ghost.fields = {
      varied(schema, "engine", "as of a World; if not given, the run's"),
      varied(schema, "settings", "of another engine, as of a World; if not given, the run's"),
      varied(schema, "contact", "law, as of a World; if not given, the run's"),
      varied(schema, "integrator", "as of a World; if not given, the run's"),
      text_field(widget_field::label, "in legends; if not given, the name"),
      between(0., 1.,
              list_field(widget_field::colour, "", 3, 3, "",
                         "red, green, blue; if not given, one of the figures'")),
  };
  return ghost;
}

}  // namespace

void add_display_classes(language::Schema& schema) {
  schema.add(window_class());
  schema.add(camera_class());
  schema.add(valuator_class("Valuator.Slider", "a slider, wired to the input that it sets"));
  schema.add(valuator_class("Valuator.Dial", "a dial, wired to the input that it sets"));
  schema.add(valuator_class("Valuator.Counter",
                            "a number with buttons for more and less, wired to the input that it "
                            "sets"));
  schema.add(
      valuator_class("Valuator.Input", "a number that is typed, wired to the input that it sets"));
  schema.add(button_class("Button", "a push button",
                          "true once it is pressed, until the program has seen it"));
  schema.add(button_class("Button.Light", "a button that stays down and is lit until pressed again",
                          "true while it is lit"));
  schema.add(choice_class());
  schema.add(text_class());
  schema.add(table_class());
  schema.add(trace_class());
  schema.add(surface_class());
  schema.add(plot_class());
  schema.add(plot_3d_class());
  schema.add(ghost_class(schema));
}

bool is_widget(std::string_view type) {
  return std::ranges::any_of(widgets, [&](std::string_view name) {
    return name.ends_with('.') ? type.starts_with(name) : type == name;
  });
}

}  // namespace hookpoint::view
