// What a World may say of engines beside ours. This folder knows none: who links them says it
// (reference/engines.h).
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace hookpoint::simulation {

/// Settings that every peer has, or may have.
inline constexpr std::array common_settings{"default", "recommended", "matched"};

struct PeerChoices {
  /// A setting that one of them has alone.
  struct Setting {
    std::string name;  ///< as in `settings = noslip`
    std::string doc;   ///< what it is, for the manual
  };
  std::vector<std::string> engines;  ///< as in `engine = ode`, in the order of the manual
  std::vector<Setting> settings;     ///< beside common_settings

  bool knows_setting(const std::string& name) const {
    return std::ranges::count(common_settings, name) > 0 ||
           std::ranges::count(settings, name, &Setting::name) > 0;
  }
};

}  // namespace hookpoint::simulation
