// Counts calls of operator new in a test that links hookpoint_test_support: "a step allocates
// nothing".
#pragma once

namespace hookpoint::testing {

/// Calls of operator new since the program started.
long allocation_count();

}  // namespace hookpoint::testing
