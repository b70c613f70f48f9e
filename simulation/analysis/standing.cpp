#include "simulation/analysis/standing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "simulation/analysis/convex_hull.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Turned farther than that from its initial posture, a robot does not stand in it [rad].
constexpr double standing_tilt = 0.05;
/// What lies on a face turns as it settles, and still lies on it.
constexpr double any_tilt = HUGE_VAL;
/// A face looks down whose normal is nearer to it than that (45 degrees).
constexpr double looks_down = 0.7;

/// A point that the ground may come to carry.
struct Support {
  CarryingPoint place;
  double depth = 0.;  ///< > 0 inside [m]
};

/// What pushes a robot onto its ground.
struct Pushes {
  std::vector<SteadyLoad> loads;
  VectorXd torques;  ///< of moments and of joints, over z
};

/// The equilibrium of a robot that leans on springs: the least of its potential energy over small
/// motions z, by Newton's method with a bounded step. Feet that carry stick.
class Settling {
 public:
  Settling(const Experiment& experiment, const RobotAtRest& rest, std::span<const Support> supports,
           const Pushes& pushes, const MatrixXd& joints, std::int64_t& evaluations,
           AnalysisBudget& budget)
      : law_(*contact::find_force_law(experiment.contact)),
        experiment_(experiment),
        rest_(rest),
        supports_(supports),
        push_(pushes.torques),
        joints_(joints),
        evaluations_(evaluations),
        budget_(budget) {
    push_ += rest.pushed_by(pushes.loads);
    for (const Support& support : supports) normals_.push_back(eigen(support.place.normal));
    for (const Support& a : supports)
      size_ = std::max(size_, norm(a.place.point.p_WP - supports.front().place.point.p_WP));
    if (size_ == 0.) size_ = 1.;
  }

  /// The load of each support [N]; none where the ground does not hold the robot, or only turned by
  /// more than `most_tilt` [rad].
  std::optional<std::vector<double>> settle(double most_tilt) const {
    VectorXd z = lowered();
    const VectorXd start = z;
    const double small = balanced * std::max(push_.norm(), tiny);
    const auto size = static_cast<double>(z.size());
    for (int i = 0; i < most_tries; ++i) {
      // The solution, and what each support's depth and force cost here and at each halving.
      budget_.spend(size * size * size / 6. +
                    10. * static_cast<double>(supports_.size()) * (3. * size + work_of_law));
      const Balance now = balance(z);
      if (now.left.norm() <= small) return loads(z);
      const double held = least_held * now.stiffness.trace() / size + free_held;
      const VectorXd change =
          solve_positive(now.stiffness + held * MatrixXd::Identity(z.size(), z.size()), now.left);
      if (!change.allFinite()) return std::nullopt;
      const double before = energy(z);
      double part = std::min(1., longest_move * size_ / std::max(farthest(change), tiny));
      for (int halved = 0; halved < most_halvings && energy(z + part * change) > before; ++halved)
        part *= 0.5;
      z += part * change;
      if (farthest(z - start) > size_ || norm(rest_.base_rotation(z - start)) > most_tilt)
        return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  /// Of all that pushes: what may be left of it in an equilibrium.
  static constexpr double balanced = 1e-8;
  /// Of the mean stiffness, and at least that [1/s^2]: holds what nothing else holds.
  static constexpr double least_held = 1e-10, free_held = 1e-9;
  /// Of the robot's size: how far a try moves a support at most, while contacts come and go.
  static constexpr double longest_move = 0.05;
  static constexpr int most_tries = 200, most_halvings = 12;
  /// Multiplications of an evaluation of the law at a point.
  static constexpr double work_of_law = 30.;
  /// Keeps what it stands under from being 0.
  static constexpr double tiny = 1e-300;

  struct Balance {
    VectorXd left;       ///< of the forces
    MatrixXd stiffness;  ///< -d(left)/dz
  };

  /// A floating robot comes down until it touches.
  VectorXd lowered() const {
    VectorXd z = VectorXd::Zero(rest_.size());
    if (!rest_.robot().model().mobile()) return z;
    const auto lowest = std::ranges::max_element(supports_, {}, &Support::depth);
    if (lowest->depth > 0.) return z;
    return rest_.base_motion({}, lowest->depth * lowest->place.normal);
  }

  const contact::MaterialConstants<double>& material(std::size_t i) const {
    return supports_[i].place.material;
  }

  const MatrixXd& lever(std::size_t i) const { return supports_[i].place.lever; }

  Eigen::Vector3d moved(std::size_t i, const VectorXd& z) const { return lever(i).transpose() * z; }

  double depth(std::size_t i, const VectorXd& z) const {
    return supports_[i].depth - normals_[i].dot(moved(i, z));
  }

  /// Of a point at rest `depth` deep [N].
  double load(std::size_t i, double depth) const {
    ++evaluations_;
    contact::PointKinematics<double> point;
    point.normal = {0., 0., 1.};
    point.depth = depth;
    return law_.evaluate(point, {}, material(i), 1.).force.z;
  }

  /// Along the tile; a law without such a spring creeps, and for the time of an equilibrium holds.
  double sticking(std::size_t i, const contact::LinearContact& linear) const {
    if (material(i).static_friction == 0.) return 0.;
    return linear.tangential_stiffness > 0. ? linear.tangential_stiffness : linear.normal_stiffness;
  }

  Balance balance(const VectorXd& z) const {
    Balance sum{push_ - joints_ * z, joints_};
    const auto size = static_cast<double>(z.size());
    for (std::size_t i = 0; i < supports_.size(); ++i) {
      const double N = load(i, depth(i, z));
      if (!(N > 0.)) continue;
      const contact::LinearContact linear = law_.linearise(N, material(i));
      budget_.spend(3. * size * size);
      const Eigen::Matrix3d along = normals_[i] * normals_[i].transpose();
      const Eigen::Matrix3d across = sticking(i, linear) * (Eigen::Matrix3d::Identity() - along);
      sum.left += lever(i) * (N * normals_[i] - across * moved(i, z));
      sum.stiffness += lever(i) * (linear.normal_stiffness * along + across) * lever(i).transpose();
    }
    return sum;
  }

  double energy(const VectorXd& z) const {
    double sum = 0.5 * z.dot(joints_ * z) - push_.dot(z);
    for (std::size_t i = 0; i < supports_.size(); ++i) {
      const double d = depth(i, z), N = load(i, d);
      if (!(N > 0.)) continue;
      const Eigen::Vector3d x = moved(i, z);
      const double across = x.squaredNorm() - std::pow(normals_[i].dot(x), 2);
      sum += law_.stored_energy(d, {}, material(i)) +
             0.5 * sticking(i, law_.linearise(N, material(i))) * across;
    }
    return sum;
  }

  /// That any support moves [m].
  double farthest(const VectorXd& z) const {
    double most = 0.;
    for (std::size_t i = 0; i < supports_.size(); ++i) most = std::max(most, moved(i, z).norm());
    return most;
  }

  std::vector<double> loads(const VectorXd& z) const {
    std::vector<double> loads;
    for (std::size_t i = 0; i < supports_.size(); ++i)
      loads.push_back(std::max(0., load(i, depth(i, z))));
    return loads;
  }

  const contact::LawDescription& law_;
  const Experiment& experiment_;
  const RobotAtRest& rest_;
  std::span<const Support> supports_;
  VectorXd push_;
  const MatrixXd& joints_;
  std::int64_t& evaluations_;
  AnalysisBudget& budget_;
  std::vector<Eigen::Vector3d> normals_;
  double size_ = 0.;  ///< of what stands [m]
};

/// What drives a robot's joints.
struct Drives {
  const Experiment& experiment;
  std::size_t robot;
  std::span<const DrivenJoint> driven;  ///< of that robot

  /// Null for a joint that no wire drives.
  const DrivenJoint* find(std::size_t joint) const {
    const auto found = std::ranges::lower_bound(driven, joint, {}, &DrivenJoint::joint);
    return found == driven.end() || found->joint != joint ? nullptr : &*found;
  }

  /// Of all joints at the robot's posture, at rest, over z.
  VectorXd torques(const RobotAtRest& rest) const {
    const RobotSystem& at = rest.robot();
    const MatrixXd levers = rest.joint_levers();
    VectorXd sum = VectorXd::Zero(rest.size());
    const JointSet& joints = at.robot().joints();
    for_each_link(experiment.robots[robot], [&](const TreeLink& tree) {
      const std::size_t joint = tree.joint();
      const double position = at.state().joint_positions[joint];
      const JointProperties& properties = joints.properties()[joint];
      const DrivenJoint* drive = find(joint);
      double asked = drive == nullptr ? tree.link.torque : 0.;
      if (drive != nullptr && drive->goal) asked = drive->proportional * (*drive->goal - position);
      const double torque = drive_torque(properties, asked) +
                            passive_joint_torque(properties, position, 0., joints.hooks()[joint]);
      sum += torque * levers.row(static_cast<Eigen::Index>(joint)).transpose();
    });
    return sum;
  }
};

class StanceFinder {
 public:
  StanceFinder(const Experiment& experiment, std::size_t index, const RobotAtRest& rest,
               const WiredControl& control, AnalysisBudget& budget)
      : experiment_(experiment),
        rest_(rest),
        budget_(budget),
        drives_{experiment, index, driven_of(control, index)},
        own_pushes_(drives_.torques(rest) + rest.pushed_by(rest.loop_loads())),
        weight_(moving_mass(experiment.robots[index]) * norm(experiment.gravity)) {
    const auto size = static_cast<double>(rest.size());
    const ContactSet& contacts = rest.robot().contacts();
    for (const ContactPoint& point : contacts.points()) {
      budget_.spend(3. * size * size);
      const dts::BodyPoint<double> place{point.body, point.position};
      supports_.push_back(
          {{place, rest.lever(place), point.normal, contacts.constants(point, point.material), 0.},
           point.depth});
    }
  }

  Stances find() {
    const Vector3d& gravity = experiment_.gravity;
    for (const bool pushed : {false, true}) {
      if (pushed && !has_windows()) continue;
      const Pushes now = pushes(gravity, pushed);
      if (const auto loads = settle(supports_, now, standing_tilt)) {
        stances_.all.push_back(stance(supports_, *loads, now));
      } else if (!pushed) {
        stances_.lands = true;
      }
    }
    if (stances_.lands) add_landings();
    return std::move(stances_);
  }

 private:
  std::optional<std::vector<double>> settle(std::span<const Support> supports, const Pushes& pushes,
                                            double most_tilt) {
    const MatrixXd joints = joint_stiffness(supports);
    return Settling(experiment_, rest_, supports, pushes, joints, stances_.evaluations, budget_)
        .settle(most_tilt);
  }

  bool has_windows() const {
    return std::ranges::any_of(rest_.robot().robot().forces(), [&](std::size_t force) {
      return experiment_.forces[force].window.has_value();
    });
  }

  /// Weights in that gravity, Forces (those over a window at their height, or not), joints.
  Pushes pushes(const Vector3d& gravity, bool with_windows) const {
    const RobotSystem& robot = rest_.robot();
    Pushes pushes{rest_.weights(gravity), own_pushes_};
    for (const std::size_t i : robot.robot().forces()) {
      const ForceSpec& force = experiment_.forces[i];
      if (force.window && !with_windows) continue;
      const dts::BodyMotion<double>& body = robot.workspace().bodies[force.body];
      const auto number = static_cast<std::size_t>(force.body);
      pushes.loads.push_back({{number, body.p_WB + body.R_WB * force.point}, force.force});
      pushes.torques += of_moment(number, body.p_WB, force.torque);
    }
    return pushes;
  }

  /// What a moment does to z: a couple of forces about each axis.
  VectorXd of_moment(std::size_t body, const Vector3d& at, const Vector3d& moment) const {
    const MatrixXd here = rest_.lever({body, at});
    const auto arm = [&](const Vector3d& along, int force) -> VectorXd {
      return rest_.lever({body, at + along}).col(force) - here.col(force);
    };
    return moment.x * arm({0., 1., 0.}, 2) + moment.y * arm({0., 0., 1.}, 0) +
           moment.z * arm({1., 0., 0.}, 1);
  }

  /// What joints and springs of loops oppose to a displacement; a joint that is driven to
  /// somewhere holds, far stiffer than the ground.
  MatrixXd joint_stiffness(std::span<const Support> supports) const {
    MatrixXd stiffness = rest_.without_contacts().stiffness;
    if (drives_.driven.empty()) return stiffness;
    constexpr double held = 1e4;
    const contact::LawDescription& law = *contact::find_force_law(experiment_.contact);
    double ground = 0.;
    for (const Support& support : supports) {
      const contact::LinearContact linear = law.linearise(weight_, support.place.material);
      const VectorXd along = support.place.lever * eigen(support.place.normal);
      ground = std::max(ground, linear.normal_stiffness * along.squaredNorm());
    }
    const MatrixXd levers = rest_.joint_levers();
    for (const DrivenJoint& drive : drives_.driven) {
      const VectorXd lever = levers.row(static_cast<Eigen::Index>(drive.joint)).transpose();
      const double k = drive.goal ? drive.proportional : held * ground / lever.squaredNorm();
      stiffness += k * lever * lever.transpose();
    }
    return stiffness;
  }

  /// The supports that carry, and those that begin inside the ground.
  static Stance stance(std::span<const Support> supports, const std::vector<double>& loads,
                       const Pushes& pushes) {
    Stance stance{{}, pushes.loads};
    for (std::size_t i = 0; i < supports.size(); ++i) {
      CarryingPoint point = supports[i].place;
      point.load = loads[i];
      if (point.load == 0. && !(supports[i].depth > 0.)) continue;
      stance.points.push_back(point);
      stance.loads.push_back({point.point, point.load * point.normal});
    }
    return stance;
  }

  void add_landings() {
    const double sink = deepest_sink();
    if (rest_.robot().model().mobile()) {
      add_faces(supports_, sink);
      return;
    }
    // What hangs from a fixed base lands with one link or another.
    for (auto first = supports_.begin(); first != supports_.end();) {
      const auto last = std::find_if(first, supports_.end(), [&](const Support& support) {
        return support.place.point.body != first->place.point.body;
      });
      add_faces({first, last}, sink);
      first = last;
    }
  }

  /// How deep the whole weight sinks on one point: so far apart, points touch together [m].
  double deepest_sink() const {
    const contact::LawDescription& law = *contact::find_force_law(experiment_.contact);
    double deepest = 0.;
    for (const Support& support : supports_)
      deepest = std::max(deepest, law.static_depth(weight_, support.place.material));
    return deepest;
  }

  void add_faces(std::span<const Support> supports, double sink) {
    std::vector<Vector3d> points;
    for (const Support& support : supports) points.push_back(support.place.point.p_WP);
    const Vector3d down = -supports.front().place.normal;
    std::vector<HullFace> faces = hull_faces(points, sink);
    for (HullFace& face : faces) {
      if (norm(face.normal) == 0.) face.normal = down;
    }
    if (faces.empty()) return;  // places that are no numbers any more
    // A body that falls may turn over on its way.
    const bool touches =
        std::ranges::any_of(supports, [](const Support& support) { return support.depth > 0.; });
    const bool rigid = rest_.robot().model().mobile() && rest_.robot().model().link_count() == 0;
    if (touches || !rigid) {
      const auto downwards = [&](const HullFace& face) { return dot(face.normal, down); };
      const double best = downwards(std::ranges::max(faces, {}, downwards));
      std::erase_if(faces, [&](const HullFace& face) {
        return downwards(face) < std::min(best, looks_down);
      });
    }
    for (const HullFace& face : faces) stances_.all.push_back(lying_on(face, supports));
  }

  /// The robot on that face, as its ground would lie there.
  Stance lying_on(const HullFace& face, std::span<const Support> supports) {
    std::vector<Support> lying;
    double lowest = -HUGE_VAL;
    for (const std::size_t i : face.points)
      lowest = std::max(lowest, dot(supports[i].place.point.p_WP, face.normal));
    for (const std::size_t i : face.points) {
      Support& support = lying.emplace_back(supports[i]);
      support.depth = dot(support.place.point.p_WP, face.normal) - lowest;
      support.place.normal = -face.normal;
    }
    const auto loads =
        settle(lying, pushes(norm(experiment_.gravity) * face.normal, false), any_tilt);
    // Where it finds no rest its points share the weight.
    const double share = weight_ / static_cast<double>(lying.size());
    Stance stance;
    for (std::size_t i = 0; i < lying.size(); ++i) {
      CarryingPoint& point = stance.points.emplace_back(std::move(lying[i].place));
      point.load = loads ? (*loads)[i] : share;
    }
    return stance;
  }

  const Experiment& experiment_;
  const RobotAtRest& rest_;
  AnalysisBudget& budget_;
  Drives drives_;
  VectorXd own_pushes_;  ///< of all joints and of springs of loops, over z
  double weight_;        ///< [N]
  std::vector<Support> supports_;
  Stances stances_;
};

}  // namespace

bool hang(const Experiment& experiment, std::size_t index, const WiredControl& control,
          RobotSystem& robot, AnalysisBudget& budget) {
  /// Of a try, of any joint [rad, m].
  constexpr double longest_turn = 0.3;
  constexpr int most_tries = 200;
  /// Of all weights and their levers: what may be left of them at rest.
  constexpr double balanced = 1e-9;
  /// Of the most negative stiffness: makes it positive by half, and a try goes downhill.
  constexpr double steepened = 1.5;
  constexpr double tiny = 1e-300;
  const Drives drives{experiment, index, driven_of(control, index)};
  if (robot.model().mobile() || robot.model().link_count() == 0) return false;
  if (!std::ranges::all_of(drives.driven,
                           [](const DrivenJoint& drive) { return drive.goal.has_value(); }))
    return false;
  std::vector<double> q(robot.position_size()), v(robot.velocity_size(), 0.);
  double loops_pulled = 0.;  // the most on any try: at rest springs may pull at nothing
  for (int i = 0; i < most_tries; ++i) {
    // The robot at rest, its stiffness, a solution, and its eigenvalues where it may fall over.
    const double work = 3. * std::pow(static_cast<double>(robot.dof_count()), 3);
    if (!budget.leaves_half(work)) return false;
    budget.spend(work);
    const RobotAtRest rest(robot);
    const std::vector<SteadyLoad> weights = rest.weights(experiment.gravity);
    std::vector<SteadyLoad> loads = weights;
    double most = tiny;
    for (const SteadyLoad& weight : weights)
      most += rest.lever_size(weight.point) * norm(weight.force);
    double most_of_loops = 0.;
    for (const SteadyLoad& load : rest.loop_loads()) {
      most_of_loops += rest.lever_size(load.point) * norm(load.force);
      loads.push_back(load);
    }
    loops_pulled = std::max(loops_pulled, most_of_loops);
    most += loops_pulled;
    const VectorXd left = drives.torques(rest) + rest.pushed_by(loads);
    MatrixXd stiffness = rest.without_contacts().stiffness + rest.stiffness_of(weights);
    const MatrixXd levers = rest.joint_levers();
    for (const DrivenJoint& drive : drives.driven) {
      const VectorXd lever = levers.row(static_cast<Eigen::Index>(drive.joint)).transpose();
      stiffness += drive.proportional * lever * lever.transpose();
    }
    if (left.norm() <= balanced * most) return i > 0;
    double shift = balanced * most;
    if (!is_positive(stiffness)) shift += std::max(0., steepened * largest_eigenvalue(-stiffness));
    const VectorXd turn =
        levers *
        solve_positive(stiffness + shift * MatrixXd::Identity(rest.size(), rest.size()), left);
    if (!turn.allFinite()) return false;
    const double part = std::min(1., longest_turn / std::max(turn.cwiseAbs().maxCoeff(), tiny));
    robot.robot().write_positions(q);
    for (std::size_t joint = 0; joint < q.size(); ++joint)
      q[joint] += part * turn[static_cast<Eigen::Index>(joint)];
    robot.settle_at(q, v);
  }
  return false;
}

Stances find_stances(const Experiment& experiment, std::size_t index, const RobotAtRest& rest,
                     const WiredControl& control, AnalysisBudget& budget) {
  return StanceFinder(experiment, index, rest, control, budget).find();
}

}  // namespace hookpoint::simulation
