#include "studies/plan/scene_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hookpoint::studies {

std::string first_name(const std::string& trail) { return trail.substr(0, trail.find('.')); }

std::vector<language::Override> settings_of_scene(const SceneSettings& settings,
                                                  const std::vector<std::string>& parameters,
                                                  const language::Object& scene,
                                                  const std::string& world) {
  std::vector<language::Override> taken;
  for (const language::Override& setting : settings.trails) {
    const std::string first = first_name(setting.trail);
    const bool has_object = std::ranges::any_of(
        scene.children, [&](const auto& child) { return child->name == first; });
    if (has_object || std::ranges::find(parameters, setting.trail) != parameters.end())
      taken.push_back(setting);
  }
  for (const auto& [field, value] : settings.world) taken.push_back({world + "." + field, value});
  return taken;
}

std::vector<std::string> setting_words(const language::EvaluateOptions& options) {
  std::vector<std::string> words;
  for (const auto& [parameter, value] : options.parameters)
    words.push_back(parameter + "=" + value);
  for (const language::Override& setting : options.overrides)
    words.push_back(setting.trail + "=" + setting.value);
  return words;
}

namespace {

/// The field of that trail from the top; null where there is none. The names of an object and of a
/// field may both hold dots.
const language::Field* field_at(const language::Object& scene, const std::string& trail) {
  for (std::size_t dot = trail.rfind('.'); dot != std::string::npos && dot > 0;
       dot = trail.rfind('.', dot - 1)) {
    language::Diagnostics untold;
    const auto owner = language::resolve(scene, trail.substr(0, dot), false, untold);
    if (owner) return owner->object->find(trail.substr(dot + 1));
  }
  return nullptr;
}

bool same_in_both(const language::Field* one, const language::Field* other) {
  if (one == nullptr || other == nullptr) return one == other;
  return one->numbers == other->numbers && one->words == other->words &&
         one->reference.trail == other->reference.trail;
}

}  // namespace

const language::Override* changed_setting(const std::vector<language::Override>& settings,
                                          const language::Object& one,
                                          const language::Object& other) {
  const auto changed = std::ranges::find_if(settings, [&](const language::Override& setting) {
    return !same_in_both(field_at(one, setting.trail), field_at(other, setting.trail));
  });
  return changed == settings.end() ? nullptr : &*changed;
}

std::string decided_already(const language::Override& setting) {
  return fmt::format("the study decides of `{}`: it cannot be set as well", setting.trail);
}

std::optional<std::string> setting_problem(const language::Override& setting,
                                           const std::string& world, const SubjectPlan& subject) {
  const std::array<std::pair<const char*, const std::string*>, 4> own{
      {{"engine", &subject.engine},
       {"contact", &subject.contact},
       {"integrator", &subject.integrator},
       {"settings", &subject.settings}}};
  for (const auto& [field, value] : own) {
    if (!value->empty() && setting.trail == world + "." + field)
      return fmt::format("subject {} says its {} itself: `{}` cannot be set as well",
                         subject.info.name, field, setting.trail);
  }
  for (const Assignment& fix : subject.fixes) {
    if (fix.parameter == setting.trail)
      return fmt::format("subject {} fixes `{}`: it cannot be set as well", subject.info.name,
                         fix.parameter);
  }
  return std::nullopt;
}

}  // namespace hookpoint::studies
