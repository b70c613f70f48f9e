#include "reference/mujoco_materials.h"

#include <fmt/format.h>

#include <optional>

#include "simulation/engine_interface/engine.h"

namespace hookpoint::reference {

contact::MujocoRow mujoco_row_of(const simulation::Experiment& experiment, int foot, int ground) {
  const auto stated = [&](int material) -> std::optional<contact::MujocoRow> {
    if (material == simulation::no_material) return std::nullopt;
    const auto& mujoco = experiment.materials[static_cast<std::size_t>(material)].mujoco;
    return mujoco ? std::optional(mujoco->row) : std::nullopt;
  };
  for (const simulation::PairSpec& pair : experiment.pairs)
    if ((pair.a == foot && pair.b == ground) || (pair.a == ground && pair.b == foot))
      return stated(pair.material).value_or(contact::MujocoRow{});
  const auto of_foot = stated(foot), of_ground = stated(ground);
  if (of_foot && of_ground) return contact::mujoco_mixed(*of_foot, *of_ground);
  return of_foot ? *of_foot : of_ground.value_or(contact::MujocoRow{});
}

contact::MujocoFriction mujoco_friction_of(const simulation::Experiment& experiment) {
  const simulation::MaterialSpec* first = nullptr;
  for (const simulation::MaterialSpec& material : experiment.materials) {
    if (!material.mujoco) continue;
    if (first == nullptr) first = &material;
    if (material.mujoco->friction == first->mujoco->friction) continue;
    throw simulation::ExperimentError(
        fmt::format("MuJoCo has one cone and one impratio for all contacts, and the Materials {} "
                    "and {} state different ones",
                    first->name, material.name));
  }
  return first == nullptr ? contact::MujocoFriction{} : first->mujoco->friction;
}

}  // namespace hookpoint::reference
