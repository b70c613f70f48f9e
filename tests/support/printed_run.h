// Whether `hookpoint print` writes a file that means the same: its run has the same bytes.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/support/command.h"

namespace hookpoint::testing {

/// Runs a shipped scene and what `print` makes of it for 20 ms and compares the records of
/// `trails`.
inline void expect_printed_runs_alike(const std::string& scene, const std::string& trails) {
  const Workplace place;
  place.file("scene.hook", "Include \"" + scene + "\";");
  const CommandResult printed = place.hookpoint("print scene.hook");
  ASSERT_EQ(printed.status, 0) << printed.err;
  place.file("printed.hook", printed.out);
  const std::string run = " --for 20ms --record " + trails + " --out ";
  ASSERT_EQ(place.hookpoint("run scene.hook" + run + "a").status, 0);
  ASSERT_EQ(place.hookpoint("run printed.hook" + run + "b").status, 0);
  EXPECT_FALSE(place.read("a/trace.csv").empty());
  EXPECT_EQ(place.read("a/trace.csv"), place.read("b/trace.csv"));
}

}  // namespace hookpoint::testing
