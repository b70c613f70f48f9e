// Counts what a test asks of malloc, which operator new (allocation_counter.h) does not see: the
// vectors of SUNDIALS, the matrices of Eigen. For one source file of a program. Sanitizers bring a
// malloc of their own; there nothing is counted.
#pragma once

#include <cstddef>

namespace hookpoint::testing {

inline long mallocs = 0;  ///< since the program started

}  // namespace hookpoint::testing

#ifndef __SANITIZE_ADDRESS__
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  ++hookpoint::testing::mallocs;
  return __libc_malloc(size);
}
#endif
