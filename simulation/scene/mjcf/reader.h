// The reader of an MJCF: bodies, joints and geoms in read.cpp, what couples, drives and starts joints in
// drives.cpp.
#pragma once

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "dts/mass_properties.h"
#include "simulation/scene/mjcf/actuator.h"
#include "simulation/scene/mjcf/document.h"
#include "simulation/scene/mjcf/geom.h"
#include "simulation/scene/mjcf/joint_inertia.h"
#include "simulation/scene/mjcf/mjcf.h"
#include "simulation/scene/mjcf/vocabulary.h"
#include "simulation/scene/urdf/mesh.h"

namespace hookpoint::simulation {

/// An element of a body, in whatever frames it stands there.
struct MjcfPlaced {
  XmlElement element;
  Pose X_BF;
  std::string childclass;
};

/// Where numbers of a keyframe belong.
struct MjcfJointAddress {
  std::size_t robot = 0, joint = 0;
  bool is_free = false;
};

/// An actuator of a joint, as the joint's servo and a keyframe need it.
struct MjcfDrive {
  std::optional<MjcfJointAddress> joint;  ///< none: it is left out
  MjcfActuator actuator;
  std::optional<std::array<double, 2>> ctrl_range = {};
  std::optional<double> effort_limit = {};  ///< of the joint's torque
  language::Position limit_place = {};
};

inline bool is_mjcf_coupling(const XmlElement& element, std::string_view section) {
  return section == "equality" && element.tag() == "joint";
}

/// `springdamper` of a joint: time constant [s] and damping ratio.
using MjcfSpring = std::array<double, 2>;

class MjcfReader {
 public:
  MjcfReader(const language::SourceFile& file, const MjcfChoices& choices,
             language::FileStore& files, language::Report& report)
      : document_(file, files, report), choices_(choices), files_(files), report_(report) {}

  std::optional<MjcfScene> run();

 private:
  void leave_out(const std::string& what) { ++left_out_[what]; }
  void leave_out_unread(const MjcfAttributes& given) {
    const std::string_view tag = given.own().tag();
    const bool contact_is_read = choices_.contact == StatedContact::file && tag == "geom";
    for (const std::string& name : unread_mjcf_attributes(given))
      if (!contact_is_read || (name != "solref" && name != "solimp" && name != "condim"))
        leave_out(fmt::format("{} of <{}>", name, tag));
  }

  void read_list(const XmlElement& section);
  void read_contact_pair(const XmlElement& pair);
  void read_assets();
  /// An error at each joint and body that an element that is left out names and the file lacks.
  void check_references();
  void read_worldbody();
  void leave_out_of_world(const XmlElement& element);
  void read_top_body(const MjcfPlaced& at);
  std::vector<MjcfPlaced> elements_of(const XmlElement& body, const Pose& X_BF,
                                      const std::string& childclass, std::size_t depth = 0);
  bool is_free_joint(const MjcfPlaced& item);
  /// `X_LP`: of the carrying body's frame in its link's.
  void read_body(const MjcfPlaced& at, std::size_t robot, std::size_t parent, const Pose& X_LP,
                 std::size_t depth);
  UrdfJoint read_joint(const MjcfPlaced& at, const std::string& body, std::size_t number);
  void read_range(const MjcfAttributes& given, UrdfJoint& joint);
  UrdfJoint read_free_joint(const MjcfPlaced& at, const std::string& body);
  /// `is_moved`: by some joint; the mass of what stands on the world does not matter.
  void read_contents(const std::vector<MjcfPlaced>& items, const Pose& X_LB, bool is_moved,
                     UrdfLink& link);
  /// Whether a joint moves the link `index`.
  static bool is_moved(const UrdfRobot& robot, std::size_t index);
  void read_geom_at(const MjcfPlaced& at, const Pose& X_LB, UrdfLink& link,
                    std::vector<dts::MassProperties<double>>& masses, language::Position& massless);
  void add_shape(const MjcfGeom& geom, const MjcfAttributes& given, const Pose& X_LG,
                 UrdfLink& link);
  void add_mesh_geom(const MjcfAttributes& given, const Pose& X_LG, UrdfLink& link);
  /// The vertices of an asset's file or of its own; null after an error.
  const MeshPoints* mesh_of(const XmlElement& asset, const std::string& name);
  static MeshPoints vertices_of(const XmlElement& asset);
  std::string material_of(const MjcfAttributes& given);
  void add_stated_contact(const MjcfAttributes& given, const std::vector<double>& friction,
                          SurfaceMaterial& material);
  void read_friction(const XmlElement& option);
  void require_mass();
  /// `joint` equalities: one joint follows another, or is fixed.
  void read_couplings();
  void read_coupling(const XmlElement& element);
  /// Springs and dampers of joints that state them by the inertia in front of them.
  void settle_springs();
  void read_actuators();
  MjcfDrive read_actuator(const XmlElement& element);
  void find_ctrl_range(const MjcfAttributes& given, MjcfDrive& drive);
  void find_effort_limit(const MjcfAttributes& given, MjcfDrive& drive);
  void limit_efforts();
  void add_servo(const MjcfAttributes& given, const MjcfDrive& drive);
  /// The greater of a range's ends; a note where they are not alike.
  double greater_end(const std::array<double, 2>& ends, const std::string& what);
  UrdfJoint& joint_at(const MjcfJointAddress& at) {
    return scene_.robots[at.robot].joints[at.joint];
  }
  void read_keyframe();
  void take_key(const XmlElement& key);
  void take_ctrl(const std::vector<double>& ctrl);
  void read_sections();
  void scale_mass();
  /// `name` if nothing else of its kind is called so, otherwise with a number.
  std::string unique(std::string name, std::set<std::string>& taken);

  MjcfDocument document_;
  const MjcfChoices& choices_;
  language::FileStore& files_;
  language::Report& report_;
  MjcfScene scene_;
  contact::MujocoFriction friction_;
  std::map<std::string, std::size_t> left_out_;
  std::vector<std::string> repaired_;
  std::set<std::string> link_names_, joint_names_;
  std::map<std::string, MjcfJointAddress> joints_;  ///< by their names in the file
  std::vector<MjcfJointAddress> addresses_;         ///< in the order of qpos
  std::map<std::string, XmlElement> meshes_;
  std::set<std::string> paired_geoms_;                ///< of <pair>
  std::map<std::string, MjcfSpring> spring_dampers_;  ///< by joint
  std::vector<std::vector<JointInertia>> inertias_;   ///< of robots and their joints
  std::vector<MjcfDrive> drives_;                     ///< in the file's order
};

}  // namespace hookpoint::simulation
