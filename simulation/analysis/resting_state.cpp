#include "simulation/analysis/resting_state.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "contact/force_law.h"
#include "simulation/experiment/contact_materials.h"
#include "simulation/experiment/kinematics.h"

namespace hookpoint::simulation {
namespace {

/// Residual force and torque over weight and weight times size: balanced to rounding, and what is
/// still taken as balanced where rounding of depths leaves more.
constexpr double at_rest = 1e-14, nearly_at_rest = 1e-10;
/// Of the friction limit: a point that would be beyond it is put just inside, where it holds.
constexpr double inside_cone = 1. - 1e-9;

/// One way to change the state: a small motion, or a steady velocity, along `along` and about
/// `about` (world axes) through the centre of mass.
struct Freedom {
  Vector3d along, about;
  bool is_velocity = false;
};

/// Of the robot that is free, or kept in a plane: on a tile with normal `n`. A law without
/// tangential spring holds by moving along the tile.
std::vector<Freedom> freedoms(const RobotSpec& robot, const Vector3d& n, bool springs) {
  if (robot.plane_normal) {
    const Vector3d axis{*robot.plane_normal == 0 ? 1. : 0., *robot.plane_normal == 1 ? 1. : 0.,
                        *robot.plane_normal == 2 ? 1. : 0.};
    const Vector3d up = n - dot(n, axis) * axis;
    if (!(norm(up) > 0.1)) return {};
    const Vector3d unit = (1. / norm(up)) * up;
    return {{unit, {}, false}, {cross(axis, unit), {}, !springs}, {{}, axis, false}};
  }
  const Vector3d other = std::abs(n.x) < 0.5 ? Vector3d{1., 0., 0.} : Vector3d{0., 1., 0.};
  const Vector3d across = cross(n, other);
  const Vector3d t = (1. / norm(across)) * across, s = cross(n, t);
  return {{n, {}, false}, {t, {}, !springs}, {s, {}, !springs},
          {{}, t, false}, {{}, s, false},    {{}, n, !springs}};
}

Quaterniond rotation_by(const Vector3d& vector) {
  const double angle = norm(vector);
  const double part = angle > 1e-8 ? std::sin(0.5 * angle) / angle : 0.5;
  return {std::cos(0.5 * angle), part * vector.x, part * vector.y, part * vector.z};
}

class RestSearch {
 public:
  RestSearch(const Experiment& experiment, const RobotSpec& robot, const contact::Terrain& ground,
             const contact::LawDescription& law)
      : experiment_(experiment), robot_(robot), ground_(ground), law_(law), materials_(experiment) {
    const std::vector<const BodySpec*> bodies = bodies_of(robot);
    const std::vector<Pose> X_BL = body_poses(robot);
    Vector3d moment;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const MassSpec& mass = bodies[i]->mass;
      moment += mass.mass * (X_BL[i].position + rotate(X_BL[i].orientation, mass.center_of_mass));
    }
    const double mass = robot_mass(robot);
    center_of_mass_ = (1. / mass) * moment;
    center_ = robot.location + rotate(robot.orientation, center_of_mass_);
    for (const RobotPoint& point : points_in_base(robot)) {
      arms_.push_back(rotate(robot.orientation, point.p_BP - center_of_mass_));
      radii_.push_back(point.radius);
      foot_materials_.push_back(point.material);
    }
    for (const Vector3d& arm : arms_) size_ = std::max(size_, norm(arm));
    if (size_ == 0.) size_ = 1.;
    weight_ = mass * experiment.gravity;
    const contact::TilePoint below = ground.query(center_);
    const auto& material = materials_.of(
        foot_materials_.empty() ? no_material : foot_materials_.front(), below.material);
    springs_ = law.linearise(norm(weight_), material).tangential_stiffness > 0.;
    freedoms_ = freedoms(robot, below.normal, springs_);
    depth_ =
        std::abs(law.static_depth(norm(weight_) / static_cast<double>(arms_.size()), material));
    speed_ = material.regularisation_speed;
    farthest_shift_ = farthest_tilt * size_ + 10. * deflection(below.normal, material);
  }

  Resting find() {
    const auto count = static_cast<Eigen::Index>(freedoms_.size());
    Eigen::VectorXd x = Eigen::VectorXd::Zero(count);
    Eigen::VectorXd residual = residual_at(x);
    if (residual.norm() < 1e-12) return {};
    constexpr int most_steps = 60;
    for (int i = 0; i < most_steps && residual.norm() > at_rest; ++i) {
      if (i > 1 && evaluations_ > most_evaluations)
        return {std::nullopt, "the balance of so many boundary points takes too long to find"};
      const Eigen::VectorXd step =
          -jacobian(x, residual).completeOrthogonalDecomposition().solve(residual);
      if (!advance(x, residual, step) || !is_near(x)) break;
    }
    if (residual.norm() < nearly_at_rest && is_near(x)) return {state_at(x), ""};
    return {std::nullopt, why_not()};
  }

 private:
  /// Of what can keep a weight from being balanced, what this ground can do.
  std::string why_not() const {
    const bool rough = std::holds_alternative<GridSpec>(ground_.description().surface);
    return std::string(
               "nothing balances its weight there: the slope is steeper than friction "
               "holds, it rolls, or it tips over") +
           (rough ? "; or the points that bear it lie on tiles of several slopes, between which it "
                    "settles by moving"
                  : "");
  }

  /// How far the touching points deflect where they share the weight evenly [m].
  double deflection(const Vector3d& normal,
                    const contact::MaterialConstants<double>& material) const {
    const auto touching = std::ranges::count_if(arms_, [&](const Vector3d& arm) {
      const auto i = static_cast<std::size_t>(&arm - arms_.data());
      return ground_.query(center_ + arm).depth + radii_[i] > 0.;
    });
    const double load = norm(weight_) / static_cast<double>(std::max<std::ptrdiff_t>(1, touching));
    const double along = springs_ ? norm(tangential(weight_, normal)) / norm(weight_) * load /
                                        material.tangential_stiffness
                                  : 0.;
    return std::abs(law_.static_depth(load, material)) + along;
  }

  /// Of a unit of each unknown: tilts move points by as much as shifts do.
  double unit(const Freedom& freedom) const { return norm(freedom.about) > 0. ? 1. / size_ : 1.; }

  /// Halves the step until it brings the forces nearer to balance.
  bool advance(Eigen::VectorXd& x, Eigen::VectorXd& residual, const Eigen::VectorXd& step) {
    for (double part = 1.; part > 1e-9; part *= 0.5) {
      const Eigen::VectorXd tried = x + part * step;
      const Eigen::VectorXd left = residual_at(tried);
      if (!(left.norm() < residual.norm())) continue;
      x = tried;
      residual = left;
      return true;
    }
    return false;
  }

  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) {
    Eigen::MatrixXd slopes(residual.size(), x.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const double h =
          1e-4 * (freedoms_[static_cast<std::size_t>(k)].is_velocity ? speed_ : depth_);
      Eigen::VectorXd moved = x;
      moved(k) += h;
      slopes.col(k) = (residual_at(moved) - residual) / h;
    }
    return slopes;
  }

  /// Motions and velocities of an x.
  struct Moved {
    Vector3d shift, turn, velocity, spin;
  };
  Moved moved(const Eigen::VectorXd& x) const {
    Moved sum;
    for (std::size_t k = 0; k < freedoms_.size(); ++k) {
      const Freedom& freedom = freedoms_[k];
      const double value = x(static_cast<Eigen::Index>(k)) * unit(freedom);
      (freedom.is_velocity ? sum.velocity : sum.shift) += value * freedom.along;
      (freedom.is_velocity ? sum.spin : sum.turn) += value * freedom.about;
    }
    return sum;
  }
  /// Whether the robot rests on what it was placed on.
  bool is_near(const Eigen::VectorXd& x) const {
    const Moved by = moved(x);
    return norm(by.turn) <= farthest_tilt && norm(by.shift) <= farthest_shift_;
  }

  /// A point that touches: where it does, and the ground's force on it.
  struct Touch {
    Vector3d arm, force, stretch;
  };
  Touch touch(std::size_t i, const Moved& by) const {
    const double radius = radii_[i];
    const Vector3d arm = rotate(rotation_by(by.turn), arms_[i]);
    const contact::TilePoint tile = ground_.query(center_ + by.shift + arm);
    const auto& material = materials_.of(foot_materials_[i], tile.material);
    const Vector3d down = -radius * tile.normal;
    Touch made{arm + down, {}, {}};
    const Vector3d velocity = by.velocity + cross(by.spin, made.arm);
    const contact::PointKinematics<double> point{
        center_ + by.shift + made.arm, velocity, tile.normal, tile.depth + radius, {}};
    made.force = law_.evaluate(point, {}, material, experiment_.deltat).force;
    const double load = dot(made.force, tile.normal);
    if (material.adhesion > 0. && load > 0.) made.force -= material.adhesion * tile.normal;
    if (!springs_) return made;
    const Vector3d way = by.shift + (arm - arms_[i]) + cross(by.turn, down);
    made.stretch = tangential(way, tile.normal);
    const double pull = material.tangential_stiffness * norm(made.stretch);
    const double limit = inside_cone * material.static_friction * load;
    if (pull > limit) made.stretch = (limit / pull) * made.stretch;
    made.force -= material.tangential_stiffness * made.stretch;
    return made;
  }

  Eigen::VectorXd residual_at(const Eigen::VectorXd& x) {
    const Moved by = moved(x);
    evaluations_ += static_cast<std::int64_t>(arms_.size());
    Vector3d force = weight_, torque;
    for (std::size_t i = 0; i < arms_.size(); ++i) {
      const Touch at = touch(i, by);
      force += at.force;
      torque += cross(at.arm, at.force);
    }
    const double whole = norm(weight_);
    Eigen::VectorXd left(static_cast<Eigen::Index>(freedoms_.size()));
    for (std::size_t k = 0; k < freedoms_.size(); ++k) {
      const Freedom& freedom = freedoms_[k];
      left(static_cast<Eigen::Index>(k)) =
          (dot(freedom.along, force) + dot(freedom.about, torque) * unit(freedom)) / whole;
    }
    return left;
  }

  RestingState state_at(const Eigen::VectorXd& x) const {
    const Moved by = moved(x);
    RestingState state;
    state.orientation = normalized(rotation_by(by.turn) * robot_.orientation);
    const Vector3d arm = rotate(state.orientation, center_of_mass_);
    state.location = center_ + by.shift - arm;
    state.velocity = by.velocity - cross(by.spin, arm);
    state.angular_velocity = by.spin;
    for (std::size_t i = 0; springs_ && i < arms_.size(); ++i)
      state.stretch.push_back(touch(i, by).stretch);
    return state;
  }

  const Experiment& experiment_;
  const RobotSpec& robot_;
  const contact::Terrain& ground_;
  const contact::LawDescription& law_;
  ContactMaterials materials_;
  Vector3d center_of_mass_;     ///< base axes [m]
  Vector3d center_;             ///< of mass, at the robot's pose, world axes [m]
  std::vector<Vector3d> arms_;  ///< from there to the boundary points, body by body [m]
  std::vector<double> radii_;   ///< of their balls [m]
  std::vector<int> foot_materials_;
  double size_ = 0.;      ///< the longest of them, 1 m where all are 0 [m]
  Vector3d weight_;       ///< [N]
  bool springs_ = false;  ///< the law has a tangential spring
  std::vector<Freedom> freedoms_;
  double depth_ = 0.;             ///< of the points, about [m]
  double speed_ = 0.;             ///< of creep, about [m/s]
  double farthest_shift_ = 0.;    ///< [m]
  std::int64_t evaluations_ = 0;  ///< of the law at a point
};

}  // namespace

Resting resting_state(const Experiment& experiment, const RobotSpec& robot,
                      const contact::Terrain& ground) {
  const auto* const law = contact::find_force_law(experiment.contact);
  if (!law || experiment.engine != Experiment{}.engine) return {};
  bool moves = norm(robot.velocity) > 0. || norm(robot.angular_velocity) > 0.;
  for_each_link(robot, [&](const TreeLink& at) { moves = moves || at.link.rate != 0.; });
  if (moves) return {std::nullopt, "it moves at the start"};
  if (!(robot_mass(robot) > 0.) || !(norm(experiment.gravity) > 0.))
    return {std::nullopt, "nothing weighs it down"};
  return RestSearch(experiment, robot, ground, *law).find();
}

}  // namespace hookpoint::simulation
