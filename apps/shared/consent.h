// What may run with the user's rights beside the program's own code, by the user's word.
#pragma once

#include <vector>

#include "apps/shared/trust.h"

namespace hookpoint::application {

/// Of any folder, not of the trusted ones alone (trust.h).
struct Consent {
  bool plugins = false;
  bool engines = false;  ///< that are programs

  /// The options that give it.
  std::vector<const char*> options() const {
    std::vector<const char*> given;
    if (plugins) given.push_back(plugin_trust.option);
    if (engines) given.push_back(engine_trust.option);
    return given;
  }
};

}  // namespace hookpoint::application
