// A ball that falls, run into a folder of results.
#pragma once

#include <string>

#include "tests/support/command.h"

namespace hookpoint::testing {

/// From 100 m for 1 s; `more` stands in the World.
inline std::string falling(const std::string& gravity, const std::string& more = "",
                           const std::string& step = "1 ms") {
  return "World w { gravity = " + gravity + "; deltat = " + step +
         "; duration = 1 s; integrator = rk4;\n" + more +
         "  Robot ball { Base.mobile { location = 0, 0, 100; Shape.Sphere { radius = 0.1; mass = "
         "1 kg; } } } }\n";
}

inline const std::string record_height = " --record w.ball.base.location.z";

/// Runs `text`, as run.hook, into the folder `name`.
inline CommandResult run_into(const Workplace& work, const std::string& name,
                              const std::string& text,
                              const std::string& arguments = record_height) {
  work.file("run.hook", text);
  return work.hookpoint("run run.hook --out " + name + arguments);
}

}  // namespace hookpoint::testing
