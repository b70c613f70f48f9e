// What a World may say of engines beside ours. This folder knows none: who links them says it
// (reference/engines.h).
#pragma once

#include <string>
#include <vector>

namespace hookpoint::simulation {

struct PeerChoices {
  /// A setting that one of them has alone.
  struct Setting {
    std::string name;  ///< as in `settings = noslip`
    std::string doc;   ///< what it is, for the manual
  };
  std::vector<std::string> engines;  ///< as in `engine = ode`, in the order of the manual
  std::vector<Setting> settings;     ///< beside those that every peer has
};

}  // namespace hookpoint::simulation
