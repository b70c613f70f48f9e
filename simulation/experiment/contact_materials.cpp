#include "simulation/experiment/contact_materials.h"

#include <algorithm>
#include <set>

#include "contact/combination.h"
#include "simulation/experiment/material_fields.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

using Constants = contact::MaterialConstants<double>;

/// Materials of what may touch.
std::set<int> foot_materials(const Experiment& experiment) {
  std::set<int> used{no_material};
  for (const RobotSpec& robot : experiment.robots) {
    for_each_body(robot, [&](const BodySpec& body) {
      used.insert(body.boundary_materials.begin(), body.boundary_materials.end());
      for (const ShapeSpec& shape : body.shapes) used.insert(shape.material);
    });
  }
  // Of two obstacles or of two bodies one is the foot.
  for (const ObstacleSpec& obstacle : experiment.obstacles) used.insert(obstacle.material);
  return used;
}

bool states(const MaterialSpec& material, double Constants::*constant) {
  return std::ranges::find(material.unstated, constant) == material.unstated.end();
}

}  // namespace

Constants contact_constants(const Experiment& experiment, int foot, int ground) {
  const auto material = [&](int index) -> const MaterialSpec& {
    return experiment.materials[static_cast<std::size_t>(index)];
  };
  if (foot == no_material && ground == no_material) return {};
  if (foot == no_material) return material(ground).constants;
  if (ground == no_material) return material(foot).constants;
  for (const PairSpec& pair : experiment.pairs) {
    if ((pair.a == foot && pair.b == ground) || (pair.a == ground && pair.b == foot))
      return material(pair.material).constants;
  }
  const MaterialSpec &of_foot = material(foot), &of_ground = material(ground);
  Constants made = contact::combine(of_foot.constants, of_ground.constants, experiment.combine);
  for (const MaterialField& field : material_fields()) {
    const bool foot_states = states(of_foot, field.member);
    if (!states(of_ground, field.member))
      made.*field.member = of_foot.constants.*field.member;
    else if (!foot_states)
      made.*field.member = of_ground.constants.*field.member;
  }
  return made;
}

ContactMaterials::ContactMaterials(const Experiment& experiment)
    : unstated_(experiment.terrain             ? experiment.terrain->material
                : experiment.materials.empty() ? no_material
                                               : 0),
      rows_(experiment.materials.size() + 1) {
  const int count = static_cast<int>(experiment.materials.size());
  for (const int foot : foot_materials(experiment)) {
    rows_[place(foot)] = table_.size();
    for (int ground = no_material; ground < count; ++ground)
      table_.push_back(contact_constants(experiment, foot, ground));
  }
}

}  // namespace hookpoint::simulation
