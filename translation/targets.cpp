#include "translation/targets.h"

#include <algorithm>
#include <array>

namespace hookpoint::translation {

std::span<const Target* const> targets() {
  static const std::array all{
      &mujoco_target,  &bullet_target, &pybullet_target,
      &ode_target,     &gazebo_target, &dart_target,
      &simbody_target, &drake_target,  &drake_hydroelastic_target,
      &newton_target,  &physx_target,  &genesis_target,
      &raisim_target,
  };
  return all;
}

const Target* find_target(std::string_view name) {
  const auto found = std::ranges::find(targets(), name, &Target::name);
  return found == targets().end() ? nullptr : *found;
}

std::vector<std::string> notes_on_friction(const DesiredContact& desired) {
  if (desired.static_friction == desired.kinetic_friction) return {};
  return {"it has one coefficient of friction, here the kinetic one"};
}

}  // namespace hookpoint::translation
