// Every constant of every setting of the peers, in one place: the worlds read it, the tables print
// it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "reference/engines.h"
#include "simulation/experiment.h"

namespace hookpoint::reference {

enum class Settings { default_, recommended, matched, noslip };

/// Names that `settings =` accepts for an engine, in the order of the enumeration: the first three,
/// and for mujoco `noslip` too.
std::vector<std::string> settings_names(std::string_view engine);
/// The setting of `experiment`. Throws ExperimentError that lists the names.
Settings settings_of(const simulation::Experiment& experiment, std::string_view engine);

enum class OdeSolver { step, quickstep };

struct OdeSettings {
  ConstraintConstants constraint;
  bool tangential_slip =
      false;  ///< the friction rows have their own mixing (dContactSlip1, dContactSlip2)
  bool soft_normal =
      false;  ///< the normal row has its own constants (dContactSoftERP, dContactSoftCFM)
  bool restitution = true;  ///< the material's restitution is passed on (dContactBounce)
  int iterations = 20;      ///< of dWorldQuickStep
};
/// `dt` [s] and `material` enter at `matched` only.
OdeSettings ode_settings(Settings settings, OdeSolver solver, double dt,
                         const contact::MaterialConstants<double>& material);

struct BulletSettings {
  ConstraintConstants constraint;
  bool multibodies = false;        ///< every body is a btMultiBody, in the world of those
  bool contact_stiffness = false;  ///< stiffness and damping set on the bodies, split impulses off
  bool friction_anchor = false;    ///< friction rows undo the displacement of a sticking contact
  bool restitution = true;         ///< the material's restitution is passed on
  int iterations = 10;             ///< of the sequential impulse solver
  double residual_threshold = 0.;  ///< sum of squared residuals at which it stops early
  double warmstarting = 0.85;      ///< part of the last step's normal impulses to start from
};
/// `dt` [s] and `material` enter at `matched` only.
BulletSettings bullet_settings(Settings settings, double dt,
                               const contact::MaterialConstants<double>& material);

struct MujocoSettings {
  bool elliptic = false;           ///< the cone of friction; else a pyramid inside it
  double friction_impedance = 1.;  ///< R of the normal row over that of a friction row (impratio)
  double tolerance = 1e-8;         ///< of Newton's iterations
  int no_slip_iterations = 0;      ///< over the friction rows, after the problem is solved
  bool spring = false;             ///< rows are the material's springs and dampers (mujoco_row)
};
/// `dt` [s] and `material` enter at `matched` only.
MujocoSettings mujoco_settings(Settings settings, double dt,
                               const contact::MaterialConstants<double>& material);

/// A contact's constants as MuJoCo takes them. Its rows obey a = -B v - K d r - R f, with the
/// acceleration a, speed v, position r (< 0 inside) and force f along the row, and
/// R = (1 - d)/d A, where A is the body's inverse weight (MuJoCo's manual, Computation, Constraint
/// model). Friction rows have no K and R / impratio.
struct MujocoRow {
  /// solref: time constant and damping ratio, or, below 0, -K d^2 and -B d.
  std::array<double, 2> reference{0.02, 1.};
  /// solimp: the impedance d at depth 0 and from the width on, the width [m], midpoint, power.
  std::array<double, 5> impedance{0.9, 0.95, 1e-3, 0.5, 2.};
};
/// `inverse_weight`: A [1/kg], > 0.
MujocoRow mujoco_row(const MujocoSettings& settings, double dt,
                     const contact::MaterialConstants<double>& material, double inverse_weight);

struct DartSettings {
  ConstraintConstants constraint;
  double correction_speed = 1e-3;  ///< at most, of what pushes a penetration out [m/s]
  bool own_mixing = false;   ///< rows have the mixings of `constraint`, beside DART's relative one
  bool tessellated = false;  ///< spheres and cylinders collide as meshes
  bool restitution = true;   ///< the material's restitution is passed on
};
/// `dt` [s] and `material` enter at `matched` only.
DartSettings dart_settings(Settings settings, double dt,
                           const contact::MaterialConstants<double>& material);

struct SimbodySettings {
  double stiffness = 1e7;             ///< plane strain modulus of each of the two surfaces [Pa]
  double dissipation = 2.;            ///< of Hunt and Crossley, of each surface [s/m]
  double transition_velocity = 0.01;  ///< where friction is full [m/s]
  double accuracy = 1e-5;             ///< of the integrator: about the relative error of a step
  bool penalty = false;  ///< contacts are the material's k, c, c_t and mu, without Hertz
};
SimbodySettings simbody_settings(Settings settings);

}  // namespace hookpoint::reference
