// The paper's law: a spring-damper hooked to the ground where the point came in, with the hook
// dragged along by return mapping when friction is exceeded (Reichler & Delcomyn 2000, 3.3; return
// mapping as in plasticity, Simo & Hughes 1998).
#pragma once

#include "contact/laws/return_map.h"

namespace hookpoint::contact {

struct Hookpoint : SpringDamperPredictions {
  static constexpr const char* name = "hookpoint";
  static constexpr const char* source = "Reichler & Delcomyn 2000, 3.3";
  static constexpr const char* summary =
      "linear spring-damper; tangential spring to a hook that slip drags along (return mapping)";

  /// Force on the robot and next memory of one point: N = max(0, k d + c d'), friction by
  /// return_mapped_reaction, whose needs are this law's.
  template <class Real>
  static Reaction<Real> evaluate(const PointKinematics<Real>& point, const Memory<Real>& memory,
                                 const MaterialConstants<Real>& material, const Real& dt) {
    return return_mapped_reaction(
        point, memory, material, dt,
        normal_force(point.depth, Real(-dot(point.velocity, point.normal)), material));
  }
};

}  // namespace hookpoint::contact
