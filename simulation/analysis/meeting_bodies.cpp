#include "simulation/analysis/meeting_bodies.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "simulation/dts_engine/memoryless_detection.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// A body or an obstacle that may be met.
struct Meets {
  std::size_t object = 0;
  Eigen::MatrixXd lever;     ///< RobotAtRest::lever of its worst corner; empty: nothing moves it
  double inverse_mass = 0.;  ///< greatest, of that corner against something that stands [1/kg]
  std::set<int> materials;
};

std::set<int> materials_of(const ShapeObject& object) {
  std::set<int> all;
  const auto add = [&](const auto& features) {
    for (const auto& feature : features) all.insert(feature.material);
  };
  add(object.balls);
  add(object.rims);
  add(object.sides);
  add(object.polyhedra);
  add(object.rounds);
  return all;
}

Eigen::MatrixXd worst_lever(const ShapeObject& object, const RobotAtRest& rest) {
  const dts::BodyMotion<double>& body = rest.robot().workspace().bodies[object.body];
  const auto& [low, high] = object.bounds;
  std::optional<dts::BodyPoint<double>> worst;
  double most = -1.;
  for (const double x : {low.x, high.x}) {
    for (const double y : {low.y, high.y}) {
      for (const double z : {low.z, high.z}) {
        const dts::BodyPoint<double> corner{object.body, body.p_WB + body.R_WB * Vector3d{x, y, z}};
        const double size = rest.lever_size(corner);
        if (size <= most) continue;
        most = size;
        worst = corner;
      }
    }
  }
  return rest.lever(*worst);
}

/// Of two bodies that move apart from each other: no more than the sum of both, up to rounding.
double most_inverse_mass(const Meets& a, const Meets& b) {
  constexpr double rounding = 1e-12;
  return (1. - rounding) * (a.inverse_mass + b.inverse_mass);
}

double inverse_mass(const Meets& a, const Meets& b, bool same_robot) {
  if (same_robot && a.lever.size() > 0 && b.lever.size() > 0) {
    const Eigen::MatrixXd apart = a.lever - b.lever;
    return largest_eigenvalue(apart.transpose() * apart);
  }
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3, 3);
  for (const Meets* side : {&a, &b})
    if (side->lever.size() > 0) sum += side->lever.transpose() * side->lever;
  return largest_eigenvalue(sum);
}

}  // namespace

std::vector<Meeting> meeting_bodies(const Experiment& experiment,
                                    std::span<const RobotAtRest> rests,
                                    std::span<const RobotsInTouch> touching) {
  if (!shapes_matter(experiment)) return {};
  const std::vector<ShapeObject> objects = shape_objects(experiment, nullptr);
  const ShapeDetection detection(experiment, objects, nullptr, 0.);
  std::map<std::size_t, std::size_t> group_of;
  for (std::size_t group = 0; group < touching.size(); ++group)
    for (const std::size_t robot : touching[group].robots) group_of[robot] = group;

  std::vector<Meets> all;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ShapeObject& object = objects[i];
    if (object.is_empty()) continue;
    Meets& meets = all.emplace_back(Meets{i, {}, 0., materials_of(object)});
    if (object.movable && rests[object.index].is_regular()) {
      meets.lever = worst_lever(object, rests[object.index]);
      meets.inverse_mass = largest_eigenvalue(meets.lever.transpose() * meets.lever);
    }
  }

  const ContactMaterials materials(experiment);
  std::map<std::pair<int, int>, Meeting> worst;
  // Many robots are alike: what cannot be worse than a pair that is known costs no eigenvalues.
  const auto is_known = [&](const Meets& a, const Meets& b) {
    for (const int of_a : a.materials)
      for (const int of_b : b.materials)
        if (most_inverse_mass(a, b) > worst[{of_a, of_b}].inverse_mass) return false;
    return true;
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const ShapeObject &a = objects[all[i].object], &b = objects[all[j].object];
      if (!detection.may_touch(all[i].object, all[j].object)) continue;
      const bool obstacle = a.kind == ShapeObject::Kind::obstacle;
      const bool same = !obstacle && a.index == b.index;
      if (!obstacle && !same && group_of.contains(a.index) && group_of.contains(b.index) &&
          group_of.at(a.index) == group_of.at(b.index))
        continue;
      if (!same && is_known(all[i], all[j])) continue;
      const double inverse = inverse_mass(all[i], all[j], same);
      for (const int of_a : all[i].materials) {
        for (const int of_b : all[j].materials) {
          Meeting& kept = worst[{of_a, of_b}];
          if (inverse <= kept.inverse_mass) continue;
          kept.robot = b.index;
          kept.other = obstacle ? b.index : a.index;
          kept.inverse_mass = inverse;
          kept.material = materials.between(of_a, of_b);
          double mass = moving_mass(experiment.robots[kept.robot]);
          if (kept.other != kept.robot) mass += moving_mass(experiment.robots[kept.other]);
          kept.load = mass * norm(experiment.gravity);
        }
      }
    }
  }
  std::vector<Meeting> meetings;
  for (const auto& [pair, meeting] : worst)
    if (meeting.inverse_mass > 0.) meetings.push_back(meeting);
  return meetings;
}

}  // namespace hookpoint::simulation
