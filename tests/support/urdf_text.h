// Small robots as URDF text, and the World around an Include of one.
#pragma once

#include <string>

#include "tests/support/load_robot.h"

namespace hookpoint::urdf_text {

inline Loaded load_urdf(const std::string& text, const std::string& arguments = "") {
  return tests::load_robot("robot.urdf", text, arguments);
}

inline const std::string inertial =
    "<inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" "
    "iyz=\"0\"/></inertial>";
inline const std::string base = "<link name=\"b\">" + inertial + "</link>";
inline const std::string link_l = "<link name=\"l\">" + inertial + "</link>\n";
inline std::string joint(const std::string& name, const std::string& type,
                         const std::string& inside, const std::string& parent = "b",
                         const std::string& child = "l") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\">\n<parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + inside + "</joint>\n";
}
/// Its base is `base`, on the second line.
inline std::string robot(const std::string& inside) {
  return "<robot name=\"r\">\n" + base + "\n" + inside + "</robot>";
}

}  // namespace hookpoint::urdf_text
