#include "reference/experiment_checks.h"

#include <string>

namespace hookpoint::reference {
namespace {

[[noreturn]] void refuse(std::string_view engine, const std::string& what) {
  throw simulation::ExperimentError("engine " + std::string(engine) + ": " + what);
}

void check_robot(const simulation::RobotSpec& robot, bool on_terrain, std::string_view engine) {
  const std::string name = "robot '" + robot.name + "'";
  if (!robot.chains.empty())
    refuse(engine, name + " has chains; this engine runs single rigid bodies only, use engine dts");
  if (!robot.mobile) return;
  if (!(robot.base.mass.mass > 0.)) refuse(engine, name + " is mobile and needs a mass above 0");
  if (on_terrain && robot.base.shapes.empty())
    refuse(engine, name + " has no shape; contact points alone do not collide in this engine");
}

void check_terrain(const simulation::TerrainSpec& terrain, std::string_view engine) {
  const std::string problem = contact::Terrain::problem(terrain);
  if (!problem.empty()) refuse(engine, "terrain '" + terrain.name + "': " + problem);
  if (!terrain.patches.empty())
    refuse(engine,
           "terrain '" + terrain.name +
               "' has patches; materials of single tiles are not supported, use one material");
}

void check_material(const simulation::MaterialSpec& material, std::string_view engine) {
  const auto& constants = material.constants;
  if (constants.static_friction != constants.kinetic_friction)
    refuse(engine,
           "material '" + material.name +
               "' has different static and kinetic friction; this engine has one coefficient, "
               "set them equal");
}

}  // namespace

void check_supported(const simulation::Experiment& experiment, std::string_view engine) {
  if (!(experiment.deltat > 0.)) refuse(engine, "deltat must be above 0");
  for (const auto& robot : experiment.robots)
    check_robot(robot, experiment.terrain.has_value(), engine);
  for (const auto& force : experiment.forces)
    if (force.body != 0) refuse(engine, "force '" + force.name + "' acts on a link");
  if (!experiment.terrain) return;
  check_terrain(*experiment.terrain, engine);
  const auto index = static_cast<std::size_t>(experiment.terrain->material);
  if (index < experiment.materials.size()) check_material(experiment.materials[index], engine);
}

contact::MaterialConstants<double> ground_material(const simulation::Experiment& experiment) {
  if (!experiment.terrain) return {};
  const auto index = static_cast<std::size_t>(experiment.terrain->material);
  return index < experiment.materials.size() ? experiment.materials[index].constants
                                             : contact::MaterialConstants<double>{};
}

}  // namespace hookpoint::reference
