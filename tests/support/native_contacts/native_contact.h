// A ball on a plane in an engine's own words, without anything of ours: where translated parameters are given to
// the engine as its users give them. C++17: some libraries' headers are no later.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace hookpoint::native {

/// SI. Its moments of inertia are so large that it does not roll.
struct Ball {
  double mass, radius, deltat;
};
constexpr double great_inertia = 1e4;  // [kg m^2]

class Contact {
 public:
  virtual ~Contact() = default;
  /// `depth` of the ball's lowest point below the plane [m], `approach` its speed downwards [m/s].
  virtual void start(double depth, double approach, std::array<double, 3> gravity) = 0;
  virtual void step() = 0;
  virtual std::array<double, 3> position() const = 0;  ///< of the centre, over the plane z = 0 [m]
  virtual std::array<double, 3> velocity() const = 0;  ///< [m/s]
};

/// `snippet`: XML of <mujoco>. Of a library that this build lacks there is no function (HOOKPOINT_NATIVE_NAME).
std::unique_ptr<Contact> mujoco_contact(const Ball& ball, const std::string& snippet);
/// A model of MuJoCo after so many steps from its first keyframe.
struct MujocoRun {
  std::vector<double> positions;  ///< qpos
  double deepest = 0.;            ///< how far the lowest ball reaches below z = 0 [m]
  std::vector<double>
      inverse_weights;  ///< body_invweight0, translational, the world's first [1/kg]
};
/// Throws std::runtime_error with MuJoCo's words about the XML.
MujocoRun mujoco_run(const std::string& xml, int steps);
std::unique_ptr<Contact> ode_contact(const Ball& ball, double mu, double soft_erp, double soft_cfm,
                                     double slip);
std::unique_ptr<Contact> bullet_contact(const Ball& ball, double stiffness, double damping,
                                        double friction, bool anchor);
/// btMultiBody in a world set up as PyBullet's server.
std::unique_ptr<Contact> pybullet_contact(const Ball& ball, double stiffness, double damping,
                                          double friction, bool anchor);
std::unique_ptr<Contact> dart_contact(const Ball& ball, double error_reduction,
                                      double correction_speed, double mixing, double slip,
                                      double friction);
std::unique_ptr<Contact> simbody_contact(const Ball& ball, double stiffness, double dissipation,
                                         double us, double ud, double transition_velocity);

}  // namespace hookpoint::native
