// What a World says beside what is read of it.
#pragma once

#include <string_view>

#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {

/// Set by --set or by a study's subject, not where the object is written.
bool set_from_outside(const language::Object& object, std::string_view field);

/// Warns of constants of Materials in use, of ground and feet, that the World's file states and the law does not read.
void warn_of_unread_constants(const language::Object& world, Loading& loading);

}  // namespace hookpoint::simulation
