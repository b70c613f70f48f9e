// What the Includes of robots in files of other formats have in common: their arguments, and the
// objects of the language that links and joints come to.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "language/tree/foreign.h"
#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {

/// Adds the fields that a Shape and an Obstacle of this geometry have in common: its sizes, where it
/// stands and its material. Result: its kind, "Box".
std::string add_shape_fields(const UrdfShape& of, language::ForeignObject& object);

/// `text` as a name of the language: letters, digits and _, no digit first.
std::string identifier(std::string text);

/// A field of numbers, SI.
language::ForeignField numbers(const char* name, const std::vector<double>& of,
                               const language::Position& place);

/// Arguments of every format, beside fields of the base and names of joints.
inline constexpr std::array robot_arguments{"name",  "base", "shapes",  "meshes", "contact",
                                            "mimic", "lock", "inertia", "hold",   "rotor_inertia"};

class RobotInclude {
 public:
  /// `own_arguments`: that the format takes beside fields of the base and names of joints.
  RobotInclude(const language::ForeignArguments& arguments,
               std::span<const char* const> own_arguments, language::FileStore& files,
               language::Report& report)
      : arguments_(arguments), own_arguments_(own_arguments), files_(files), report_(report) {}

 protected:
  /// The robot as an object called `name`, with what the arguments say of it; `box_shapes`: each
  /// body touches as the box of its inertia; `placed`: the arguments that are fields of a base are its
  /// base's. Nothing after an error.
  std::vector<language::ForeignObject> robot_objects(UrdfRobot& robot, const std::string& name,
                                                     bool box_shapes, bool placed = true);
  /// The argument `name`, otherwise the file's own.
  std::string robot_name(const std::string& of_file);
  /// The word that an argument gives; "" if it is not given or after an error.
  std::string word_argument(const std::string& name, const std::vector<std::string>& choices);
  bool is_given(const std::string& name) const;
  /// The Materials, each name with `prefix` before it, as the shapes and points of the robots call them
  /// from then on; a name that a link or joint has gets a _ at its end.
  std::vector<language::ForeignObject> material_objects(
      const std::vector<SurfaceMaterial>& materials, const std::string& prefix,
      std::span<UrdfRobot> robots);
  /// What becomes of joints that follow others, and of inertias that no mass has.
  UrdfMimic mimic_argument();
  UrdfInertia inertia_argument();
  /// What of surfaces and meshes counts.
  StatedContact contact_argument();
  UrdfChoices choices_argument(const std::string& shapes);
  UrdfMeshes meshes_argument();
  /// An error for each argument that means nothing to one of the robots.
  void check_arguments(std::span<const UrdfRobot> robots,
                       const std::vector<std::string>& further = {});
  /// Fixes the joints that the argument `lock` names where they start.
  void lock_joints(std::span<UrdfRobot> robots);
  /// One line about all that is in the file and not in the robots.
  void tell_left_out(const std::map<std::string, std::size_t>& left_out,
                     const language::Position& place);

  std::map<std::string, std::string> material_names_;  ///< of Materials, by the file's reader's
  const language::ForeignArguments& arguments_;
  const std::span<const char* const> own_arguments_;
  language::FileStore& files_;
  language::Report& report_;

 private:
  /// An argument of its own, or a field of the base: no joint's name then.
  bool is_own(const std::string& argument) const;
  /// The argument that says where a joint starts: its name, with `_angle` where that is another's.
  std::string angle_argument(const UrdfJoint& joint) const;
  /// Adds the arguments of the joints to `known`; an error for one that is given and means two things.
  void check_joint_arguments(const UrdfRobot& robot, const std::vector<std::string>& further,
                             std::vector<std::string>& known);
  void add_meaning(const std::string& argument, const std::string& meaning,
                   std::map<std::string, std::string>& meanings);
  void take_rotors(UrdfRobot& robot);
  double start_argument(const UrdfJoint& joint);
  /// Names of the links that the joints carry, below the robot.
  void find_trails(const UrdfRobot& robot, const UrdfChain& chain, const std::string& above);
  void add_coupling(const UrdfJoint& joint, bool held, language::ForeignObject& link);
  void repair_base(UrdfTree& tree, UrdfRobot& robot);
  /// One line about inertias that are not the file's.
  void tell_repaired(const UrdfRobot& robot);
  language::ForeignObject base_object(const UrdfRobot& robot, const UrdfTree& tree, bool placed);
  void add_start(const UrdfStart& start, bool placed, language::ForeignObject& base);
  void tell_tilt(const Quaterniond& q, double yaw);
  language::ForeignObject chain_object(const UrdfRobot& robot, const UrdfChain& of);
  void add_joint(const UrdfJoint& joint, const UrdfHold& held, language::ForeignObject& link);
  void add_angle(const UrdfJoint& joint, bool held, language::ForeignObject& link);
  void require_mass(const UrdfLink& link, const UrdfBody& body);
  double hold_argument();

  std::set<std::string> joint_names_;  ///< of joints that move, of all robots
  std::map<const UrdfJoint*, UrdfHold> holds_;
  std::map<std::string, std::string> trails_;  ///< of the link that a joint carries
  std::map<std::string, double> starts_;       ///< of joints that others follow [rad, m]
};

}  // namespace hookpoint::simulation
