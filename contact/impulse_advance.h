// The time advance of the impulse laws for one rigid body: ballistic flight to the next impact,
// collision, and so on until the step is used up. Nothing ever enters the ground (Mirtich 1996,
// chapter 2; docs/contact_impulse.md).
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "contact/impulse.h"
#include "contact/impulse_flight.h"
#include "contact/impulse_reversal.h"

namespace hookpoint::contact {

/// How collisions are answered: each by itself, or microcollisions of all near points together
/// (impulse_reversal.h).
enum class ImpulseLaw { impulse, impulse_reversal };

struct ImpulseBody {
  double mass = 0.;                       ///< [kg]
  Vector3d center_of_mass;                ///< in body axes, from the body's origin [m]
  Symmetric3d inertia;                    ///< about the centre of mass, body axes [kg m^2]
  std::vector<Vector3d> boundary_points;  ///< p_BP, body axes [m]
};

/// Motion of the body frame's origin, world axes, SI: as dts::State without joints.
struct ImpulseState {
  Vector3d position;          ///< p_WB [m]
  Quaterniond orientation;    ///< R_WB, unit
  Vector3d velocity;          ///< v_WB [m/s]
  Vector3d angular_velocity;  ///< w_WB [rad/s]
};

/// The tile under a point.
struct GroundPoint {
  double gap = 0.;  ///< distance to the tile's plane, > 0 above it [m]
  Vector3d normal;  ///< unit, out of the ground
  const MaterialConstants<double>* material = nullptr;
};

/// Any callable `GroundPoint(const Vector3d& world_point)`, referred to, not owned.
class GroundQuery {
 public:
  template <class Ground>
  requires(!std::is_same_v<Ground, GroundQuery>) GroundQuery(
      const Ground& ground)  // NOLINT(google-explicit-constructor): a view, like std::span
      : ground_(&ground), query_([](const void* self, const Vector3d& point) -> GroundPoint {
          return (*static_cast<const Ground*>(self))(point);
        }) {}
  GroundPoint operator()(const Vector3d& point) const { return query_(ground_, point); }

 private:
  const void* ground_;
  GroundPoint (*query_)(const void*, const Vector3d&);
};

struct ImpulseOptions {
  double tolerance =
      1e-12;  ///< |gap| at which a point touches [m]; lower reaches rounding, higher hides u0
  double largest_turn =
      0.02;  ///< of one flight's orientation step [rad]; higher is faster and less exact
  double largest_travel =
      0.05;  ///< of the centre of mass in one flight step [m]: below the width of a ridge
  int most_impacts = 20000;  ///< in one call; more is reported, not endured
};

enum class AdvanceStatus { ok, not_finite, inside_ground, too_many_impacts, unsolved_collision };
/// What to change, one sentence.
const char* advice(AdvanceStatus status);

struct AdvanceResult {
  AdvanceStatus status = AdvanceStatus::ok;
  std::int64_t impacts = 0;    ///< collisions resolved
  std::int64_t lift_offs = 0;  ///< times that a point which had been hit left the ground
  int contacts = 0;            ///< boundary points that were hit at least once
  Vector3d impulse;            ///< sum over the step, on the body [N s]
  Vector3d
      angular_impulse;  ///< likewise, about the centre of mass where it was at each impact [N m s]
  double deepest = 0.;  ///< greatest -gap of a boundary point at an impact or at the end, >= 0 [m]
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
  /// `inside_ground`. Impacts at one instant are resolved one after another, the fastest approach
  /// first (of equals the first point), until no touching point approaches. Cost: about one ground
  /// query a point and flight, and one collision an impact.
  AdvanceResult advance(ImpulseState& state, double dt, const ImpulseLoad& load,
                        const GroundQuery& ground);

 private:
  struct Touch {
    Vector3d arm;  // from the centre of mass, world axes [m]
    GroundPoint ground;
  };

  FlightState flight_from(const ImpulseState& state) const;
  ImpulseState state_from(const FlightState& flight) const;
  void locate(const FlightState& flight, const GroundQuery& ground);
  double lowest_gap() const;
  double safe_time(const FlightState& flight, const FlightLoad& load, double longest) const;
  FlightState fly_above(const FlightState& flight, const FlightLoad& load,
                        const GroundQuery& ground, double longest, double* duration);
  AdvanceStatus collide(FlightState& flight, const FlightLoad& load, AdvanceResult& result);
  bool reverse(FlightState& flight, const FlightLoad& load, const Vector3d& w, int hit,
               AdvanceResult& result);
  void apply(std::size_t point, const Vector3d& impulse, FlightState& flight,
             AdvanceResult& result);
  int fastest_approach(const FlightState& flight, const Vector3d& w) const;
  Symmetric3d collision_matrix(const FlightState& flight, const Vector3d& arm) const;

  FlightInertia inertia_;
  ImpulseLaw law_;
  ImpulseOptions options_;
  Vector3d center_of_mass_;
  std::vector<Vector3d> arms_;  // of the boundary points from the centre of mass, body axes [m]
  std::vector<Touch> points_;   // the same at the present flight state, with the ground under them
  std::vector<ReversalPoint>
      near_;  // those that a microcollision reverses together, and their indices
  std::vector<std::size_t> near_index_;
  std::vector<char> hit_now_, hit_;
};

}  // namespace hookpoint::contact
