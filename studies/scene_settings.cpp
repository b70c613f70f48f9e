#include "studies/scene_settings.h"

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
