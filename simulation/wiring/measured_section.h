// A section of a saved state that depends on what was measured in the run.
#pragma once

#include <string_view>

namespace hookpoint::simulation {

/// Name of the StateSection of numerical energy. Its numbers say nothing where the first of them is 0:
/// nobody had it measured then.
inline constexpr std::string_view measured_section = "numerical energy";

}  // namespace hookpoint::simulation
