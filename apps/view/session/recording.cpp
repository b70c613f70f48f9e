#include "apps/view/session/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "apps/view/session/film.h"
#include "apps/view/wire/base64.h"
#include "apps/view/wire/value_layout.h"
#include "simulation/wiring/port_search.h"
#include "text/json.h"

namespace hookpoint::view {
namespace {

/// What is before the script of the page, which reads it as the page begins.
constexpr std::string_view body = "<body>";

/// Time, and trails of the windows and of the patterns, each once. Throws simulation::ExperimentError.
std::vector<std::string> trails_of(const Shown& shown, const RecordingRequest& request,
                                   const simulation::Experiment& experiment,
                                   const std::vector<simulation::Port>& ports) {
  std::vector<std::string> trails;
  std::set<std::string> known;
  const auto add = [&](const std::string& trail) {
    if (known.insert(trail).second) trails.push_back(trail);
  };
  add(experiment.world + ".time");
  for (const auto* list : {&shown.trails, &shown.plotted})
    for (const std::string& trail : *list) add(trail);
  if (!request.further.empty())
    for (const simulation::Port& port :
         simulation::find_all_ports(experiment, ports, request.further))
      add(port.trail);
  return trails;
}

void write_ports(const std::vector<std::string>& trails, const simulation::Experiment& experiment,
                 const std::vector<simulation::Port>& ports, text::JsonWriter& json) {
  json.begin_array();
  for (const std::string& trail : trails) {
    const auto port = simulation::look_up_port(experiment, ports, trail);
    if (!port) continue;
    json.begin_object().member("trail", port->trail).member("unit", port->unit);
    json.member("doc", port->doc).end_object();
  }
  json.end_array();
}

}  // namespace

std::string recording_page(const ShownMovie& movie, std::string_view page,
                           const RecordingRequest& request) {
  Reel reel(movie);
  std::vector<simulation::Port> ports = reel.world().ports();
  const Shown shown = request.describe(ports);
  const std::vector<std::string> trails = trails_of(shown, request, movie.experiment, ports);

  ValueLayout layout;
  std::string layout_text, instants;
  text::JsonWriter sizes;
  sizes.begin_array();
  std::uint64_t generation = reel.generation() + 1;
  SessionState state;
  for (const std::int64_t step : request.steps) {
    reel.aim(step);
    if (generation != reel.generation()) {
      generation = reel.generation();
      ports = reel.world().ports();
      layout.lay_out(trails, movie.experiment, ports);
      if (layout_text.empty()) layout_text = layout.text();
    }
    while (!reel.there()) reel.go_on();
    ++state.number;
    state.layout = 1;
    const SubjectState subject = reel.moment(state);
    const auto instant = encode_snapshot(state, layout.read(), std::span(&subject, 1));
    const std::size_t whole = instant->size() * request.steps.size() / 3 * 4;
    if (whole > most_bytes_of_page)
      throw FilmError(
          fmt::format("the page would have {} MB, more than {}: choose a part of the movie with "
                      "--from and --to, a lower --fps, or less with --record",
                      whole >> 20, most_bytes_of_page >> 20));
    instants += *instant;
    sizes.value(static_cast<std::int64_t>(instant->size()));
    if (!request.go_on()) return "";
  }
  text::JsonWriter json;
  json.begin_object().key("ports");
  write_ports(trails, movie.experiment, ports, json);
  json.end_object();
  const auto line = [](std::string_view bytes) { return to_base64(bytes) + "\n"; };
  std::string all{page};
  const std::size_t at = all.find(body) + body.size();
  all.insert(at, "\n<script type=\"text/plain\" id=\"recording\">\n" + line(shown.description) +
                     line(layout_text) + line(json.text()) + line(sizes.end_array().text()) +
                     line(instants) + "</script>");
  return all;
}

}  // namespace hookpoint::view
