// Trails as names of MATLAB variables.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace hookpoint::output {

/// A valid name (a letter, then letters, digits and underscores, at most 63, no keyword) for each
/// path, all different and none of `taken`: "bot.leg[0].angle" becomes bot_leg_0_angle. Of a path
/// that is too long the end stays, which tells more than the beginning.
std::vector<std::string> matlab_names(std::span<const std::string> paths,
                                      std::span<const std::string> taken);

}  // namespace hookpoint::output
