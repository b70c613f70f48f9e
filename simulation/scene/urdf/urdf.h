// Robots written as URDF: the file, expanded where xacro wrote it (xacro.h), as it stands
// (read.cpp) with its meshes (mesh.h, hull.h), its tree with what is fixed together made one
// (tree.cpp), and the objects of the language that it comes to (urdf.cpp), held in its pose if
// requested to (hold.cpp).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "language/syntax/files.h"
#include "language/tree/foreign.h"
#include "simulation/experiment/experiment.h"
#include "simulation/experiment/kinematics.h"
#include "simulation/scene/urdf/surface_material.h"

namespace hookpoint::simulation {

/// A shape, and what of it counts.
struct UrdfShape {
  ShapeSpec spec;
  language::Position place;
  bool touches = true;
  std::string material;  ///< the name of an object; "": none of its own
};

/// A point that touches the ground.
struct UrdfPoint {
  Vector3d position;
  language::Position place;
  std::string material;  ///< the name of an object; "": none of its own
};

struct UrdfLink {
  std::string name;
  language::Position place;
  bool has_inertial = false;
  language::Position inertial_place;
  MassSpec mass;  ///< link's frame
  std::vector<UrdfShape> shapes;
  std::vector<UrdfPoint> points;  ///< link's frame

  bool touches() const { return !shapes.empty() || !points.empty(); }
};

enum class UrdfJointType { fixed, revolute, continuous, prismatic, floating };

/// A drive that holds a joint, or its rate, at a goal.
struct UrdfServo {
  bool of_rate = false;
  double gain = 0., damping = 0.;  ///< torque per error, and per rate
  std::optional<double> goal;      ///< none: where the joint starts
  language::Position place;
};

/// A joint that follows another: q = ratio q_leader + offset.
struct UrdfFollows {
  std::string leader;
  double ratio = 1., offset = 0.;  ///< [rad, m]
  language::Position place;
};

struct UrdfJoint {
  std::string name;
  language::Position place, type_place, limit_place, damping_place, friction_place, effort_place,
      velocity_place, rotor_place;
  UrdfJointType type = UrdfJointType::fixed;
  std::size_t parent = 0, child = 0;  ///< indices of links
  Pose origin;                        ///< X_PC at angle 0: of the child's frame in its parent's
  Vector3d axis{1., 0., 0.};          ///< unit vector, child's frame
  std::optional<double> lower_limit, upper_limit;
  double damping = 0., friction = 0.;
  std::optional<double> effort_limit, velocity_limit;
  double rotor_inertia = 0.;  ///< at the joint [kg m^2, kg]
  double stiffness = 0., rest_angle = 0.;
  std::optional<double> angle;  ///< at the start
  double rate = 0.;
  std::optional<UrdfServo> servo;
  std::optional<UrdfFollows> follows;
  double fixed_at = 0.;  ///< of one that is fixed where the file has it moving [rad, m]
};

/// Where a free base starts, in the world.
struct UrdfStart {
  Pose pose;
  Vector3d velocity, angular_velocity;
};

struct UrdfRobot {
  std::string name;
  language::Position place;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::optional<UrdfStart> start;
  std::map<std::string, std::size_t> left_out;  ///< what was not read, and how often
  std::vector<SurfaceMaterial> materials;       ///< that shapes and points name
  std::vector<std::string> repaired;            ///< inertias, link by link, and by how much
};

enum class UrdfShapes { collision, visual };
/// What a mesh becomes: nothing, its bounding box, or the vertices of its convex hull.
enum class UrdfMeshes { skip, box, hull };
struct UrdfGeometry {
  UrdfShapes shapes = UrdfShapes::collision;
  UrdfMeshes meshes = UrdfMeshes::skip;
};
/// What becomes of a joint that follows another (<mimic>): it does, it moves by itself, or it is fixed
/// at its offset.
enum class UrdfMimic { couple, ignore, fixed };
/// What becomes of an inertia that no mass has: an error, or the nearest that some mass has.
enum class UrdfInertia { file, repair };

struct UrdfChoices {
  UrdfGeometry geometry;
  UrdfMimic mimic = UrdfMimic::couple;
  UrdfInertia inertia = UrdfInertia::file;
  StatedContact contact = StatedContact::friction;
};
/// Of a hull with more vertices so many are taken, spread over it (hull.h).
inline constexpr std::size_t most_hull_points = 64;

/// The file's robot; `choices` say what of it counts, `files` where meshes are looked up. Nothing
/// after an error. Cost: linear, and n log n in the vertices of each mesh, which are read once.
std::optional<UrdfRobot> read_urdf(const language::SourceFile& file, const UrdfChoices& choices,
                                   language::FileStore& files, language::Report& report);

/// Links that are fixed together, as one body in its own frame.
struct UrdfBody {
  std::size_t link = 0;               ///< the one that names it
  const UrdfJoint* joint = nullptr;   ///< that moves it; none for the base
  Pose joint_pose;                    ///< of its frame in the preceding body's, at angle 0
  MassSpec mass;                      ///< body's frame
  bool has_inertial = false;          ///< some link of it does
  language::Position inertial_place;  ///< of the first that does
  std::vector<UrdfShape> shapes;      ///< body's frame
  std::vector<UrdfPoint> points;      ///< body's frame
};

/// Bodies in series. Where one carries several joints its chain ends, and each of the joints starts
/// a chain of its own: arms alike are chains alike.
struct UrdfChain {
  std::vector<UrdfBody> bodies;
  std::vector<UrdfChain> carried;  ///< by the last of the bodies, in the file's order
};

/// The base, and the chains of bodies that it carries. A root without mass and shapes that carries
/// but a floating joint stands for the world: the joint's child is the base. A body's frame has its
/// origin where URDF has that of its link; its axes are the link's, turned by the least rotation
/// that takes z to the joint's axis.
struct UrdfTree {
  UrdfBody base;
  bool floats = false;  ///< by a joint that says so
  std::vector<UrdfChain> chains;
};

/// The least rotation that takes z to the unit vector `axis`.
Quaterniond from_z_to(const Vector3d& axis);

/// Nothing after an error: a second root, a loop. Cost: n log n in the
/// links.
std::optional<UrdfTree> assemble_urdf(const UrdfRobot& robot, language::Report& report);

/// Gives each body, in place of its shapes, a box at its centre of mass along its own axes that has
/// the body's second moments of mass along them; none to a body without mass or without inertia.
void take_inertia_boxes(UrdfTree& tree);

/// Constants of the spring and damper of a joint, and of its stops [N m/rad, N m s/rad; N/m, N
/// s/m].
struct UrdfHold {
  double stiffness = 0., damping = 0.;
  double limit_stiffness = 0., limit_damping = 0.;
  double friction_speed = 0.;  ///< [rad/s; m/s]
};

/// So that every joint deflects by less than `sag` [rad] under the weight that it may carry: that
/// of the bodies beyond it or, of a mobile robot's legs, the whole robot's. A leg reaches at least
/// half as far below the base as anything of the robot, all joints at 0. O(bodies depth).
std::map<const UrdfJoint*, UrdfHold> hold_joints(const UrdfTree& tree, bool mobile, double sag);

/// The reader of an Include: the robot as an object of the language.
std::vector<language::ForeignObject> include_urdf(const language::SourceFile& file,
                                                  const language::ForeignArguments& arguments,
                                                  language::FileStore& files,
                                                  language::Report& report);

}  // namespace hookpoint::simulation
