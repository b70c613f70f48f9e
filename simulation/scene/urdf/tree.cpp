// A URDF's links as the bodies of a base and its chains: what is fixed together is one body.
#include <fmt/format.h>

#include <algorithm>

#include "dts/mass_properties.h"
#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {
namespace {

class UrdfAssembly {
 public:
  UrdfAssembly(const UrdfRobot& robot, language::Report& report)
      : robot_(robot), report_(report), outward_(robot.links.size()), moves_(robot.links.size()) {}

  std::optional<UrdfTree> run() {
    if (!hang_links()) return std::nullopt;
    const std::optional<std::size_t> root = find_root();
    if (!root) return std::nullopt;
    UrdfTree tree;
    const UrdfJoint* free = free_joint(*root);
    if (!all_others_guided(free)) return std::nullopt;
    tree.floats = free != nullptr;
    if (tree.floats) ++reached_;
    std::vector<Next> hips;
    tree.base = body_of(tree.floats ? free->child : *root, nullptr, {}, hips);
    for (const Next& hip : hips) tree.chains.push_back(chain_from(hip, 0));
    if (too_deep_) return std::nullopt;
    return all_reached() ? std::optional(std::move(tree)) : std::nullopt;
  }

 private:
  /// A joint that moves, and where its frame stands in that of the body that carries it.
  struct Next {
    const UrdfJoint* joint;
    Pose X_FJ;
  };

  /// Bodies from `next` on, as long as each carries one more; the chain hangs on a chain on ...,
  /// `depth` of them.
  UrdfChain chain_from(const Next& next, std::size_t depth) {
    // Each is a Chain in a Link, and the language nests 200 deep.
    constexpr std::size_t deepest = 90;
    UrdfChain chain;
    if (depth > deepest) {
      if (!too_deep_)
        report_.error(
            next.joint->place,
            fmt::format("joint `{}` starts a chain on a chain, and so on, {} deep: {} are "
                        "the most",
                        next.joint->name, depth, deepest));
      too_deep_ = true;
      return chain;
    }
    for (std::vector<Next> outer{next}; outer.size() == 1;) {
      const Next at = outer.front();
      outer.clear();
      chain.bodies.push_back(body_of(at.joint->child, at.joint, at.X_FJ, outer));
      if (outer.size() == 1) continue;
      for (const Next& hip : outer) chain.carried.push_back(chain_from(hip, depth + 1));
    }
    return chain;
  }

  /// Which joints each link carries; false when one is carried twice.
  bool hang_links() {
    std::vector<const UrdfJoint*> carrier(robot_.links.size(), nullptr);
    bool good = true;
    for (const UrdfJoint& joint : robot_.joints) {
      const UrdfJoint*& first = carrier[joint.child];
      if (first != nullptr) {
        report_.error(joint.place, fmt::format("link `{}` is the child of a second joint: links "
                                               "form a tree",
                                               robot_.links[joint.child].name));
        report_.note(first->place, "the first is here");
        good = false;
      }
      first = &joint;
      outward_[joint.parent].push_back(&joint);
      moves_[joint.child] = true;
    }
    return good;
  }

  /// The one link that no joint carries.
  std::optional<std::size_t> find_root() {
    std::optional<std::size_t> root;
    for (std::size_t i = 0; i < robot_.links.size(); ++i) {
      if (moves_[i]) continue;
      if (root) {
        report_.error(robot_.links[i].place,
                      fmt::format("no joint carries link `{}`, and none `{}`: a robot has one root",
                                  robot_.links[i].name, robot_.links[*root].name));
        return std::nullopt;
      }
      root = i;
    }
    if (!root) report_.error(robot_.place, "the joints form a loop: no link is the root");
    return root;
  }

  /// The floating joint by which the root, the world, carries the base; null where there is none.
  const UrdfJoint* free_joint(std::size_t root) const {
    const UrdfLink& link = robot_.links[root];
    const std::vector<const UrdfJoint*>& carried = outward_[root];
    const bool is_world = !link.has_inertial && !link.touches() && carried.size() == 1 &&
                          carried[0]->type == UrdfJointType::floating;
    return is_world ? carried[0] : nullptr;
  }

  /// No other joint floats.
  bool all_others_guided(const UrdfJoint* free) {
    bool good = true;
    for (const UrdfJoint& joint : robot_.joints) {
      if (joint.type != UrdfJointType::floating || &joint == free) continue;
      report_.error(joint.type_place,
                    "a floating joint is not supported but as the only joint of a root without "
                    "mass and shapes: only the base moves freely, links turn or slide about one "
                    "axis");
      good = false;
    }
    return good;
  }

  /// Link `first` with all that is fixed to it. `X_PJ`: of its joint in the frame before; `moving`
  /// gets the joints that it carries, in the file's order.
  UrdfBody body_of(std::size_t first, const UrdfJoint* joint, const Pose& X_PJ,
                   std::vector<Next>& moving) {
    UrdfBody body;
    body.link = first;
    body.joint = joint;
    const Pose turn{{}, joint == nullptr ? Quaterniond{} : from_z_to(joint->axis)};
    body.joint_pose = X_PJ * turn;
    std::vector<dts::MassProperties<double>> masses;
    struct Fixed {
      std::size_t link;
      Pose X_FL;
    };
    for (std::vector<Fixed> waiting{{first, inverse(turn)}}; !waiting.empty();) {
      const Fixed fixed = waiting.back();
      waiting.pop_back();
      ++reached_;
      add(robot_.links[fixed.link], fixed.X_FL, body, masses);
      for (const UrdfJoint* carried : outward_[fixed.link]) {
        const Pose X_FC = fixed.X_FL * carried->origin;
        if (carried->type == UrdfJointType::fixed) {
          waiting.push_back({carried->child, X_FC});
        } else {
          moving.push_back({carried, X_FC});
        }
      }
    }
    std::ranges::sort(moving, {}, &Next::joint);
    const dts::MassProperties<double> whole = dts::combined(masses);
    body.mass = {whole.mass, whole.center_of_mass, whole.inertia};
    return body;
  }

  void add(const UrdfLink& link, const Pose& X_FL, UrdfBody& body,
           std::vector<dts::MassProperties<double>>& masses) {
    if (link.has_inertial) {
      const MassSpec& mass = link.mass;
      masses.push_back(dts::placed({mass.mass, mass.center_of_mass, mass.inertia}, X_FL.position,
                                   X_FL.orientation));
      if (!body.has_inertial) body.inertial_place = link.inertial_place;
      body.has_inertial = true;
    }
    for (UrdfShape shape : link.shapes) {
      const Pose X_FS = X_FL * Pose{shape.spec.location, shape.spec.orientation};
      shape.spec.location = X_FS.position;
      shape.spec.orientation = X_FS.orientation;
      body.shapes.push_back(std::move(shape));
    }
    for (UrdfPoint point : link.points) {
      point.position = (X_FL * Pose{point.position, {}}).position;
      body.points.push_back(std::move(point));
    }
  }

  /// Links in a loop of their own hang on nothing that the root carries.
  bool all_reached() {
    if (reached_ == robot_.links.size()) return true;
    report_.error(robot_.place, "some joints form a loop that the root does not carry");
    return false;
  }

  const UrdfRobot& robot_;
  language::Report& report_;
  std::vector<std::vector<const UrdfJoint*>> outward_;  ///< one a link: the joints it carries
  std::vector<bool> moves_;                             ///< one a link: a joint carries it
  std::size_t reached_ = 0;
  bool too_deep_ = false;
};

}  // namespace

// (1 + z.axis, z x axis), normalised.
Quaterniond from_z_to(const Vector3d& axis) {
  const double across = axis.x * axis.x + axis.y * axis.y;
  if (axis.z < 0. && across == 0.) return {0., 1., 0., 0.};
  const double w = axis.z < 0. ? across / (1. - axis.z) : 1. + axis.z;
  return normalized(Quaterniond{w, -axis.y, axis.x, 0.});
}

std::optional<UrdfTree> assemble_urdf(const UrdfRobot& robot, language::Report& report) {
  return UrdfAssembly(robot, report).run();
}

}  // namespace hookpoint::simulation
