// How much memory there is, and how much of it the process has.
#pragma once

#include <optional>

namespace hookpoint::python {

/// What malloc has given out [bytes]; 0 where the C library does not say.
double allocated_memory();
/// What the process may still take: the machine's, and the limit of its address space [bytes];
/// nothing where the system does not say.
std::optional<double> free_memory();

}  // namespace hookpoint::python
