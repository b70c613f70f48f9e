// What a World says beside what is read of it.
#pragma once

#include <string_view>

#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {

/// Set by --set or by a study, or worked out of Params that are, not where the object is written.
bool set_from_outside(const language::Object& object, std::string_view field);

/// Warns of constants of Materials in use, of ground and feet, that are stated for this run and that
/// its law does not read; says in `MaterialSpec::meant` which are stated, for other engines. Nothing
/// of a Material that is written for every law.
void find_unread_constants(const language::Object& world, Loading& loading);

}  // namespace hookpoint::simulation
