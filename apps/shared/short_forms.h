// Options that are short for `--set WORLD.FIELD=VALUE`.
#pragma once

#include <string_view>

namespace hookpoint::application {

/// `in_studies`: what a study does not say of each of its subjects.
struct ShortForm {
  const char *option, *field, *type, *doc;
  bool in_studies;
};

inline constexpr ShortForm short_forms[] = {
    {"--engine", "engine", "NAME", "the World's engine: dts or a peer", false},
    {"--settings", "settings", "NAME",
     "how a peer is set up: default, recommended, matched, or noslip of mujoco", false},
    {"--contact", "contact", "LAW", "the World's contact law", false},
    {"--integrator", "integrator", "NAME", "the World's integrator", true},
    {"--dt", "deltat", "TIME", "the World's time step: \"0.5 ms\"", true},
};

}  // namespace hookpoint::application
