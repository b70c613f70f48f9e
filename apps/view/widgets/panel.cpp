#include "apps/view/widgets/panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "apps/view/widgets/schema.h"
#include "apps/view/widgets/widget_fields.h"
#include "language/units.h"
#include "simulation/scene/trails.h"
#include "simulation/wiring/port_search.h"

namespace hookpoint::view {
namespace {

using language::Field;
using language::FieldSchema;
using language::Object;
using language::Reference;
using simulation::ObjectTrails;
using simulation::Port;

/// An end of a wire: a number of an object.
struct End {
  const Object* object = nullptr;
  const FieldSchema* field = nullptr;
  std::string trail;
};

class PanelBuilder {
 public:
  PanelBuilder(const Object& root, const simulation::Experiment& experiment,
               const std::vector<Port>& ports, language::Diagnostics& diagnostics)
      : root_(root),
        experiment_(experiment),
        ports_(ports),
        diagnostics_(diagnostics),
        trails_(simulation::trails_of(root)) {
    for (const Port& port : ports) by_trail_.emplace(port.trail, &port);
    if (experiment.values) {
      for (const simulation::ValueSpec& value : *experiment.values) held_.insert(value.trail);
    }
    collect_wires(root);
  }

  Panel run() { return {widgets_in(root_)}; }

 private:
  // Objects.

  /// What a named Include lays down stands where the Include stands.
  std::vector<Widget> widgets_in(const Object& parent) {
    std::vector<Widget> widgets;
    for (const auto& child : parent.children) {
      if (is_widget(child->type)) widgets.push_back(widget(*child));
      if (child->type != "Group") continue;
      for (Widget& inner : widgets_in(*child)) widgets.push_back(std::move(inner));
    }
    return widgets;
  }

  Widget widget(const Object& object) {
    Widget made;
    made.type = object.type;
    made.trail = trails_.at(&object);
    made.label = label_of(object, object.name);
    made.width = extent(object, widget_field::width, 0);
    made.height = extent(object, widget_field::height, 1);
    made.ports = attributes(object);
    if (object.type == "Window") made.content = Frame{widgets_in(object)};
    if (object.type == "Window.grob") made.content = camera(object);
    if (object.type.starts_with("Valuator.")) made.content = valuator(object);
    if (object.type.starts_with("Button")) made.content = pressed(object);
    if (object.type == "Text") made.content = text(object);
    if (object.type == "Table") made.content = table(object);
    if (object.type == "Plot") made.content = plot(object);
    if (object.type == "Plot.3D") made.content = plot_3d(object);
    return made;
  }

  static std::string label_of(const Object& object, const std::string& otherwise) {
    return object.given(widget_field::label) ? object.word(widget_field::label) : otherwise;
  }

  static std::optional<double> positive(const Object& object, const char* field) {
    const Field* given = object.find(field);
    if (given == nullptr || given->numbers[0] <= 0.) return std::nullopt;
    return given->numbers[0];
  }

  static std::optional<double> extent(const Object& object, const char* field, std::size_t part) {
    if (const std::optional<double> own = positive(object, field)) return own;
    const Field* size = object.find(widget_field::size);
    if (size == nullptr || size->numbers[part] <= 0.) return std::nullopt;
    return size->numbers[part];
  }

  static std::optional<Range> range(const Object& object, const char* field) {
    const Field* given = object.find(field);
    if (given == nullptr || given->numbers[0] == given->numbers[1]) return std::nullopt;
    return Range{given->numbers[0], given->numbers[1]};
  }

  /// A range that a file gives has its least value first.
  std::optional<Range> ordered_range(const Object& object, const char* field) {
    const std::optional<Range> found = range(object, field);
    if (found && (*found)[0] > (*found)[1]) {
      diagnostics_.error(
          object.find(field)->position,
          fmt::format("`{}` takes the least value first: {},{}", field, (*found)[1], (*found)[0]));
    }
    return found;
  }

  /// What a valuator or a button sets is told by itself.
  std::vector<std::pair<std::string, std::string>> attributes(const Object& object) const {
    std::vector<std::pair<std::string, std::string>> found;
    const auto add = [&](const std::string& name) {
      const std::string trail = trails_.at(&object) + "." + name;
      if (held_.contains(trail)) found.emplace_back(name, trail);
    };
    for (const FieldSchema& field : object.schema->fields) {
      if (field.port == language::Direction::none || field.name == widget_field::value) continue;
      const int parts = simulation::components_of(field);
      for (int i = 0; i < parts; ++i)
        add(field.name + (parts > 1 ? language::part_name(field, i) : ""));
    }
    return found;
  }

  /// A free obstacle is the base of a robot.
  std::string body_trail(const Object* body) const {
    const bool free = body->type.starts_with("Obstacle.") && body->boolean("free");
    return trails_.at(body) + (free ? ".base" : "");
  }

  Camera camera(const Object& object) {
    Camera made;
    made.drawer = trails_.at(object.object(widget_field::drawer));
    if (object.given(widget_field::follow))
      made.follow = body_trail(object.object(widget_field::follow));
    for (const widget_field::Switch& item : widget_field::switches)
      made.show.emplace_back(item.name, object.boolean(item.name));
    return made;
  }

  Valuator valuator(const Object& object) {
    const End other = wired_to(object);
    Valuator made{own_port(object, other), ordered_range(object, widget_field::range),
                  positive(object, widget_field::increment)};
    if (!made.range && other.field != nullptr) made.range = range_of(object, other, made.port.unit);
    return made;
  }

  Pressed pressed(const Object& object) {
    Pressed made{own_port(object, wired_to(object)), {}};
    made.port.unit.clear();
    if (const Field* choices = object.find(widget_field::choices)) made.choices = choices->words;
    return made;
  }

  TextShown text(const Object& object) {
    TextShown made{object.word(widget_field::text), listed(object, widget_field::values),
                   static_cast<int>(object.number(widget_field::digits))};
    check_placeholders(*object.find(widget_field::text), made);
    return made;
  }

  void check_placeholders(const Field& field, const TextShown& shown) {
    const std::string& text = shown.text;
    for (std::size_t open = text.find('{'); open != std::string::npos;
         open = text.find('{', open + 1)) {
      const std::size_t close = text.find_first_not_of("0123456789", open + 1);
      if (close == open + 1 || close == std::string::npos || text[close] != '}') continue;
      const std::string index = text.substr(open + 1, close - open - 1);
      if (index.size() > 3 || std::stoul(index) >= shown.values.size()) {
        diagnostics_.error(field.position,
                           fmt::format("`{{{}}}` stands for none of the {} `values`; the first is "
                                       "`{{0}}`",
                                       index, shown.values.size()));
      }
    }
  }

  TableShown table(const Object& object) {
    return {listed(object, widget_field::rows),
            static_cast<int>(object.number(widget_field::digits))};
  }

  PlotShown plot(const Object& object) {
    PlotShown made;
    for (ShownPort& shown : listed(object, widget_field::show)) {
      std::string label = shown.label;
      made.traces.push_back({{}, std::move(shown), {}, std::move(label)});
    }
    for (const Object* trace : object.children_of("Trace")) {
      if (const Field* z = trace->find(widget_field::z))
        diagnostics_.error(z->position, "a Trace of a Plot has no `z`; a Plot.3D shows three");
      add_trace(*trace, made.traces);
    }
    made.range = ordered_range(object, widget_field::range);
    made.x_range = ordered_range(object, widget_field::x_range);
    made.window = positive(object, widget_field::window);
    if (object.given(widget_field::overlay)) made.overlay = overlaid(object);
    return made;
  }

  std::string overlaid(const Object& object) {
    const Object* below = object.object(widget_field::overlay);
    if (below->type == "Plot.3D" || below == &object)
      diagnostics_.error(object.find(widget_field::overlay)->position,
                         "a Plot is laid over another Plot or a camera");
    return trails_.at(below);
  }

  Plot3dShown plot_3d(const Object& object) {
    Plot3dShown made;
    for (const Object* trace : object.children_of("Trace")) {
      for (const char* axis : {widget_field::x, widget_field::z}) {
        if (!trace->given(axis))
          diagnostics_.error(trace->position, fmt::format("a Trace of a Plot.3D needs `{}`", axis));
      }
      add_trace(*trace, made.traces);
    }
    std::vector<Trace> surfaces;
    for (const Object* surface : object.children_of("Surface")) {
      if (!surfaces.empty())
        diagnostics_.error(surface->position, "a second Surface; a Plot.3D shows one");
      add_trace(*surface, surfaces);
    }
    if (!surfaces.empty()) made.surface = std::move(surfaces.front());
    made.window = positive(object, widget_field::window);
    return made;
  }

  void add_trace(const Object& object, std::vector<Trace>& traces) {
    const auto y = axis(object, widget_field::y);
    if (!y) return;
    const auto x = axis(object, widget_field::x), z = axis(object, widget_field::z);
    traces.push_back({x, *y, z, label_of(object, z ? z->label : y->label)});
  }

  std::optional<ShownPort> axis(const Object& object, const char* name) {
    const Field* field = object.find(name);
    if (field == nullptr) return std::nullopt;
    const Reference& reference = field->reference;
    std::string trail = reference.trail;
    // An object alone means its output.
    if (reference.object != nullptr && !trail.ends_with(reference.port))
      trail += "." + reference.port;
    const std::vector<ShownPort> found = numbers(object, trail, reference.position);
    if (found.empty()) return std::nullopt;
    if (found.size() > 1) {
      diagnostics_.error(reference.position,
                         fmt::format("`{}` has {} components; name one, such as `{}`", trail,
                                     found.size(), found.front().label));
    }
    return found.front();
  }

  // Ports.

  /// The numbers that a list of trails names, a vector's components each.
  std::vector<ShownPort> listed(const Object& object, const char* field_name) {
    std::vector<ShownPort> shown;
    const Field* field = object.find(field_name);
    if (field == nullptr) return shown;
    for (std::size_t i = 0; i < field->words.size(); ++i) {
      const std::string& word = field->words[i];
      const bool is_glob = word.find_first_of("*?") != std::string::npos;
      for (ShownPort& port : is_glob ? fitting(word) : numbers(object, word, field->places[i])) {
        if (std::ranges::find(shown, port.trail, &ShownPort::trail) == shown.end())
          shown.push_back(std::move(port));
      }
    }
    return shown;
  }

  /// The ports of the run that a glob fits, from the top or from within the world.
  std::vector<ShownPort> fitting(const std::string& glob) const {
    std::vector<ShownPort> shown;
    const std::string within = experiment_.world + "." + glob;
    for (const Port& port : ports_) {
      const auto fits = [&](const std::string& pattern) {
        return simulation::glob_fits(pattern, port.trail) ||
               simulation::glob_fits(pattern, simulation::whole_of(port.trail));
      };
      if (fits(glob) || fits(within)) shown.push_back({port.trail, port.unit, port.trail});
    }
    return shown;
  }

  /// The numbers of one trail, labelled as it is written.
  std::vector<ShownPort> numbers(const Object& from, const std::string& trail,
                                 const language::Position& place) {
    const auto found =
        simulation::find_number(from, trail, place, names_, trails_, experiment_, diagnostics_);
    if (!found) return {};
    const FieldSchema& field = *found->target.field;
    const int parts = found->target.part < 0 ? simulation::components_of(field) : 1;
    std::vector<ShownPort> shown;
    for (int i = 0; i < parts; ++i) {
      const std::string part = parts > 1 ? language::part_name(field, i) : "";
      const std::string whole = found->trail + part;
      shown.push_back({whole, unit_of({found->target.object, &field, whole}), trail + part});
    }
    return shown;
  }

  /// As the class says it, or the run where that leaves it open.
  std::string unit_of(const End& end) const {
    const std::string& unit = end.object->unit_of(*end.field);
    if (unit != "?") return unit;
    const Port* port = port_at(end.trail);
    return port == nullptr ? "" : port->unit;
  }

  const Port* port_at(const std::string& trail) const {
    const auto found = by_trail_.find(trail);
    return found == by_trail_.end() ? nullptr : found->second;
  }

  /// Of what it is wired to; where that is open, of its own range or value.
  ShownPort own_port(const Object& object, const End& other) const {
    std::string unit = other.field == nullptr ? "" : unit_of(other);
    for (const char* name : {widget_field::range, widget_field::value}) {
      const Field* own = object.find(name);
      if (unit.empty() && own != nullptr && own->schema->unit == "?")
        unit = language::unit_text(own->dimension);
    }
    return {trails_.at(&object) + "." + widget_field::value, unit, label_of(object, object.name)};
  }

  // Wires.

  void collect_wires(const Object& object) {
    for (const language::Wire& wire : object.wires) {
      if (!wire.from || !wire.to) continue;
      if (is_widget(wire.from->object->type)) sets_.emplace(wire.from->object, &*wire.to);
      if (is_widget(wire.to->object->type)) shows_.emplace(wire.to->object, &*wire.from);
    }
    for (const auto& child : object.children) collect_wires(*child);
  }

  /// The first input that a widget sets, else what it is set from.
  End wired_to(const Object& object) const {
    for (const auto* wires : {&sets_, &shows_}) {
      const auto found = wires->find(&object);
      if (found != wires->end()) return end_of(*found->second);
    }
    return {};
  }

  End end_of(const Reference& reference) const {
    const FieldSchema* field = reference.object->schema->find(reference.port);
    if (field == nullptr)
      field = reference.object->schema->find(
          reference.port.substr(0, reference.port.find_last_of(".[")));
    return {reference.object, field, trails_.at(reference.object) + "." + reference.port};
  }

  /// Of a valuator that says none: see make_panel.
  Range range_of(const Object& object, const End& other, const std::string& unit) const {
    const double value = value_of(object, other);
    double reach = 2. * std::abs(value);
    if (reach == 0.) reach = unit == "rad" ? std::numbers::pi : 1.;
    Range range{other.field->minimum, other.field->maximum};
    if (!std::isfinite(range[1])) range[1] = std::max(reach, range[0] + reach);
    if (!std::isfinite(range[0])) range[0] = std::min(-reach, range[1] - reach);
    return range;
  }

  /// Where the valuator stands at first: as it says, else as the input does.
  double value_of(const Object& object, const End& other) const {
    if (const Field* own = object.find(widget_field::value)) return own->numbers[0];
    if (const Port* port = port_at(other.trail)) return *port->value;
    const Field* given = other.object->find(other.field->name);
    return given == nullptr || given->numbers.size() != 1 ? 0. : given->numbers[0];
  }

  const Object& root_;
  const simulation::Experiment& experiment_;
  const std::vector<Port>& ports_;
  language::Diagnostics& diagnostics_;
  const ObjectTrails trails_;
  language::Names names_;
  std::map<std::string, const Port*> by_trail_;  ///< of two alike the first, as wires take it
  std::set<std::string> held_;                   ///< trails of values that the file makes ports
  std::map<const Object*, const Reference*> sets_, shows_;
};

// JSON.

class PanelWriter {
 public:
  explicit PanelWriter(text::JsonWriter& json) : json_(json) {}

  void operator()(const Widget& widget) {
    json_.begin_object();
    json_.member("type", widget.type).member("trail", widget.trail).member("label", widget.label);
    optional("width", widget.width);
    optional("height", widget.height);
    json_.key("ports").begin_object();
    for (const auto& [name, trail] : widget.ports) json_.member(name, trail);
    json_.end_object();
    std::visit(*this, widget.content);
    json_.end_object();
  }

  void operator()(const Frame& frame) {
    json_.key("children").begin_array();
    for (const Widget& child : frame.children) (*this)(child);
    json_.end_array();
  }

  void operator()(const Camera& camera) {
    json_.member("drawer", camera.drawer);
    optional("follow", camera.follow);
    json_.key("show").begin_object();
    for (const auto& [name, shown] : camera.show) json_.member(name, shown);
    json_.end_object();
  }

  void operator()(const Valuator& valuator) {
    json_.member("port", valuator.port.trail);
    optional("range", valuator.range);
    json_.member("unit", valuator.port.unit);
    optional("increment", valuator.increment);
  }

  void operator()(const Pressed& pressed) {
    json_.member("port", pressed.port.trail);
    if (pressed.choices.empty()) return;
    json_.key("choices").begin_array();
    for (const std::string& choice : pressed.choices) json_.value(choice);
    json_.end_array();
  }

  void operator()(const TextShown& text) {
    json_.member("text", text.text).key("values").begin_array();
    for (const ShownPort& port : text.values) {
      json_.begin_object().member("trail", port.trail).member("unit", port.unit);
      json_.member("digits", text.digits).end_object();
    }
    json_.end_array();
  }

  void operator()(const TableShown& table) {
    json_.key("rows").begin_array();
    for (const ShownPort& port : table.rows) {
      json_.begin_object().member("trail", port.trail).member("unit", port.unit);
      json_.member("label", port.label).member("digits", table.digits).end_object();
    }
    json_.end_array();
  }

  void operator()(const PlotShown& plot) {
    json_.key("traces").begin_array();
    for (const Trace& trace : plot.traces) {
      json_.begin_object();
      axis("x", trace.x);
      json_.member("y", trace.y.trail).member("label", trace.label);
      json_.member("unit", trace.y.unit);
      json_.member("x_unit", trace.x ? trace.x->unit : "s").end_object();
    }
    json_.end_array();
    optional("range", plot.range);
    optional("x_range", plot.x_range);
    optional("window", plot.window);
    optional("overlay", plot.overlay);
  }

  void operator()(const Plot3dShown& plot) {
    json_.key("traces").begin_array();
    for (const Trace& trace : plot.traces) three(trace);
    json_.end_array();
    json_.key("surface");
    if (plot.surface) {
      three(*plot.surface);
    } else {
      json_.null();
    }
    optional("window", plot.window);
  }

 private:
  void axis(const char* name, const std::optional<ShownPort>& port) {
    json_.key(name);
    if (port) {
      json_.value(port->trail);
    } else {
      json_.null();
    }
  }

  void three(const Trace& trace) {
    json_.begin_object();
    axis("x", trace.x);
    json_.member("y", trace.y.trail);
    axis("z", trace.z);
    json_.member("label", trace.label).member("unit", trace.z ? trace.z->unit : "");
    json_.member("x_unit", trace.x ? trace.x->unit : "").member("y_unit", trace.y.unit);
    json_.end_object();
  }

  template <class Value>
  void optional(const char* name, const std::optional<Value>& value) {
    json_.key(name);
    if (!value) {
      json_.null();
    } else if constexpr (std::is_same_v<Value, Range>) {
      json_.numbers(*value);
    } else {
      json_.value(*value);
    }
  }

  text::JsonWriter& json_;
};

/// Collects the trails of what is watched.
struct Watched {
  std::vector<std::string> trails;
  std::set<std::string> seen;

  void add(const std::string& trail) {
    if (seen.insert(trail).second) trails.push_back(trail);
  }
  void add(const std::vector<ShownPort>& ports) {
    for (const ShownPort& port : ports) add(port.trail);
  }
  void add(const Trace& trace) {
    if (trace.x) add(trace.x->trail);
    add(trace.y.trail);
    if (trace.z) add(trace.z->trail);
  }

  void operator()(const Widget& widget) {
    for (const auto& [name, trail] : widget.ports) add(trail);
    std::visit(*this, widget.content);
  }
  void operator()(const Frame& frame) {
    for (const Widget& child : frame.children) (*this)(child);
  }
  void operator()(const Camera&) {}
  void operator()(const Valuator& valuator) { add(valuator.port.trail); }
  void operator()(const Pressed& pressed) { add(pressed.port.trail); }
  void operator()(const TextShown& text) { add(text.values); }
  void operator()(const TableShown& table) { add(table.rows); }
  void operator()(const PlotShown& plot) {
    for (const Trace& trace : plot.traces) add(trace);
  }
  void operator()(const Plot3dShown& plot) {
    for (const Trace& trace : plot.traces) add(trace);
    if (plot.surface) add(*plot.surface);
  }
};

/// What plots draw, over time or over one another.
struct Plotted {
  std::vector<std::string> trails;

  void operator()(const Widget& widget) { std::visit(*this, widget.content); }
  void operator()(const Frame& frame) {
    for (const Widget& child : frame.children) (*this)(child);
  }
  void operator()(const PlotShown& plot) { add(plot.traces); }
  void operator()(const Plot3dShown& plot) {
    add(plot.traces);
    if (plot.surface) add(*plot.surface);
  }
  void operator()(const auto& /*no plot*/) {}

 private:
  void add(const std::vector<Trace>& traces) {
    for (const Trace& trace : traces) add(trace);
  }
  void add(const Trace& trace) {
    if (trace.x) trails.push_back(trace.x->trail);
    trails.push_back(trace.y.trail);
    if (trace.z) trails.push_back(trace.z->trail);
  }
};

}  // namespace

Panel make_panel(const language::Object& root, const simulation::Experiment& experiment,
                 const std::vector<simulation::Port>& ports, language::Diagnostics& diagnostics) {
  return PanelBuilder(root, experiment, ports, diagnostics).run();
}

std::vector<std::string> ports_of(const Panel& panel) {
  Watched watched;
  for (const Widget& widget : panel.windows) watched(widget);
  return std::move(watched.trails);
}

std::vector<std::string> plotted_of(const Panel& panel) {
  Plotted plotted;
  for (const Widget& widget : panel.windows) plotted(widget);
  return std::move(plotted.trails);
}

void write_panel(const Panel& panel, text::JsonWriter& json) {
  PanelWriter write(json);
  json.begin_array();
  for (const Widget& widget : panel.windows) write(widget);
  json.end_array();
}

}  // namespace hookpoint::view
