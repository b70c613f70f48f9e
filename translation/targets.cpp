#include "translation/targets.h"

#include <algorithm>
#include <array>
#include <iterator>

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

Wanted one_friction(double friction) {
  Wanted wanted;
  wanted.static_friction = wanted.kinetic_friction = friction;
  return wanted;
}

std::string one_friction_note(const Wanted& wanted) {
  return wanted.static_friction == wanted.kinetic_friction
             ? ""
             : "it has one coefficient of friction, here the kinetic one";
}

void add_note(std::vector<std::string>& notes, std::string note) {
  if (!note.empty()) notes.push_back(std::move(note));
}

}  // namespace hookpoint::translation
