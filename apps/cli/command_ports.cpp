#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "language/tree/references.h"
#include "simulation/run/world.h"
#include "simulation/wiring/port_search.h"
#include "text/json.h"
#include "text/number.h"

namespace hookpoint::cli {
namespace {

using simulation::Port;

/// What is said of a port beside its trail and unit.
struct PortText {
  const char* kind = "";
  std::string doc;
};

class PortTexts {
 public:
  /// `all`: the ports of the world.
  PortTexts(const language::Object& root, const simulation::Experiment& experiment,
            const std::vector<Port>& all)
      : root_(root), world_(experiment.world + ".") {
    // The numbers that only stand in the file come last.
    const std::size_t constants = experiment.values ? experiment.values->size() : 0;
    for (std::size_t i = all.size() - constants; i < all.size(); ++i)
      constants_.insert(all[i].value);
  }

  bool is_constant(const Port& port) const { return constants_.contains(port.value); }
  PortText of(const Port& port) {
    return {port.writable != nullptr ? "in"
            : is_constant(port)      ? "constant"
                                     : "out",
            port.doc.empty() ? doc_of(port.trail) : port.doc};
  }

 private:
  /// As the class of the object that the trail leads to has it.
  std::string doc_of(const std::string& trail) {
    for (const std::string& name : {trail, world_ + trail}) {
      language::Unresolved why;
      const auto target = names_.resolve(root_, name, true, why);
      if (target && target->field != nullptr) return target->field->doc;
    }
    return "";
  }

  const language::Object& root_;
  std::string world_;
  language::Names names_;
  std::set<const double*> constants_;
};

void print_json(const std::string& world, const std::vector<Port>& ports, PortTexts& texts) {
  text::JsonWriter json;
  json.begin_object().member("world", world).key("ports").begin_array();
  for (const Port& port : ports) {
    const PortText text = texts.of(port);
    json.begin_object().member("trail", port.trail).member("unit", port.unit);
    json.member("kind", text.kind).member("initial", *port.value).member("description", text.doc);
    json.end_object();
  }
  json.end_array().end_object();
  std::cout << json.text();
}

std::string value_text(const Port& port) {
  return std::isfinite(*port.value) ? text::rounded(*port.value, 6) : "none";
}

/// A line a number or vector, which `--record` takes as it stands there.
void print_table(const std::vector<Port>& ports, PortTexts& texts) {
  struct Line {
    std::string trail, unit, kind, value, doc;
  };
  std::vector<Line> lines;
  std::size_t trail_width = 0, value_width = 0, unit_width = 0;
  for (std::size_t i = 0; i < ports.size();) {
    const std::string whole(simulation::whole_of(ports[i].trail));
    const std::size_t first = i;
    std::string value = value_text(ports[i]);
    while (++i < ports.size() && !whole.empty() && simulation::whole_of(ports[i].trail) == whole)
      value += ", " + value_text(ports[i]);
    const std::string& trail = i > first + 1 ? whole : ports[first].trail;
    PortText text = texts.of(ports[first]);
    lines.push_back({trail, ports[first].unit, text.kind, std::move(value), std::move(text.doc)});
    trail_width = std::max(trail_width, trail.size());
    unit_width = std::max(unit_width, ports[first].unit.size());
    value_width = std::max(value_width, std::min<std::size_t>(lines.back().value.size(), 40));
  }
  for (const Line& line : lines) {
    std::string text =
        fmt::format("{:<{}}  {:<{}}  {:<8}  {:<{}}  {}", line.trail, trail_width, line.unit,
                    unit_width, line.kind, line.value, value_width, line.doc);
    text.erase(text.find_last_not_of(' ') + 1);
    std::cout << text << '\n';
  }
}

}  // namespace

int ports(const PortsArguments& arguments) {
  application::Application application(arguments.consent);
  const auto root =
      application.evaluate_set(application.locate(arguments.file), arguments.settings);
  if (!root) return wrong_input;
  const auto experiment = application.load(*root);
  if (!experiment) return wrong_input;
  try {
    simulation::World world(*experiment, application.make_engine(*experiment));
    const std::vector<Port> all = world.ports();
    auto found = simulation::find_ports(*experiment, all, arguments.pattern.value_or("**"));
    PortTexts texts(*root, *experiment, all);
    if (!arguments.pattern)
      std::erase_if(found, [&texts](const Port& port) { return texts.is_constant(port); });
    if (arguments.json) {
      print_json(experiment->world, found, texts);
    } else {
      print_table(found, texts);
    }
    return fine;
  } catch (const simulation::ExperimentError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
}

}  // namespace hookpoint::cli
