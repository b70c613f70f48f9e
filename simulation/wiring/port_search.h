// The ports that a user's pattern means: one trail, a vector's, or all that a glob fits.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulation/wiring/ports.h"

namespace hookpoint::simulation {

/// Whether `pattern` fits all of `text`: `?` one character of a name, `*` any number of them, `**`
/// any number whatever they are, dots too. One longer than any trail, of more than 1000 bytes, fits
/// nothing. O(pattern * text).
bool glob_fits(std::string_view pattern, std::string_view text);

/// Of an element's trail that of its whole: "block.base.location" of "block.base.location.x",
/// "gait.goal" of "gait.goal[3]"; "" of a trail that is no element's.
std::string_view whole_of(std::string_view trail);

/// The ports that `pattern` names, in the order of `ports`, none twice, under the names by which
/// they are requested: from the top, or from within the world. A glob fits elements and wholes: all
/// elements of a whole count. Their values are right from now on. Throws ExperimentError naming
/// what is near when there is none. O(ports).
std::vector<Port> find_ports(const Experiment& experiment, const std::vector<Port>& ports,
                             const std::string& pattern);
/// Of several patterns, one after the other; a port that a glob or a vector names is not repeated.
std::vector<Port> find_all_ports(const Experiment& experiment, const std::vector<Port>& ports,
                                 const std::vector<std::string>& patterns);

}  // namespace hookpoint::simulation
