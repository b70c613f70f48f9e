#include "simulation/scene/trails.h"

#include <fmt/format.h>

#include <unordered_map>
#include <unordered_set>

#include "contact/force_law.h"
#include "language/wording.h"
#include "simulation/scene/fixed_part.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {

using language::FieldType;

namespace {

class Naming {
 public:
  ObjectTrails run(const language::Object& root) {
    visit(root);
    return std::move(trails_);
  }

 private:
  void visit(const language::Object& parent) {
    for (const auto& object : parent.children) {
      trails_.emplace(object.get(), trail_for(*object));
      visit(*object);
    }
  }

  std::string trail_for(const language::Object& object) {
    std::string trail = object.trail();
    if (object.name.empty()) trail += (trail.empty() ? "" : ".") + object.type;
    if (taken_.insert(trail).second) return trail;
    // Numbers are given out in order, so that many objects without a name cost no search.
    int& last = last_numbers_.try_emplace(trail, 1).first->second;
    while (true) {
      std::string unique = trail + "#" + std::to_string(++last);
      if (taken_.insert(unique).second) return unique;
    }
  }

  ObjectTrails trails_;
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, int> last_numbers_;  ///< of trails that several objects have
};

}  // namespace

ObjectTrails trails_of(const language::Object& root) { return Naming().run(root); }

std::string missing_port(const Experiment& experiment, const language::Object& object,
                         const language::FieldSchema& field) {
  const auto of_body_contact = [&] {
    return field.name == "contact.moment" || field.name == "contact.center_of_pressure" ||
           field.name == "contact.normal_load" || field.name == "contact.tangential_load";
  };
  const auto of_surface_contact = [&] {
    const bool is_surface = object.type.starts_with("Terrain.") ||
                            (object.type.starts_with("Obstacle.") && !object.boolean("free"));
    return is_surface && field.name.starts_with("contact.");
  };
  const auto of_reaction = [&] {
    return field.name == "reaction_force" || field.name == "reaction_moment";
  };
  if (is_part(object) && (!field.setting || is_of_joint(field.name)))
    return fmt::format(
        "a {} is a part of the body that carries it and does not publish `{}`: read that body's",
        object.type == "Link" ? "Link whose joint is fixed" : "Chain whose joints are fixed",
        field.name);
  // It takes steps of its own between the instants whose forces it tells (wiring/energy_balance.h).
  const bool of_instants = experiment.engine == "simbody";
  if (field.name == "numerical_energy" && of_instants &&
      (experiment.terrain || !experiment.obstacles.empty()))
    return fmt::format(
        "engine {} does not tell what its ground does between the instants that it publishes, so that "
        "`{}` is not known: choose another engine",
        experiment.engine, field.name);
  const bool detail =
      !field.setting && (object.type == "ContactPoint" || object.type == "Chain" ||
                         of_body_contact() || of_surface_contact() || of_reaction());
  const bool peer = experiment.engine != "dts";
  // A peer publishes ContactPoints, but no hips.
  const bool published =
      peer ? object.type == "ContactPoint" : contact::find_force_law(experiment.contact) != nullptr;
  if (!detail || published) return "";
  return fmt::format(
      "{} {} does not publish `{}` of {}: choose engine dts and a force law, such "
      "as hookpoint",
      peer ? "engine" : "contact law", peer ? experiment.engine : experiment.contact, field.name,
      language::with_article(object.type));
}

bool is_number(const language::FieldSchema& field) {
  return field.type != FieldType::text && field.type != FieldType::choice &&
         field.type != FieldType::object && field.type != FieldType::port &&
         field.type != FieldType::words && field.type != FieldType::formula;
}

int components_of(const language::FieldSchema& field) {
  if (field.type == FieldType::orientation) return 4;
  return field.type == FieldType::numbers ? field.max_count : 1;
}

std::optional<NumberPort> find_number(const language::Object& from, const std::string& trail,
                                      const language::Position& place, language::Names& names,
                                      const ObjectTrails& trails, const Experiment& experiment,
                                      language::Diagnostics& diagnostics) {
  const auto fail = [&](const std::string& message) {
    diagnostics.error(place, message);
    return std::nullopt;
  };
  language::Unresolved why;
  const auto target = names.resolve(from, trail, true, why);
  if (!target) return fail(fmt::format("`{}`: {}", trail, why.message));
  if (target->field == nullptr || !is_number(*target->field))
    return fail(fmt::format("`{}` is no number that could be recorded", trail));
  const auto object = trails.find(target->object);
  if (object == trails.end()) return fail(fmt::format("`{}` has no value in a run", trail));
  const std::string lacking = missing_port(experiment, *target->object, *target->field);
  if (!lacking.empty()) return fail(lacking);
  return NumberPort{*target, object->second + "." + target->port};
}

}  // namespace hookpoint::simulation
