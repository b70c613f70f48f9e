// What a file lays out to be seen and touched, as plain data that a page is sent once: the widgets
// of the object tree with the trails of the ports that they show and set.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "language/diagnostics.h"
#include "language/tree/object.h"
#include "simulation/experiment/experiment.h"
#include "simulation/wiring/ports.h"
#include "text/json.h"

namespace hookpoint::view {

using Range = std::array<double, 2>;  ///< least and greatest

/// A port and how it is shown.
struct ShownPort {
  std::string trail, unit, label;
};

/// A line of a plot. Without `x`, over time.
struct Trace {
  std::optional<ShownPort> x;
  ShownPort y;
  std::optional<ShownPort> z;  ///< of a Plot.3D
  std::string label;
};

struct Widget;

struct Frame {
  std::vector<Widget> children;
};
struct Camera {
  std::string drawer;                              ///< the world's trail
  std::optional<std::string> follow;               ///< a body's trail
  std::vector<std::pair<std::string, bool>> show;  ///< each switch as the file has it
};
/// Slider, Dial, Counter, Input.
struct Valuator {
  ShownPort port;
  std::optional<Range> range;
  std::optional<double> increment;
};
/// Button, Button.Light; Button.Choice, whose value is an index into `choices`.
struct Pressed {
  ShownPort port;
  std::vector<std::string> choices;
};
struct TextShown {
  std::string text;
  std::vector<ShownPort> values;
  int digits = 4;
};
struct TableShown {
  std::vector<ShownPort> rows;
  int digits = 4;
};
struct PlotShown {
  std::vector<Trace> traces;
  std::optional<Range> range, x_range;
  std::optional<double> window;        ///< [s]; none: the whole run
  std::optional<std::string> overlay;  ///< trail of the plot or camera over which this one is laid
};
struct Plot3dShown {
  std::vector<Trace> traces;
  std::optional<Trace> surface;
  std::optional<double> window;  ///< [s]
};

struct Widget {
  std::string type;   ///< class of the language
  std::string trail;  ///< from the top
  std::string label;
  std::optional<double> width, height;  ///< pixels
  /// Its attributes that are ports: the name of the attribute, with its part, and the trail.
  std::vector<std::pair<std::string, std::string>> ports;
  std::variant<Frame, Camera, Valuator, Pressed, TextShown, TableShown, PlotShown, Plot3dShown>
      content;
};

struct Panel {
  std::vector<Widget> windows;  ///< and what else stands at the top
};

/// The panel of the file that `experiment` was loaded from. `ports` are those of its run; without
/// them, as when a file is only checked, open units stay open and nothing fits the globs of a
/// Table. What a trail does not lead to is an error at its place.
///
/// A valuator without a range has that of the input wired to it, as its class declares it. What is
/// open there is worked out from the value v of the input: up to 2 |v|, of v = 0 up to 1, an angle
/// up to pi; down to the negative of that.
Panel make_panel(const language::Object& root, const simulation::Experiment& experiment,
                 const std::vector<simulation::Port>& ports, language::Diagnostics& diagnostics);

/// Ports whose values a page needs, each once, in the order of the panel.
std::vector<std::string> ports_of(const Panel& panel);

/// What its plots draw.
std::vector<std::string> plotted_of(const Panel& panel);

/// The "windows" of docs/view_protocol.md: a list of WIDGETs.
void write_panel(const Panel& panel, text::JsonWriter& json);

}  // namespace hookpoint::view
