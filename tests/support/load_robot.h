// A World around an Include of a robot's file.
#pragma once

#include <string>

#include "tests/support/command.h"
#include "tests/support/load_text.h"

namespace hookpoint::tests {

/// The file `name` has `text`; `arguments` are the Include's, each after a comma.
inline Loaded load_robot(const std::string& name, const std::string& text,
                         const std::string& arguments) {
  const testing::Workplace place;
  place.file(name, text);
  return load_file(place.file("scene.hook",
                              "World w { Include \"" + name + "\" (name = r" + arguments + "); }"));
}

}  // namespace hookpoint::tests
