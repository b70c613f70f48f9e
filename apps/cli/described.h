// Everything that `hookpoint describe NAME` knows, each from its own table: classes, metrics and
// signals of studies, contact laws, integrators, engines and their settings.
#pragma once

#include <string>
#include <vector>

#include "apps/shared/application.h"

namespace hookpoint::cli {

/// Entries of all that is called `name`; a class by its last word too ("Slope") where no other is
/// called so. Empty after `problem` is filled.
std::vector<std::string> described(const application::Application& application,
                                   const std::string& name, std::string& problem);

}  // namespace hookpoint::cli
