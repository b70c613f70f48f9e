// Robots of an MJCF's text, as an Include reads them.
#pragma once

#include <string>

#include "tests/support/command.h"
#include "tests/support/load_text.h"

namespace hookpoint::tests {

/// The World around an Include of robot.xml, which is `text`.
inline Loaded load_mjcf(const std::string& text, const std::string& arguments = "") {
  const testing::Workplace place;
  place.file("robot.xml", text);
  return load_file(
      place.file("scene.hook", "World w { Include \"robot.xml\" (name = r" + arguments + "); }"));
}

inline std::string mujoco(const std::string& inside) { return "<mujoco>\n" + inside + "</mujoco>"; }
inline std::string world(const std::string& inside, const std::string& after = "") {
  return mujoco("<worldbody>\n" + inside + "</worldbody>\n" + after);
}

}  // namespace hookpoint::tests
