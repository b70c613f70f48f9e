#include "reference/experiment_checks.h"

#include <algorithm>
#include <variant>

#include "reference/restitution_gap.h"
#include "reference/touching_points.h"

namespace hookpoint::reference {
namespace {

using simulation::EngineGap;

[[noreturn]] void refuse(std::string_view engine, const std::string& what) {
  throw simulation::ExperimentError("engine " + std::string(engine) + ": " + what);
}

bool positive_definite(const Symmetric3d& a) {
  const double minor = a.xx * a.yy - a.xy * a.xy;
  const double determinant =
      a.zz * minor - a.xx * a.yz * a.yz - a.yy * a.xz * a.xz + 2. * a.xy * a.xz * a.yz;
  return a.xx > 0. && minor > 0. && determinant > 0.;
}

void add_inertia(const simulation::BodySpec& body, const std::string& name,
                 std::vector<FeatureUse>& uses) {
  if (body.mass.mass > 0. && !positive_definite(body.mass.inertia))
    uses.push_back({feature::no_inertia, name + " has no inertia about some axis"});
}

void add_robot(const simulation::Experiment& experiment, int index, std::vector<FeatureUse>& uses) {
  const simulation::RobotSpec& robot = experiment.robots[static_cast<std::size_t>(index)];
  const std::string name = "robot '" + robot.name + "'";
  if (!robot.chains.empty()) uses.push_back({feature::chains, name + " has chains"});
  if (robot.mobile) add_inertia(robot.base, name, uses);
  if (robot.plane_normal) uses.push_back({feature::planar, name + " has a Base.planar"});
  for (const simulation::ChainSpec& chain : robot.chains)
    for (const simulation::LinkSpec& link : chain.links) {
      const std::string joint = name + ", joint of " + chain.name + "." + link.body.name;
      if (link.joint == simulation::JointKind::prismatic)
        uses.push_back({feature::prismatic, joint + " is prismatic"});
      if (!(link.body.mass.mass > 0.))
        uses.push_back({feature::massless, joint + " carries no mass"});
      add_inertia(link.body, "link " + chain.name + "." + link.body.name + " of " + name, uses);
      if (link.lower_limit || link.upper_limit)
        uses.push_back({feature::joint_limits, joint + " has a limit"});
      if (link.rotor_inertia > 0.)
        uses.push_back({feature::rotors, joint + " has a rotor_inertia"});
    }
  if (touches_by_points(experiment, index)) {
    uses.push_back({feature::points, name + " touches by its boundary points"});
    return;
  }
  for (const simulation::ShapeSpec& shape : robot.base.shapes) {
    if (std::holds_alternative<simulation::Legcone>(shape.geometry))
      uses.push_back({feature::legcone, name + " has a Legcone"});
    if (std::holds_alternative<simulation::Cylinder>(shape.geometry))
      uses.push_back({feature::cylinder, name + " has a Cylinder"});
  }
}

void add_material(const simulation::Experiment& experiment, int index,
                  std::vector<FeatureUse>& uses) {
  if (static_cast<std::size_t>(index) >= experiment.materials.size()) return;
  const simulation::MaterialSpec& material = experiment.materials[static_cast<std::size_t>(index)];
  const std::string name = "material '" + material.name + "'";
  if (material.constants.static_friction != material.constants.kinetic_friction)
    uses.push_back({feature::two_frictions, name + " has different static and kinetic friction"});
  if (material.constants.restitution > 0.) {
    uses.push_back({feature::restitution, name + " has a restitution"});
    if (experiment.settings == "matched")
      uses.push_back({feature::matched_restitution, name + " has a restitution"});
  }
}

void add_patch(const simulation::Experiment& experiment, int patch, std::vector<FeatureUse>& uses) {
  const auto own = material_at(experiment, patch);
  const auto ground = ground_material(experiment);
  const std::string name = "a patch of terrain '" + experiment.terrain->name + "'";
  if (own.static_friction != ground.static_friction ||
      own.kinetic_friction != ground.kinetic_friction)
    uses.push_back({feature::tile_friction, name + " has a friction of its own"});
  if (own.normal_stiffness != ground.normal_stiffness ||
      own.normal_damping != ground.normal_damping ||
      own.tangential_stiffness != ground.tangential_stiffness ||
      own.tangential_damping != ground.tangential_damping)
    uses.push_back(
        {experiment.settings == "matched" ? feature::tile_softness : feature::unmatched_softness,
         name + " has a stiffness or damping of its own"});
  if (own.restitution != ground.restitution)
    uses.push_back({feature::tile_restitution, name + " has a restitution of its own"});
}

void check_robot(const simulation::Experiment& experiment, int index, std::string_view engine) {
  const simulation::RobotSpec& robot = experiment.robots[static_cast<std::size_t>(index)];
  const std::string name = "robot '" + robot.name + "'";
  if (robot.mobile && !(robot.base.mass.mass > 0.))
    refuse(engine, name + " is mobile and needs a mass above 0");
  if (!experiment.terrain || !robot.chains.empty() || !robot.mobile) return;
  if (robot.base.shapes.empty() && robot.base.boundary_points.empty())
    refuse(engine, name + " has no shape and no ContactPoint: nothing of it meets the ground");
}

}  // namespace

std::vector<FeatureUse> features_used(const simulation::Experiment& experiment) {
  std::vector<FeatureUse> uses;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i)
    add_robot(experiment, static_cast<int>(i), uses);
  if (!experiment.terrain) return uses;
  const simulation::TerrainSpec& terrain = *experiment.terrain;
  if (std::holds_alternative<simulation::GridSpec>(terrain.surface))
    uses.push_back({feature::height_field, "terrain '" + terrain.name + "' is a grid of heights"});
  add_material(experiment, terrain.material, uses);
  for (const simulation::PatchSpec& patch : terrain.patches) {
    add_material(experiment, patch.material, uses);
    add_patch(experiment, patch.material, uses);
  }
  return uses;
}

std::vector<EngineGap> common_gaps_and(std::span<const OwnGap> own) {
  using enum EngineGap::Handling;
  std::vector<EngineGap> gaps = {
      {std::string(feature::law), stated,
       "the engine has its own; `contact` and `integrator` are not read, and a material's "
       "stiffness "
       "and damping only at `settings = matched`"},
      {std::string(feature::unmatched_softness), noticed,
       "without `settings = matched` the engine gives all ground the softness of its own"},
      {std::string(feature::hips), refused, "choose engine dts"},
      {std::string(feature::saving), refused,
       "the library keeps to itself what its solver remembers; choose engine dts"},
  };
  for (const OwnGap& gap : own)
    gaps.push_back({std::string(gap.feature), gap.handling, gap.instead});
  return gaps;
}

std::vector<std::string> check_supported(const simulation::Experiment& experiment,
                                         const simulation::EngineDescription& engine) {
  if (!(experiment.deltat > 0.)) refuse(engine.name, "deltat must be above 0");
  for (std::size_t i = 0; i < experiment.robots.size(); ++i)
    check_robot(experiment, static_cast<int>(i), engine.name);
  if (experiment.terrain) {
    const std::string problem = contact::Terrain::problem(*experiment.terrain);
    if (!problem.empty())
      refuse(engine.name, "terrain '" + experiment.terrain->name + "': " + problem);
  }
  std::vector<std::string> notices;
  for (const FeatureUse& use : features_used(experiment)) {
    const auto gap = std::ranges::find(engine.gaps, use.feature, &EngineGap::feature);
    if (gap == engine.gaps.end() || gap->handling == EngineGap::Handling::stated) continue;
    if (gap->handling == EngineGap::Handling::refused)
      refuse(engine.name, use.where + "; " + gap->instead);
    std::string notice = "engine " + engine.name + ": " + use.where + "; " + gap->instead;
    if (std::ranges::find(notices, notice) == notices.end()) notices.push_back(std::move(notice));
  }
  return notices;
}

contact::MaterialConstants<double> material_at(const simulation::Experiment& experiment,
                                               int material) {
  const auto index = static_cast<std::size_t>(material);
  return index < experiment.materials.size() ? experiment.materials[index].constants
                                             : contact::MaterialConstants<double>{};
}

contact::MaterialConstants<double> ground_material(const simulation::Experiment& experiment) {
  return experiment.terrain ? material_at(experiment, experiment.terrain->material)
                            : contact::MaterialConstants<double>{};
}

}  // namespace hookpoint::reference
