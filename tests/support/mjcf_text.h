// Robots as MJCF text, and the World around an Include of one.
#pragma once

#include <string>

#include "tests/support/load_robot.h"

namespace hookpoint::tests {

inline Loaded load_mjcf(const std::string& text, const std::string& arguments = "") {
  return load_robot("robot.xml", text, arguments);
}

inline std::string mujoco(const std::string& inside) { return "<mujoco>\n" + inside + "</mujoco>"; }
inline std::string world(const std::string& inside, const std::string& after = "") {
  return mujoco("<worldbody>\n" + inside + "</worldbody>\n" + after);
}

}  // namespace hookpoint::tests
