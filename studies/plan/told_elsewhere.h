#pragma once

#include "language/diagnostics.h"

namespace hookpoint::studies {

/// Says what `told` says, at `position`.
inline void tell_at(const language::Position& position, const language::Diagnostic& told,
                    language::Diagnostics& diagnostics) {
  if (told.severity == language::Severity::error)
    diagnostics.error(position, told.message);
  else if (told.severity == language::Severity::warning)
    diagnostics.warning(position, told.message);
  else
    diagnostics.note(position, told.message);
}

}  // namespace hookpoint::studies
