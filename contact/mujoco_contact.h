// A contact as MuJoCo's files state it. Its rows obey a = -B v - K d r - R f, with the acceleration a,
// speed v, position r (< 0 inside) and force f along the row. R = (1 - d)/d A, where A is the inverse
// weight of the body that touches (MuJoCo's manual, Computation, Constraint model). Friction rows have
// no K.
#pragma once

#include <array>

namespace hookpoint::contact {

/// MuJoCo takes no impedance below this, nor above 1 less this (mjmodel.h, mjMINIMP, mjMAXIMP).
constexpr double mujoco_least_impedance = 1e-4;
/// The least coefficient of friction of a contact with friction rows (mjmodel.h, mjMINMU).
constexpr double mujoco_least_friction = 1e-5;

struct MujocoRow {
  /// solref: time constant and damping ratio, or, below 0, -K d^2 and -B d.
  std::array<double, 2> reference{0.02, 1.};
  /// solimp: the impedance d at depth 0 and from the width on, the width [m], midpoint, power.
  std::array<double, 5> impedance{0.9, 0.95, 1e-3, 0.5, 2.};

  bool operator==(const MujocoRow&) const = default;
};

/// Whether solref is one of its two forms, with a stiffness above 0.
bool is_mujoco_reference(const std::array<double, 2>& reference);
/// For who states another one.
constexpr const char* mujoco_reference_rule =
    "solref is a time constant and a damping ratio, both above 0, or -stiffness below 0 and "
    "-damping not above 0";

/// The shape and the softness of friction, one for a whole world.
struct MujocoFriction {
  bool elliptic = false;        ///< the cone of friction; else a pyramid inside it
  double impedance_ratio = 1.;  ///< R of the normal row over that of a friction row (impratio)

  bool operator==(const MujocoFriction&) const = default;
};

/// All that a Material may state of it.
struct MujocoContact {
  MujocoRow row;
  MujocoFriction friction;

  bool operator==(const MujocoContact&) const = default;
};

/// The rows' own stiffness and damping.
struct MujocoReference {
  double stiffness;  ///< K [1/s^2]
  double damping;    ///< B [1/s]
};
/// Of solref, whose time constant is two steps at least (XML reference, flag refsafe). `dt` [s]; 0:
/// as it is.
MujocoReference mujoco_reference(const MujocoRow& row, double dt);

/// The impedance d at a depth [m] (XML reference, solimp).
double mujoco_impedance(const MujocoRow& row, double depth);

/// R of each of a pyramid's rows, of that of an elliptic normal row.
double mujoco_pyramid_softness(double coefficient, const MujocoFriction& friction, double softness);

/// R of the normal direction at impedance `d` [1/kg]: (1 - d)/d A of an elliptic contact, a quarter
/// of its rows' of a pyramid, which has four. `inverse_weight`: A [1/kg]; `coefficient`: mu.
double mujoco_normal_softness(double inverse_weight, double coefficient,
                              const MujocoFriction& friction, double d);

/// What MuJoCo makes of a contact that both geometries state with the same weight and priority: means of
/// the impedances and of the references, of which the lower numbers where one is direct (XML reference,
/// geom, solmix).
MujocoRow mujoco_mixed(const MujocoRow& a, const MujocoRow& b);

/// A spring and a damper that stand and rebound as the contact does.
struct MujocoSpring {
  double depth;          ///< under the load [m]
  double stiffness;      ///< load over depth [N/m]
  double damping;        ///< [N s/m]
  double damping_ratio;  ///< of an impact: its rebound is kelvin_voigt_restitution of it
};
/// Where contact and load meet.
struct MujocoLoading {
  double load;            ///< on the contact [N], > 0
  double mass;            ///< that the contact stops in an impact [kg], > 0
  double inverse_weight;  ///< A [1/kg], > 0
  double coefficient;     ///< mu
  double dt;              ///< [s]; 0: MuJoCo's step is small beside the time constant
};
/// At rest K d r = R N: the depth r under the load N. A mass m that comes with little load on the contact obeys
/// (1 + m R) a = -B v - K d r, a spring and damper with the ratio B/(2 sqrt(K d (1 + m R))).
MujocoSpring mujoco_spring(const MujocoRow& row, const MujocoFriction& friction,
                           const MujocoLoading& at);

/// Speed [m/s] at which a foot that sticks creeps under the load along a slope of `angle` [rad]: R f/B of
/// a friction row, and (1 + mu^2) times as much of a pyramid all of whose rows carry. `depth` [m] on level ground.
double mujoco_creep(const MujocoRow& row, const MujocoFriction& friction, const MujocoLoading& at,
                    double depth, double angle);

}  // namespace hookpoint::contact
