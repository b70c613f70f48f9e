// What is known of each type of joint, once: a row a type. The type's motion in the recursions is
// dts/joint.h's.
#pragma once

#include <array>
#include <cstddef>

namespace hookpoint::simulation {

enum class JointKind { revolute, prismatic };

/// Of a joint's quantities, as the language writes them.
struct JointUnits {
  const char* position;
  const char* rate;
  const char* acceleration;
  const char* torque;  ///< of a joint that slides a force
  const char* stiffness;
  const char* damping;
  const char* inertia;  ///< of a joint that slides a mass
};

/// Of joints that state none (docs/joints.md).
struct JointDefaults {
  double friction_deflection;  ///< deflection of a joint that sticks [rad; m]
  double friction_speed;       ///< and how fast [rad/s; m/s]
  double limit_stiffness;      ///< spring of its stops [N m/rad; N/m]
  double limit_damping;        ///< damper of its stops [N m s/rad; N s/m]
};

struct JointType {
  JointKind kind;
  const char* name;  ///< as in `joint = prismatic`
  bool turns;        ///< about the link's own z, its position added to theta; else it slides along
                     ///< z, its position added to d
  JointUnits units;
  JointDefaults defaults;
};

/// In the order of the enumeration; the first is what a Link has that states no joint.
inline constexpr std::array<JointType, 2> joint_types{{
    {JointKind::revolute,
     "revolute",
     true,
     {"rad", "rad/s", "rad/s^2", "N.m", "N.m/rad", "N.m.s/rad", "kg.m^2"},
     {1e-3, 0.05, 1000., 1.}},
    {JointKind::prismatic,
     "prismatic",
     false,
     {"m", "m/s", "m/s^2", "N", "N/m", "N.s/m", "kg"},
     {1e-4, 0.005, 1e5, 100.}},
}};

constexpr const JointType& joint_type(JointKind kind) {
  return joint_types[static_cast<std::size_t>(kind)];
}

}  // namespace hookpoint::simulation
