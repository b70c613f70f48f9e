// Where output goes: the one place that decides whether it may be coloured or redrawn.
#pragma once

namespace hookpoint::text {

/// Whether the descriptor is a terminal that understands escape sequences (TERM is not `dumb`).
bool is_able_terminal(int descriptor);
/// Whether what is written to the descriptor is to be coloured: to such a terminal, and not where
/// NO_COLOR is set to anything (no-color.org).
bool wants_colours(int descriptor);

}  // namespace hookpoint::text
