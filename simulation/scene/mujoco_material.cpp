// The constants of a Material that states MuJoCo's parameters: those of a spring and damper that stand
// and rebound as MuJoCo's contact does under the load at the start.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "contact/mujoco_contact.h"
#include "contact/predictions.h"
#include "simulation/analysis/carried_load.h"
#include "simulation/analysis/inverse_weight.h"
#include "simulation/engine_interface/engine.h"
#include "simulation/experiment/contact_materials.h"
#include "simulation/experiment/ground.h"
#include "simulation/experiment/robot_tree.h"
#include "simulation/scene/load_parts.h"
#include "text/number.h"

namespace hookpoint::simulation {
namespace {

using Constants = contact::MaterialConstants<double>;

/// Those that a row decides.
constexpr std::array decided{&Constants::normal_stiffness, &Constants::normal_damping,
                             &Constants::tangential_stiffness, &Constants::tangential_damping};

/// The first body of the robot that touches with the material.
std::optional<std::size_t> body_with(const RobotSpec& robot, int material) {
  const auto bodies = bodies_of(robot);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodySpec& body = *bodies[i];
    const bool in_shape = std::ranges::any_of(
        body.shapes, [&](const ShapeSpec& shape) { return shape.material == material; });
    if (in_shape || std::ranges::count(body.boundary_materials, material) > 0) return i;
  }
  return std::nullopt;
}

/// Where a robot stands on the material, or with it.
struct Standing {
  std::size_t robot = 0;
  bool carries = false;  ///< the material is of what touches at the start
  contact::MujocoLoading loading;
};
std::optional<Standing> standing_on(const Experiment& experiment, const contact::Terrain& terrain,
                                    int material) {
  const WorldInputs inputs = initial_inputs(experiment);
  for (std::size_t robot = 0; robot < experiment.robots.size(); ++robot) {
    const auto with = body_with(experiment.robots[robot], material);
    for (const CarriedLoad& carried : carried_loads(experiment, robot, terrain, inputs)) {
      if (!with && carried.material != material) continue;
      if (!(carried.load > 0.)) continue;
      const Constants constants =
          contact_constants(experiment, with ? material : carried.foot, carried.material);
      return Standing{robot,
                      carried.foot == material || carried.material == material,
                      {carried.load, carried.mass,
                       inverse_weight(experiment, robot, with.value_or(carried.body)),
                       constants.kinetic_friction, experiment.deltat}};
    }
  }
  return std::nullopt;
}

std::string in_words(const MaterialSpec& material, const Standing& standing,
                     const std::string& robot, const contact::MujocoSpring& spring) {
  const contact::MujocoContact& stated = *material.mujoco;
  const contact::MujocoLoading& at = standing.loading;
  constexpr double slope = 10. * std::numbers::pi / 180.;
  return fmt::format(
      "Material {}: solref {:g}, {:g} under {} ({} N and {} kg on each contact) is {} "
      "N/m and {} N s/m; depth {:.4g} mm, rebound {:.3g}; in MuJoCo it creeps at {:.4g} mm/s on "
      "10 deg",
      material.name, stated.row.reference[0], stated.row.reference[1], robot,
      text::rounded(at.load), text::rounded(at.mass), text::rounded(spring.stiffness),
      text::rounded(spring.damping), 1e3 * spring.depth,
      contact::kelvin_voigt_restitution(spring.damping_ratio),
      1e3 * mujoco_creep(stated.row, stated.friction, at, spring.depth, slope));
}

}  // namespace

void complete_mujoco_materials(bool automatic, Loading& loading) {
  Experiment& experiment = loading.experiment;
  const auto states = [](const MaterialSpec& material) { return material.mujoco.has_value(); };
  if (std::ranges::none_of(experiment.materials, states)) return;
  const auto terrain = make_ground(experiment);
  Experiment standing_still = experiment;
  standing_still.engine = "dts";
  standing_still.contact = "hookpoint";
  if (automatic) standing_still.deltat = 0.;
  std::vector<const language::Object*> objects(experiment.materials.size());
  for (const auto& [object, index] : loading.materials)
    objects[static_cast<std::size_t>(index)] = object;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    MaterialSpec& material = experiment.materials[i];
    if (!material.mujoco) continue;
    const auto is_unstated = [&](double Constants::*constant) {
      return std::ranges::count(material.unstated, constant) > 0;
    };
    if (std::ranges::none_of(decided, is_unstated)) continue;
    const auto standing =
        terrain ? standing_on(standing_still, *terrain, static_cast<int>(i)) : std::nullopt;
    if (!standing && experiment.settings == "file") continue;
    if (!standing) {
      loading.diagnostics.warning(
          objects[i]->position,
          fmt::format("no robot stands on or with Material {}: its solref has no load from which a "
                      "stiffness follows; state normal_stiffness and normal_damping",
                      material.name));
      continue;
    }
    const contact::MujocoSpring spring =
        mujoco_spring(material.mujoco->row, material.mujoco->friction, standing->loading);
    if (!std::isfinite(spring.stiffness) || !std::isfinite(spring.damping) ||
        !(spring.stiffness > 0.)) {
      loading.error(objects[i]->position,
                    fmt::format("solref and solimp of Material {} give no stiffness within the "
                                "range of numbers under {} N",
                                material.name, text::rounded(standing->loading.load)));
      continue;
    }
    const std::array values{spring.stiffness, spring.damping, spring.stiffness, spring.damping};
    for (std::size_t k = 0; k < decided.size(); ++k) {
      if (!is_unstated(decided[k])) continue;
      material.constants.*decided[k] = values[k];
      std::erase(material.unstated, decided[k]);
    }
    if (!standing->carries) continue;
    loading.diagnostics.note(
        objects[i]->position,
        in_words(material, *standing, experiment.robots[standing->robot].name, spring));
  }
}

}  // namespace hookpoint::simulation
