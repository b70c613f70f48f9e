// What there is to choose from, for programs: every engine, law and integrator.
#pragma once

#include <string>

#include "apps/shared/application.h"

namespace hookpoint::application {

/// {"engines": [...], "laws": [...], "integrators": [...]}, what an engine lacks with it.
std::string engines_json(const Application& application);

}  // namespace hookpoint::application
