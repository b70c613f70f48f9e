// The clock that this program and its libraries ask: moved on at will, so that a test need not
// wait. Included by one file of a test.
#pragma once

#include <sys/time.h>
#include <time.h>

#include <atomic>

namespace hookpoint::testing {

inline std::atomic<time_t> clock_shift{0};  ///< [s]
inline std::atomic<long> clock_questions{0};

}  // namespace hookpoint::testing

// In the place of the C library's, for shared libraries too.
extern "C" time_t time(time_t* result) noexcept {
  ++hookpoint::testing::clock_questions;
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const time_t shifted = now.tv_sec + hookpoint::testing::clock_shift;
  if (result != nullptr) *result = shifted;
  return shifted;
}

extern "C" int gettimeofday(timeval* __restrict result, void* __restrict) noexcept {
  ++hookpoint::testing::clock_questions;
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  *result = {now.tv_sec + hookpoint::testing::clock_shift, now.tv_nsec / 1000};
  return 0;
}
