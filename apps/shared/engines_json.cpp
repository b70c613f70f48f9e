#include "apps/shared/engines_json.h"

#include "contact/force_law.h"
#include "integrators/stepper.h"
#include "text/json.h"

namespace hookpoint::application {
namespace {

std::string handling_name(simulation::EngineGap::Handling handling) {
  using enum simulation::EngineGap::Handling;
  return handling == refused ? "refused" : handling == noticed ? "noticed" : "stated";
}

}  // namespace

std::string engines_json(const Application& application) {
  text::JsonWriter json;
  json.begin_object().key("engines").begin_array();
  for (const auto& [name, engine] : application.engines()) {
    const simulation::EngineDescription d = engine.describe();
    json.begin_object()
        .member("name", d.name)
        .member("version", d.version)
        .member("precision", d.precision)
        .member("found", d.found)
        .member("missing", d.missing)
        .member("program", d.program);
    json.key("settings").begin_array();
    for (const std::string& setting : d.settings) json.value(setting);
    json.end_array().key("gaps").begin_array();
    for (const simulation::EngineGap& gap : d.gaps) {
      json.begin_object()
          .member("feature", gap.feature)
          .member("handling", handling_name(gap.handling))
          .member("instead", gap.instead)
          .end_object();
    }
    json.end_array().end_object();
  }
  json.end_array().key("laws").begin_array();
  for (const contact::LawDescription& law : contact::law_table()) {
    json.begin_object()
        .member("name", law.name)
        .member("doc", law.summary)
        .member("source", law.source)
        .end_object();
  }
  json.end_array().key("integrators").begin_array();
  for (const integrators::StepperDescription& stepper : integrators::stepper_table()) {
    json.begin_object()
        .member("name", stepper.name)
        .member("order", stepper.order)
        .member("doc", stepper.summary)
        .end_object();
  }
  json.end_array().end_object();
  return json.text();
}

}  // namespace hookpoint::application
