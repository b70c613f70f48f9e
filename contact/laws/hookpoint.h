// The paper's law: a spring-damper hooked to the ground where the point came in, with the hook
// dragged along by return mapping when friction is exceeded (Reichler & Delcomyn 2000, 3.3; return
// mapping as in plasticity, Simo & Hughes 1998).
#pragma once

#include "contact/laws/clipped_bristle.h"
#include "contact/laws/hook.h"

namespace hookpoint::contact {

/// A law with a DraggedHook as dt -> 0. The map of a slip is backward Euler on
///   c_t e' = mu_k N t - k_t e,
/// the slip of a clipped bristle, and a hook that stays is e' = v. A hook moved once a step makes a
/// saw that no tolerance of an integrator takes away; here its stretch e is the bristle.
template <class Law>
struct ReturnMapRateForm : Law {
  static constexpr std::size_t bristle_states = 3;

  /// Force on the robot, bristle rate and next memory of one point with Law's normal force;
  /// friction by stick_slip_reaction. O(1), pure, no branch on state.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    const Real depth_rate = -dot(point.velocity, point.normal);
    return stick_slip_reaction(point, memory, material, dt,
                               Law::normal_force(point.depth, depth_rate, material));
  }

  static double switching_value(const PointKinematics<double>& point, const Memory<double>& memory,
                                const Constants& material) {
    const double depth_rate = -dot(point.velocity, point.normal);
    return stick_slip_switching_value(point, memory, material,
                                      Law::normal_force(point.depth, depth_rate, material));
  }
  static bool slides_after(bool falling, const Memory<double>& memory, const Constants& material) {
    return stick_slip_slides_after(falling, memory, material);
  }
};

/// A hook that slip drags along by return mapping:
///   e = (mu_k N t + (c_t/dt) e_old)/(k_t + c_t/dt)
/// so that f = k_t e + c_t (e - e_old)/dt also holds while slipping. Where the damper alone would
/// pull (N = 0) this reads e' = -(k_t/c_t) e: no friction, and the stretch relaxes. Needs k_t > 0.
struct DraggedHook {
  template <class Law>
  using RateForm = ReturnMapRateForm<Law>;

  /// e [m] of a slip with the friction `kinetic` mu_k N t [N] over a step `dt` [s].
  template <class Real>
  static Vector3<Real> slipped_stretch(const HookTrial<Real>& trial, const Vector3<Real>& kinetic,
                                       const MaterialConstants<Real>& material, const Real& dt) {
    const Real damping_rate = material.tangential_damping / dt;
    return (1. / (material.tangential_stiffness + damping_rate)) *
           (kinetic + damping_rate * trial.old_stretch);
  }
};

struct Hookpoint : HookedSpringDamper<Hookpoint, DraggedHook> {
  static constexpr const char* name = "hookpoint";
  static constexpr const char* source = "Reichler & Delcomyn 2000, 3.3";
  static constexpr const char* summary =
      "linear spring-damper; tangential spring to a hook that slip drags along (return mapping)";
};

}  // namespace hookpoint::contact
