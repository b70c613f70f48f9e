// Tests that have the program draw by a browser.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

namespace hookpoint::testing {

inline bool chromium_is_there() {
  return std::system("command -v chromium chromium-browser google-chrome >/dev/null 2>&1") == 0 ||
         std::getenv("HOOKPOINT_BROWSER") != nullptr;
}

}  // namespace hookpoint::testing

/// A sanitized program draws nothing that the released one does not, and takes ten times as long.
#ifdef __SANITIZE_ADDRESS__
#define NEEDS_CHROMIUM GTEST_SKIP() << "pictures are drawn by the program as released"
#else
#define NEEDS_CHROMIUM \
  if (!hookpoint::testing::chromium_is_there()) GTEST_SKIP() << "chromium is not installed"
#endif
