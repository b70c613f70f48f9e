// What `joint = fixed` makes of a Link: a part of the body that carries it.
#pragma once

#include "language/tree/object.h"
#include "simulation/experiment/experiment.h"
#include "simulation/experiment/kinematics.h"

namespace hookpoint::simulation {

/// Of a Link's `joint`, beside the joint types.
inline constexpr const char* fixed_joint = "fixed";

/// Whether the object is a Link whose joint does not move.
bool is_fixed(const language::Object& object);

/// Whether nothing of the object moves by itself: a fixed Link, a Chain of such links alone.
bool is_part(const language::Object& object);

/// Adds `part`, whose frame stands at `X_BP` in that of `body`: mass, shapes, and boundary points
/// after those of `body`.
void add_part(const BodySpec& part, const Pose& X_BP, BodySpec& body);

}  // namespace hookpoint::simulation
