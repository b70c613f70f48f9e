#include "simulation/analysis/start_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "contact/force_law.h"
#include "simulation/dts_engine/memoryless_detection.h"
#include "simulation/experiment/contact_materials.h"
#include "simulation/experiment/ground.h"
#include "simulation/experiment/kinematics.h"
#include "simulation/experiment/material_fields.h"
#include "simulation/experiment/robot_tree.h"
#include "text/number.h"

namespace hookpoint::simulation {
namespace {

/// Of the depth at rest: so much deeper a body does not start on purpose.
constexpr double far_deeper = 10.;
/// Of a robot's size: shallower is no fault, however light the robot.
constexpr double least_part = 0.01;
/// Of a robot's size: so deep it does not stand on its ground but in it.
constexpr double soft_part = 0.1;
/// Of the depth at rest: shallower a robot is not placed at rest.
constexpr double placed_part = 0.5;

/// What two things have of each other at the start.
struct Overlap {
  double depth = 0.;   ///< the greatest [m]
  double energy = 0.;  ///< of the law's normal springs [J]
  std::size_t places = 0;
  contact::MaterialConstants<double> material;  ///< of the deepest place

  void add(const contact::LawDescription& law, double at, double weight,
           const contact::MaterialConstants<double>& constants) {
    if (!(at > 0.)) return;
    ++places;
    energy += weight * law.stored_energy(at, {}, constants);
    if (at <= depth) return;
    depth = at;
    material = constants;
  }
};

/// Largest side of the box about all boundary points, in base axes [m].
double size_of(const RobotSpec& robot) {
  Vector3d low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
  for (const auto& [p, body, r, material] : points_in_base(robot)) {
    low = {std::min(low.x, p.x - r), std::min(low.y, p.y - r), std::min(low.z, p.z - r)};
    high = {std::max(high.x, p.x + r), std::max(high.y, p.y + r), std::max(high.z, p.z + r)};
  }
  return std::max({0., high.x - low.x, high.y - low.y, high.z - low.z});
}

Overlap overlap_with(const contact::Terrain& ground, const Experiment& experiment,
                     const RobotSpec& robot, const contact::LawDescription& law) {
  Overlap overlap;
  for (const RobotPoint& point : points_in_base(robot)) {
    if (point.body == 0 && !robot.mobile) continue;
    const contact::TilePoint tile =
        ground.query(robot.location + rotate(robot.orientation, point.p_BP));
    if (tile.outside) continue;
    overlap.add(law, tile.depth + point.radius, 1.,
                contact_constants(experiment, point.material, tile.material));
  }
  return overlap;
}

class StartDepths {
 public:
  StartDepths(const Experiment& experiment, const contact::LawDescription& law)
      : experiment_(experiment), law_(law) {}

  std::vector<StartDepth> find() {
    if (const auto ground = make_ground(experiment_)) {
      for (std::size_t i = 0; i < experiment_.robots.size(); ++i) on_terrain(i, *ground);
    }
    if (shapes_matter(experiment_)) in_each_other();
    return std::move(found_);
  }

 private:
  double weight(std::size_t robot) const {
    return moving_mass(experiment_.robots[robot]) * norm(experiment_.gravity);
  }

  void on_terrain(std::size_t robot, const contact::Terrain& ground) {
    const RobotSpec& spec = experiment_.robots[robot];
    const Overlap overlap = overlap_with(ground, experiment_, spec, law_);
    if (overlap.places == 0) return;
    if (add_if_deep(robot, "the ground", overlap) || !spec.mobile) return;
    const double rest = resting_depth(robot, overlap), size = size_of(spec);
    if (!(size > 0. && rest > soft_part * size && overlap.depth > placed_part * rest)) return;
    const contact::Constant stiffness = law_.normal_constants.stiffness;
    found_.push_back(
        {robot, false,
         fmt::format(
             "`{}` rests {:.3g} m deep in the ground, {:.2g} % of its size of {:.3g} m: the "
             "ground is soft for its weight of {} N; {}, or lower its mass",
             spec.name, rest, 100. * rest / size, size, text::rounded(weight(robot)),
             stiffness == nullptr
                 ? std::string("choose stiffer constants in the Material")
                 : fmt::format("raise {} of the Material", field_of(stiffness).name))});
  }

  /// Where the places that touch bear the weight evenly [m].
  double resting_depth(std::size_t robot, const Overlap& overlap) const {
    return law_.static_depth(weight(robot) / static_cast<double>(overlap.places), overlap.material);
  }

  bool add_if_deep(std::size_t robot, const std::string& in, const Overlap& overlap) {
    const RobotSpec& spec = experiment_.robots[robot];
    const double size = size_of(spec);
    const double rest = std::max(0., resting_depth(robot, overlap));
    const bool deep = overlap.depth > far_deeper * rest && overlap.depth > least_part * size &&
                      overlap.energy > weight(robot) * size;
    if (!deep) return false;
    const std::string height =
        weight(robot) > 0.
            ? fmt::format(", enough to throw it {:.3g} m high", overlap.energy / weight(robot))
            : "";
    found_.push_back(
        {robot, true,
         fmt::format(
             "`{}` starts {:.3g} m deep in {}, where it would rest at {:.2g} m: its springs "
             "hold {:.3g} J{}; move its `location` out of it{}",
             spec.name, overlap.depth, in, rest, overlap.energy, height,
             spec.mobile && in == "the ground" ? ", or place it with `rest_on`" : "")});
    return true;
  }

  void in_each_other() {
    std::vector<std::vector<Pose>> poses;
    for (const RobotSpec& robot : experiment_.robots) poses.push_back(body_poses(robot));
    MemorylessDetection detection(experiment_, nullptr, 0., {});
    const auto motion = [&](const ShapeObject& object) {
      const RobotSpec& robot = experiment_.robots[object.index];
      const Pose& pose = poses[object.index][object.body];
      BodyState body;
      body.position = robot.location + rotate(robot.orientation, pose.position);
      body.orientation = robot.orientation * pose.orientation;
      return motion_of(body);
    };
    const WorldInputs inputs = initial_inputs(experiment_);
    const std::span<const ShapeContact> contacts = detection.detect(inputs, motion);
    const ContactMaterials materials(experiment_);
    std::map<std::pair<std::int64_t, std::int64_t>, Overlap> overlaps;
    for (const ShapeContact& contact : contacts)
      overlaps[std::minmax(contact.key.a, contact.key.b)].add(law_, contact.depth, contact.weight,
                                                              constants_of(materials, contact));
    const std::vector<ShapeObject>& objects = detection.objects();
    for (const auto& [pair, overlap] : overlaps) {
      const ShapeObject &first = objects[static_cast<std::size_t>(pair.first)],
                        &last = objects[static_cast<std::size_t>(pair.second)];
      if (overlap.places == 0) continue;
      const bool obstacle = first.kind == ShapeObject::Kind::obstacle;
      if (!obstacle && first.index == last.index) continue;  // as it is built
      add_if_deep(last.index,
                  obstacle ? "Obstacle `" + experiment_.obstacles[first.index].name + "`"
                           : "Robot `" + experiment_.robots[first.index].name + "`",
                  overlap);
    }
  }

  const Experiment& experiment_;
  const contact::LawDescription& law_;
  std::vector<StartDepth> found_;
};

}  // namespace

std::vector<StartDepth> start_depths(const Experiment& experiment) {
  const contact::LawDescription* law = contact::find_force_law(experiment.contact);
  if (law == nullptr || experiment.engine != "dts") return {};
  return StartDepths(experiment, *law).find();
}

}  // namespace hookpoint::simulation
