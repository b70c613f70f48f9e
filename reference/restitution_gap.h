// The coefficient of restitution of engines that read it, but not at `settings = matched`.
#pragma once

#include <string_view>

#include "reference/experiment_checks.h"

namespace hookpoint::reference {

namespace feature {
inline constexpr std::string_view matched_restitution = "restitution at `settings = matched`";
}

inline constexpr OwnGap matched_restitution_gap{
    feature::matched_restitution, simulation::EngineGap::Handling::noticed,
    "a body rebounds by the material's spring and damper; `restitution` is not read"};

}  // namespace hookpoint::reference
