// Robots written as URDF: the file, expanded where xacro wrote it (xacro.h), as it stands
// (read.cpp) with its meshes (mesh.h, hull.h), its tree with what is fixed together made one
// (tree.cpp), and the objects of the language that it comes to (urdf.cpp), held in its pose if
// asked to (hold.cpp).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "language/files.h"
#include "language/tree/foreign.h"
#include "simulation/experiment.h"
#include "simulation/kinematics.h"

namespace hookpoint::simulation {

struct UrdfLink {
  std::string name;
  language::Position place;
  bool has_inertial = false;
  language::Position inertial_place;
  MassSpec mass;  ///< link's frame
  std::vector<ShapeSpec> shapes;
  std::vector<language::Position> shape_places;
  std::vector<Vector3d> points;  ///< that touch the ground, link's frame
  std::vector<language::Position> point_places;

  bool touches() const { return !shapes.empty() || !points.empty(); }
};

enum class UrdfJointType { fixed, revolute, continuous, prismatic, floating };

struct UrdfJoint {
  std::string name;
  language::Position place, type_place, limit_place, damping_place, friction_place, effort_place,
      rotor_place;
  UrdfJointType type = UrdfJointType::fixed;
  std::size_t parent = 0, child = 0;  ///< indices of links
  Pose origin;                        ///< X_PC at angle 0: of the child's frame in its parent's
  Vector3d axis{1., 0., 0.};          ///< unit vector, child's frame
  std::optional<double> lower_limit, upper_limit;
  double damping = 0., friction = 0.;
  std::optional<double> effort_limit;
  double rotor_inertia = 0.;  ///< at the joint [kg m^2, kg]
};

struct UrdfRobot {
  std::string name;
  language::Position place;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::map<std::string, std::size_t> left_out;  ///< what was not read, and how often
};

enum class UrdfShapes { collision, visual };
/// What a mesh becomes: nothing, its bounding box, or the vertices of its convex hull.
enum class UrdfMeshes { skip, box, hull };
struct UrdfGeometry {
  UrdfShapes shapes = UrdfShapes::collision;
  UrdfMeshes meshes = UrdfMeshes::skip;
};
/// What becomes of a joint that follows another (<mimic>): an error, a joint that moves by itself,
/// or one that is fixed at its offset.
enum class UrdfMimic { refused, ignored, fixed };
/// Of a hull with more vertices so many are taken, spread over it (hull.h).
inline constexpr std::size_t most_hull_points = 64;

/// The file's robot; `geometry` says what of it counts, `files` where meshes are looked up. Nothing
/// after an error. Cost: linear, and n log n in the vertices of each mesh, which are read once.
std::optional<UrdfRobot> read_urdf(const language::SourceFile& file, const UrdfGeometry& geometry,
                                   UrdfMimic mimic, language::FileStore& files,
                                   language::Report& report);

/// Links that are fixed together, as one body in its own frame.
struct UrdfBody {
  std::size_t link = 0;               ///< the one that names it
  const UrdfJoint* joint = nullptr;   ///< that moves it; none for the base
  Pose joint_pose;                    ///< of its frame in the preceding body's, at angle 0
  MassSpec mass;                      ///< body's frame
  bool has_inertial = false;          ///< some link of it does
  language::Position inertial_place;  ///< of the first that does
  std::vector<ShapeSpec> shapes;      ///< body's frame
  std::vector<language::Position> shape_places;
  std::vector<Vector3d> points;  ///< body's frame
  std::vector<language::Position> point_places;
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

/// So that every joint gives way by less than `sag` [rad] under the weight that it may carry: that
/// of the bodies beyond it or, of a mobile robot's legs, the whole robot's. A leg reaches at least
/// half as far below the base as anything of the robot, all joints at 0. O(bodies depth).
std::map<const UrdfJoint*, UrdfHold> hold_joints(const UrdfTree& tree, bool mobile, double sag);

/// The reader of an Include: the robot as an object of the language.
std::vector<language::ForeignObject> include_urdf(const language::SourceFile& file,
                                                  const language::ForeignArguments& arguments,
                                                  language::FileStore& files,
                                                  language::Report& report);

}  // namespace hookpoint::simulation
