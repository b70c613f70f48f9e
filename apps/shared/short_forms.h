// Options that are short for `--set WORLD.FIELD=VALUE`.
#pragma once

#include <string_view>

namespace hookpoint::application {

struct ShortForm {
  const char *option, *field, *type, *doc;
  bool in_studies;  ///< what a study does not say of each of its subjects
  bool of_dts;      ///< what other engines do not read
};

inline constexpr ShortForm short_forms[] = {
    {"--engine", "engine", "NAME", "the World's engine: dts or another", false, false},
    {"--settings", "settings", "NAME",
     "how another engine is set up: default, recommended, matched, or another that `describe World` lists",
     false, false},
    {"--contact", "contact", "LAW", "the World's contact law", false, true},
    {"--integrator", "integrator", "NAME", "the World's integrator", true, true},
    {"--dt", "deltat", "TIME", "the World's time step: \"0.5 ms\"", true, false},
};

}  // namespace hookpoint::application
