#include "apps/view/session/description.h"

#include <algorithm>

#include "apps/view/widgets/scene.h"

namespace hookpoint::view {
namespace {

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::run:
      return "run";
    case Kind::movie:
      return "movie";
    case Kind::film:
      return "film";
  }
  return "";
}

double value_of(const std::vector<simulation::Port>& ports, const std::string& trail) {
  return *std::ranges::find(ports, trail, &simulation::Port::trail)->value;
}

}  // namespace

std::string describe(Kind kind, const std::string& title, const Panel& panel,
                     const Subjects& subjects, const std::vector<simulation::Port>& ports,
                     bool holds) {
  Described described{subjects.run().experiment(), subjects.run().no_history(), {}, {}};
  for (const Subject& subject : subjects.all())
    described.subjects.emplace_back(subject.name, subject.colour);
  described.pull = {value_of(ports, "Simulator.pull.stiffness"),
                    value_of(ports, "Simulator.pull.damping")};
  described.holds = holds;
  return describe(kind, title, panel, described);
}

std::string describe(Kind kind, const std::string& title, const Panel& panel,
                     const Described& described) {
  const simulation::Experiment& experiment = described.experiment;
  const std::string& no_history = described.no_history;
  text::JsonWriter json;
  json.begin_object().member("tell", "description").member("protocol", 1);
  json.member("version", HOOKPOINT_VERSION).member("title", title).member("kind", name_of(kind));
  json.member("world", experiment.world).member("deltat", experiment.deltat);
  json.member("duration", experiment.duration)
      .member("holds", described.holds)
      .member("engine", experiment.engine);
  json.member("law", experiment.contact).member("integrator", experiment.integrator);
  json.key("history").begin_object();
  json.member("possible", no_history.empty()).member("why", no_history).end_object();
  json.key("windows");
  write_panel(panel, json);
  json.key("scene");
  write_scene(make_scene(experiment), json);
  json.key("subjects").begin_array();
  for (const auto& [name, colour] : described.subjects)
    json.begin_object().member("name", name).member("colour", colour).end_object();
  json.end_array();
  json.key("pull").begin_object().member("stiffness", described.pull.stiffness);
  json.member("damping", described.pull.damping).end_object();
  if (described.film != nullptr) {
    json.key("film");
    write_film(*described.film, json);
  }
  return json.end_object().text();
}

}  // namespace hookpoint::view
