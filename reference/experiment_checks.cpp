#include "reference/experiment_checks.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>
#include <variant>

#include "contact/laws/surface_forces.h"
#include "reference/ground.h"
#include "reference/pair_materials.h"
#include "reference/restitution_gap.h"
#include "reference/touching_points.h"
#include "simulation/experiment/robot_tree.h"

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
  simulation::for_each_body(robot, [&](const simulation::BodySpec& body) {
    if (!robot.mobile && &body == &robot.base) return;
    if (!touching_points(experiment, body, 0).empty())
      uses.push_back({feature::points, name + " touches by boundary points"});
    for (const simulation::ShapeSpec* shape : touching_shapes(experiment, body))
      if (const std::string_view lacked = feature_of(shape->geometry); !lacked.empty())
        uses.push_back({lacked, name + " has " + std::string(lacked)});
  });
}

void add_material(const simulation::Experiment& experiment, int index,
                  std::vector<FeatureUse>& uses) {
  if (static_cast<std::size_t>(index) >= experiment.materials.size()) return;
  const simulation::MaterialSpec& material = experiment.materials[static_cast<std::size_t>(index)];
  const std::string name = "material '" + material.name + "'";
  if (material.constants.static_friction != material.constants.kinetic_friction)
    uses.push_back({feature::two_frictions, name + " has different static and kinetic friction"});
  if (contact::acts_beside_the_law(material.constants))
    uses.push_back({feature::surface_forces,
                    name + " has adhesion, resistance to rolling or spinning, or friction_across"});
  if (material.constants.restitution > 0.) {
    uses.push_back({feature::restitution, name + " has a restitution"});
    if (experiment.settings == "matched")
      uses.push_back({feature::matched_restitution, name + " has a restitution"});
  }
}

void add_patch(const simulation::Experiment& experiment, int patch, std::vector<FeatureUse>& uses) {
  const auto own = material_at(experiment, patch);
  const auto ground = material_at(experiment, experiment.terrain->material);
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
  if (touching_shapes(experiment, robot.base).empty() &&
      touching_points(experiment, robot.base, 0).empty())
    refuse(engine, name + " has no shape and no ContactPoint" +
                       (robot.base.shapes.empty() ? "" : " that this engine has") +
                       ": nothing of it meets the ground");
}

/// Materials of all that may touch, no_material among them where something has none.
std::set<int> foot_materials(const simulation::Experiment& experiment) {
  std::set<int> feet;
  for (const simulation::RobotSpec& robot : experiment.robots)
    simulation::for_each_body(robot, [&](const simulation::BodySpec& body) {
      for (std::size_t i = 0; i < body.boundary_points.size(); ++i)
        feet.insert(body.boundary_material(i));
      for (const simulation::ShapeSpec& shape : body.shapes) feet.insert(shape.material);
    });
  return feet;
}

bool has(const std::vector<FeatureUse>& uses, std::string_view feature) {
  return std::ranges::find(uses, feature, &FeatureUse::feature) != uses.end();
}

/// Whether in engine dts bodies of two robots, or of one with itself, would touch.
bool robots_may_meet(const simulation::Experiment& experiment) {
  const auto touches = [](const simulation::RobotSpec& robot) {
    bool any = false;
    simulation::for_each_body(
        robot, [&](const simulation::BodySpec& body) { any |= !body.boundary_points.empty(); });
    return any;
  };
  return experiment.touch == "shapes" &&
         (std::ranges::count_if(experiment.robots, touches) > 1 ||
          std::ranges::any_of(experiment.robots, &simulation::RobotSpec::self_contact));
}

}  // namespace

std::string_view feature_of(const simulation::ShapeGeometry& geometry) {
  if (std::holds_alternative<simulation::Legcone>(geometry)) return feature::legcone;
  if (std::holds_alternative<simulation::Capsule>(geometry)) return feature::capsule;
  if (std::holds_alternative<simulation::Hull>(geometry)) return feature::hull;
  if (const auto* cylinder = std::get_if<simulation::Cylinder>(&geometry))
    return cylinder->length == 0. ? feature::disc : feature::cylinder;
  return {};
}

simulation::Experiment with_samples(simulation::Experiment experiment,
                                    const simulation::EngineDescription& engine) {
  const auto lacks = [&](const simulation::ShapeSpec& shape) {
    return has_gap(engine, feature_of(shape.geometry));
  };
  const auto sample = [&](simulation::BodySpec& body) {
    for (simulation::ShapeSpec& shape : body.shapes)
      if (shape.boundary_points == 0 && lacks(shape))
        shape.boundary_points = std::max(1, static_cast<int>(shape.point_count));
  };
  for (simulation::RobotSpec& robot : experiment.robots) {
    sample(robot.base);
    for (simulation::ChainSpec& chain : robot.chains)
      for (simulation::LinkSpec& link : chain.links) sample(link.body);
  }
  return experiment;
}

std::vector<FeatureUse> features_used(const simulation::Experiment& experiment) {
  std::vector<FeatureUse> uses;
  for (std::size_t i = 0; i < experiment.robots.size(); ++i)
    add_robot(experiment, static_cast<int>(i), uses);
  for (const simulation::LoopSpec& loop : experiment.loops)
    uses.push_back({loop.stiffness ? feature::compliant_loops : feature::loops,
                    "there is Loop '" + loop.name + "'"});
  if (!experiment.couplings.empty()) uses.push_back({feature::couplings, "a Link has `mimic`"});
  if (!experiment.obstacles.empty()) {
    const std::string name = "obstacle '" + experiment.obstacles[0].name + "'";
    uses.push_back({feature::obstacles, name});
    if (has(uses, feature::points)) uses.push_back({feature::points_on_obstacles, name});
    if (simulation::obstacles_move(experiment))
      uses.push_back({feature::moving_obstacles, "an obstacle moves"});
  }
  const std::string gravity = experiment.world + ".gravity";
  for (const simulation::WireSpec& wire : experiment.wires)
    if (wire.to.starts_with(gravity))
      uses.push_back({feature::wired_gravity, "a wire goes to " + wire.to});
  if (experiment.settings == "matched" && foot_materials(experiment).size() > 1)
    uses.push_back({feature::foot_softness, "what touches has several materials"});
  if (robots_may_meet(experiment))
    uses.push_back({feature::between_robots, "robots could touch each other"});
  if (!experiment.terrain) return uses;
  const std::string ground = "terrain '" + experiment.terrain->name + "' moves";
  if (ground_frame_moves(experiment))
    uses.push_back({feature::moving_frame, ground});
  else if (simulation::ground_moves(experiment))
    uses.push_back({feature::belt, ground});
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
  std::vector<EngineGap> gaps;
  for (const OwnGap& gap : own)
    gaps.push_back({std::string(gap.feature), gap.handling, gap.instead});
  return common_gaps_and(std::move(gaps));
}

std::vector<EngineGap> common_gaps_and(std::vector<EngineGap> own) {
  using enum EngineGap::Handling;
  std::vector<EngineGap> gaps = {
      {std::string(feature::law), stated,
       "the engine has its own; `contact` and `integrator` are not read, and a material's "
       "stiffness "
       "and damping only at `settings = matched`"},
      {std::string(feature::unmatched_softness), noticed,
       "without `settings = matched` the engine gives all ground the softness of its own"},
      {std::string(feature::surface_forces), noticed,
       "the engine runs without them; choose engine dts and a force law"},
      {std::string(feature::compliant_loops), refused,
       "the engine closes a Loop by a constraint of its own; leave its stiffness out, or choose "
       "engine dts"},
      {std::string(feature::hips), refused, "choose engine dts"},
      {std::string(feature::points_on_obstacles), noticed,
       "boundary points meet the ground alone; what is to meet an obstacle needs a shape that "
       "touches"},
      {std::string(feature::between_robots), noticed,
       "robots of this engine meet the ground and obstacles, never each other; choose engine dts"},
      {std::string(feature::wired_gravity), refused,
       "in this engine gravity is that of the start; choose engine dts"},
      {std::string(feature::moving_frame), refused,
       "in this engine the ground stays; make what moves an Obstacle, or choose engine dts"},
      {std::string(feature::disc), noticed,
       "the engine has no shape without thickness: the samples of its rim touch; write a "
       "Shape.Cylinder that has one"},
      {std::string(feature::saving), refused,
       "the library keeps to itself what its solver remembers, so that a movie runs again from its "
       "start; choose engine dts"},
  };
  std::ranges::move(own, std::back_inserter(gaps));
  return gaps;
}

bool has_gap(const simulation::EngineDescription& engine, std::string_view feature) {
  return std::ranges::find(engine.gaps, feature, &EngineGap::feature) != engine.gaps.end();
}

std::vector<std::string> check_supported(const simulation::Experiment& experiment,
                                         const simulation::EngineDescription& engine) {
  if (!(experiment.deltat > 0.)) refuse(engine.name, "deltat must be above 0");
  const simulation::Experiment touching = with_samples(experiment, engine);
  for (std::size_t i = 0; i < experiment.robots.size(); ++i)
    check_robot(touching, static_cast<int>(i), engine.name);
  if (experiment.terrain) {
    const std::string problem = contact::Terrain::problem(*experiment.terrain);
    if (!problem.empty())
      refuse(engine.name, "terrain '" + experiment.terrain->name + "': " + problem);
  }
  for (const simulation::ObstacleSpec& obstacle : experiment.obstacles) {
    const std::string_view lacked = feature_of(obstacle.geometry);
    if (has_gap(engine, lacked))
      refuse(engine.name, "obstacle '" + obstacle.name + "' has " + std::string(lacked) +
                              ", which this engine lacks; choose another, or engine dts");
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

bool has_material(const simulation::BodySpec& body) {
  const auto stated = [](int material) { return material != simulation::no_material; };
  return std::ranges::any_of(body.boundary_materials, stated) ||
         std::ranges::any_of(body.shapes, stated, &simulation::ShapeSpec::material);
}

contact::MaterialConstants<double> material_at(const simulation::Experiment& experiment,
                                               int material) {
  const auto index = static_cast<std::size_t>(material);
  return index < experiment.materials.size() ? experiment.materials[index].constants
                                             : contact::MaterialConstants<double>{};
}

int sole_foot_material(const simulation::Experiment& experiment) {
  const std::set<int> feet = foot_materials(experiment);
  return feet.size() == 1 ? *feet.begin() : simulation::no_material;
}

contact::MaterialConstants<double> ground_material(const simulation::Experiment& experiment) {
  if (!experiment.terrain) return {};
  return PairMaterials(experiment).of(sole_foot_material(experiment), experiment.terrain->material);
}

}  // namespace hookpoint::reference
