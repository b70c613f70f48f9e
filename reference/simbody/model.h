// Simbody behind plain values. Its headers do not compile as C++20, and ours not as anything less,
// so that the one file that sees them meets the others here, in C++17.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace hookpoint::reference::simbody {

using Vec = std::array<double, 3>;

struct Frame {
  Vec position{};                                     ///< [m]
  std::array<double, 4> orientation{1., 0., 0., 0.};  ///< w, x, y, z
};

/// SI. Stiffness and dissipation are those of each of two equal surfaces.
struct Material {
  double stiffness = 0., dissipation = 0., static_friction = 0., kinetic_friction = 0.;
  double transition_velocity = 0.;
  bool penalty = false;  ///< the next three make the contact, without Hertz
  double normal_stiffness = 0., normal_damping = 0., tangential_damping = 0.;
};

/// What of a body may meet the ground: a brick, a ball, or a ball in place of a point, which meets
/// ground that is lowered by its radius.
struct Surface {
  enum class Kind { brick, ball, point };
  Kind kind = Kind::brick;
  Frame X_BS;
  Vec half_lengths{};  ///< of a brick [m]
  double radius = 0.;  ///< of a ball [m]
  int point = -1;      ///< index among the touching points; -1: none of them
  Material material;
};

struct Body {
  enum class Mobility { fixed, free, planar, turning, sliding };
  Mobility mobility = Mobility::free;
  /// Of a planar one: the plane's frame at the start, its normal along z.
  Frame X_WF{};
  int parent = -1;                     ///< index of the carrying body; -1: the world
  Frame X_PL0;                         ///< pose in the parent, of a joint at 0
  double mass = 0.;                    ///< [kg]
  Vec center_of_mass{};                ///< body axes [m]
  std::array<double, 6> inertia{};     ///< about it: xx, yy, zz, xy, xz, yz [kg m^2]
  Vec velocity{}, angular_velocity{};  ///< of a base, world axes [m/s], [rad/s]
  double angle = 0., rate = 0.;        ///< of a joint [rad, m], [rad/s, m/s]
  std::vector<Surface> surfaces;
};

struct Plane {
  Vec normal{};         ///< unit, out of the ground
  double offset = 0.;   ///< of the plane along it [m]
  double lowered = 0.;  ///< for balls in place of points [m]
};

struct Description {
  Vec gravity{};
  double accuracy = 1e-3;
  Material material;  ///< of the ground
  std::optional<Plane> ground;
  std::vector<Body> bodies;
};

/// World axes, of the body frame's origin.
struct Motion {
  Frame frame;
  Vec velocity{}, angular_velocity{};
  double angle = 0., rate = 0.;
};

/// What the ground does to a surface now.
struct Touch {
  int body = 0, point = -1;
  Vec position{};  ///< where the force acts, world axes [m]
  Vec force{};     ///< on the body, world axes [N]
  int count = 0;   ///< corners of a brick inside the ground, or 1
};

/// Torque [N m] and force [N] on a body at its frame's origin, world axes.
struct Load {
  Vec torque{}, force{};
};

class Model {
 public:
  explicit Model(const Description& description);
  ~Model();

  /// What acts from now on, one a body. `on_joints` too, its entries for bodies without a joint
  /// unused [N m, N]. The integrator keeps its history where nothing changes.
  void apply(const std::vector<Load>& on_bodies, const std::vector<double>& on_joints);
  /// Throws std::exception where the integrator gives up, or needs more steps than any motion that
  /// is worth following does. The model may not be queried after that.
  void step_to(double time);
  Motion motion(int body) const;
  std::vector<Touch> touches() const;
  /// Of the ground on the body in the last step, world axes [N s].
  Vec ground_impulse(int body) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hookpoint::reference::simbody
