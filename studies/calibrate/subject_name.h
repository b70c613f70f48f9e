// A subject by its name alone: `hunt_crossley`, `mujoco_matched`, `dts_hookpoint_rk4`.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "language/schema/schema.h"
#include "studies/plan/plan.h"

namespace hookpoint::studies {

/// What `word` names: an engine, its settings, a law, an integrator, each at most once, joined by
/// `_`, as the World's fields have them. Without an engine it is ours. Nothing where it names
/// something else.
std::optional<SubjectPlan> subject_named(const language::ClassSchema& world, std::string_view word);

/// All single names that it may hold.
std::vector<std::string> subject_parts(const language::ClassSchema& world);

}  // namespace hookpoint::studies
