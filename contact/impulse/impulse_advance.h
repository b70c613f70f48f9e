// The time advance of the impulse laws for one rigid body: ballistic flight to the next impact,
// collision, and so on until the step is used up. Nothing ever enters the ground (Mirtich 1996,
// chapter 2; docs/contact_impulse.md).
#pragma once

#include <vector>

#include "contact/impulse/impulse_flight.h"
#include "contact/impulse/impulse_resolution.h"

namespace hookpoint::contact {

struct ImpulseBody {
  double mass = 0.;                       ///< [kg]
  Vector3d center_of_mass;                ///< in body axes, from the body's origin [m]
  Symmetric3d inertia;                    ///< about the centre of mass, body axes [kg m^2]
  std::vector<Vector3d> boundary_points;  ///< p_BP, body axes [m]
  std::vector<double> boundary_radii;     ///< of the balls about the first of them; then 0 [m]
  std::vector<int> boundary_materials;    ///< numbers of those of the first; then -1, none
};

/// Motion of the body frame's origin, world axes, SI: as dts::State without joints.
struct ImpulseState {
  Vector3d position;          ///< p_WB [m]
  Quaterniond orientation;    ///< R_WB, unit
  Vector3d velocity;          ///< v_WB [m/s]
  Vector3d angular_velocity;  ///< w_WB [rad/s]
};

struct AdvanceResult : ImpulseTally {
  Vector3d impulse;  ///< sum over the step, on the body [N s]
  Vector3d
      angular_impulse;  ///< likewise, about the centre of mass where it was at each impact [N m s]
  double impulse_work = 0.;  ///< likewise, each impulse times the mean velocity of its point [J]
};

/// Everything outside the law and the ground that acts on the body during a step, world axes.
struct ImpulseLoad {
  Vector3d gravity;  ///< [m/s^2]
  Vector3d force;    ///< constant [N]
  Vector3d torque;   ///< constant, about the centre of mass [N m]
};

class ImpulseAdvance {
 public:
  /// Allocates; `advance` does not.
  ImpulseAdvance(const ImpulseBody& body, ImpulseLaw law, const ImpulseOptions& options = {});

  /// Advances `state` by `dt` [s]. On any status but ok the state is unchanged.
  /// A point that starts up to 1e-9 m inside the ground counts as touching; deeper is
  /// `inside_ground`. Impacts at one instant are resolved together, again until no touching point
  /// approaches. Cost: about one ground
  /// query a point and flight, and one collision an impact.
  AdvanceResult advance(ImpulseState& state, double dt, const ImpulseLoad& load,
                        const GroundQuery& ground);

 private:
  struct Touch {
    Vector3d center;  // of the ball, from the centre of mass, world axes [m]
    Vector3d arm;     // of the place of it that meets the ground, likewise
    GroundPoint ground;
  };
  class Struck;

  FlightState flight_from(const ImpulseState& state) const;
  ImpulseState state_from(const FlightState& flight) const;
  void locate(const FlightState& flight, const GroundQuery& ground);
  double lowest_gap() const;
  double safe_time(const FlightState& flight, const FlightLoad& load, double longest) const;
  FlightState fly_above(const FlightState& flight, const FlightLoad& load,
                        const GroundQuery& ground, double longest, double* duration);

  FlightInertia inertia_;
  ImpulseOptions options_;
  Vector3d center_of_mass_;
  std::vector<Vector3d> arms_;  // of the boundary points from the centre of mass, body axes [m]
  std::vector<double> radii_;
  std::vector<int> materials_;
  std::vector<Touch> points_;  // the same at the present flight state, with the ground under them
  ImpulseResolution resolution_;
};

}  // namespace hookpoint::contact
