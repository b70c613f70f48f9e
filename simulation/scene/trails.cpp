#include "simulation/scene/trails.h"

#include <fmt/format.h>

#include <set>

#include "contact/force_law.h"
#include "language/wording.h"

namespace hookpoint::simulation {
namespace {

using language::FieldType;

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
    std::string unique = trail;
    for (int n = 2; !taken_.insert(unique).second; ++n) unique = trail + "#" + std::to_string(n);
    return unique;
  }

  ObjectTrails trails_;
  std::set<std::string> taken_;
};

}  // namespace

ObjectTrails trails_of(const language::Object& root) { return Naming().run(root); }

std::string missing_port(const Experiment& experiment, const language::Object& object,
                         const language::FieldSchema& field) {
  const bool detail = !field.setting && (object.type == "ContactPoint" || object.type == "Chain");
  const bool peer = experiment.engine != "dts";
  // A peer publishes ContactPoints, but no hips.
  const bool published = peer ? object.type == "ContactPoint"
                              : contact::find_force_law(experiment.contact).has_value();
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
