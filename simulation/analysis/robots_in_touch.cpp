#include "simulation/analysis/robots_in_touch.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "simulation/dts_engine/memoryless_detection.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// What is nearer touches at once [m].
constexpr double touching_reach = 1e-3;

/// Of each pair of objects that overlap, the places where they do; of others those that are near.
std::vector<ShapeContact> touching(std::span<const ShapeContact> found) {
  std::map<std::pair<std::int64_t, std::int64_t>, double> deepest;
  for (const ShapeContact& contact : found) {
    const auto [at, added] =
        deepest.try_emplace(std::minmax(contact.key.a, contact.key.b), contact.depth);
    if (!added) at->second = std::max(at->second, contact.depth);
  }
  std::vector<ShapeContact> contacts;
  for (const ShapeContact& contact : found) {
    const double most = deepest.at(std::minmax(contact.key.a, contact.key.b));
    if (contact.depth > (most > 0. ? 0. : -touching_reach) && contact.weight > 0.)
      contacts.push_back(contact);
  }
  return contacts;
}

/// Joins what touches.
class Groups {
 public:
  explicit Groups(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t i) const {
    while (parents_[i] != i) i = parents_[i];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    const std::size_t first = of(i), second = of(j);
    parents_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::vector<std::size_t> parents_;
};

void share_loads(const Experiment& experiment, RobotsInTouch& group) {
  double weight = 0.;
  for (const std::size_t robot : group.robots)
    weight += moving_mass(experiment.robots[robot]) * norm(experiment.gravity);
  const auto holds_up = [](const TouchingPlace& place) { return !place.a || !place.b; };
  auto count = std::ranges::count_if(group.places, holds_up);
  if (count == 0) count = std::ssize(group.places);
  for (TouchingPlace& place : group.places) place.load = weight / static_cast<double>(count);
}

}  // namespace

std::vector<RobotsInTouch> robots_in_touch(const Experiment& experiment,
                                           const contact::Terrain* ground,
                                           const WorldInputs& inputs,
                                           std::span<const std::unique_ptr<RobotSystem>> robots) {
  if (!shapes_matter(experiment)) return {};
  MemorylessDetection detection(experiment, ground, touching_reach, {});
  const std::span<const ShapeContact> found =
      detection.detect(inputs, [&](const ShapeObject& object) {
        return robots[object.index]->workspace().bodies[object.body];
      });
  const ContactMaterials materials(experiment);

  std::vector<TouchingPlace> places;
  Groups groups(robots.size());
  for (const ShapeContact& contact : touching(found)) {
    const auto side = [&](std::int64_t object) -> std::optional<TouchingPlace::Side> {
      const ShapeObject& of = detection.objects()[static_cast<std::size_t>(object)];
      if (!of.movable) return std::nullopt;
      return TouchingPlace::Side{of.index, {of.body, contact.place}};
    };
    TouchingPlace place{
        side(contact.key.a), side(contact.key.b), contact.normal, contact.weight, {}, 0.};
    place.material = contact.key.a < contact.key.b
                         ? materials.between(contact.material_a, contact.material_b)
                         : materials.between(contact.material_b, contact.material_a);
    if (place.a && place.b) groups.join(place.a->robot, place.b->robot);
    places.push_back(place);
  }

  std::map<std::size_t, RobotsInTouch> made;
  for (const TouchingPlace& place : places)
    made[groups.of((place.a ? place.a : place.b)->robot)].places.push_back(place);
  for (std::size_t robot = 0; robot < robots.size(); ++robot)
    if (const auto at = made.find(groups.of(robot)); at != made.end())
      at->second.robots.push_back(robot);
  std::vector<RobotsInTouch> all;
  for (auto& [first, group] : made) {
    share_loads(experiment, group);
    all.push_back(std::move(group));
  }
  return all;
}

RobotsInTouch alone(const RobotsInTouch& group, std::size_t robot) {
  RobotsInTouch part{{robot}, {}};
  const auto is_of = [&](const std::optional<TouchingPlace::Side>& side) {
    return side && side->robot == robot;
  };
  for (const TouchingPlace& place : group.places)
    if (is_of(place.a) || is_of(place.b)) part.places.push_back(place);
  return part;
}

LinearDynamics linear_dynamics(const RobotsInTouch& group, std::span<const RobotAtRest> rests,
                               std::span<const PlaceSpring> springs, const Vector3d& gravity) {
  struct Block {
    Eigen::Index coordinate = 0, joint = 0;
  };
  std::map<std::size_t, Block> blocks;
  Block size;
  for (const std::size_t robot : group.robots) {
    blocks[robot] = size;
    size.coordinate += rests[robot].size();
    size.joint += rests[robot].joint_levers().rows();
  }
  LinearDynamics dynamics{Eigen::MatrixXd::Zero(size.coordinate, size.coordinate),
                          Eigen::MatrixXd::Zero(size.coordinate, size.coordinate),
                          Eigen::MatrixXd::Zero(size.joint, size.coordinate),
                          {Eigen::MatrixXd::Zero(size.coordinate, size.coordinate),
                           Eigen::MatrixXd::Zero(size.coordinate, size.coordinate)}};
  for (const auto& [robot, at] : blocks) {
    const RobotAtRest& rest = rests[robot];
    const Eigen::Index n = rest.size();
    LinearDynamics own = rest.without_contacts();
    // What falls freely feels no weight; what stands feels it through its contacts, where it adds little.
    if (!rest.robot().model().mobile()) own.stiffness += rest.stiffness_of(rest.weights(gravity));
    dynamics.stiffness.block(at.coordinate, at.coordinate, n, n) = own.stiffness;
    dynamics.damping.block(at.coordinate, at.coordinate, n, n) = own.damping;
    dynamics.of_joints.stiffness.block(at.coordinate, at.coordinate, n, n) =
        own.of_joints.stiffness;
    dynamics.of_joints.damping.block(at.coordinate, at.coordinate, n, n) = own.of_joints.damping;
    dynamics.joints.block(at.joint, at.coordinate, own.joints.rows(), n) = own.joints;
  }
  for (std::size_t i = 0; i < group.places.size(); ++i) {
    const TouchingPlace& place = group.places[i];
    Eigen::MatrixXd lever = Eigen::MatrixXd::Zero(size.coordinate, 3);
    double count = 1.;
    const auto add = [&](const std::optional<TouchingPlace::Side>& side, double sign) {
      if (!side) return;
      const auto at = blocks.find(side->robot);
      if (at == blocks.end()) {
        count = 2.;
        return;
      }
      const RobotAtRest& rest = rests[side->robot];
      lever.middleRows(at->second.coordinate, rest.size()) += sign * rest.lever(side->point);
    };
    add(place.a, 1.);
    add(place.b, -1.);
    dynamics.stiffness += count * lever * springs[i].stiffness * lever.transpose();
    dynamics.damping += count * lever * springs[i].damping * lever.transpose();
  }
  return dynamics;
}

}  // namespace hookpoint::simulation
