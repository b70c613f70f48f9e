// What the files of the load step (load*.cpp) share; for them alone.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/registry.h"
#include "language/diagnostics.h"
#include "language/tree/object.h"
#include "language/tree/references.h"
#include "simulation/experiment/experiment.h"
#include "simulation/experiment/kinematics.h"
#include "simulation/scene/trails.h"

namespace hookpoint::simulation {

/// The body of a robot that an object is, or is a part of: 0 the base, then the links that move,
/// chain by chain.
struct BodyIndex {
  int robot = 0, body = 0;
  Pose X_BL{};                  ///< of the object's frame in the body's
  std::size_t first_point = 0;  ///< of the object's own among the body's boundary points
  MassSpec mass{};              ///< of the object alone

  Vector3d in_body(const Vector3d& p_LQ) const {
    return X_BL.position + rotate(X_BL.orientation, p_LQ);
  }
};

/// What a name in a formula of a component reads.
struct FormulaInput {
  std::size_t component = 0;  ///< index
  std::size_t element = 0;    ///< of its input `in`
  language::Reference from;
};

/// Two shapes of a body that overlap or touch.
struct ShapeOverlap {
  const language::Object *first = nullptr, *second = nullptr;
};

/// The experiment as it grows, and which object each part came from.
struct Loading {
  language::Diagnostics& diagnostics;
  const std::vector<std::filesystem::path>& search_path;
  const std::vector<FileSpec>& given;  ///< files taken instead of being looked up
  Experiment experiment;
  std::map<const language::Object*, int> materials;  ///< index into Experiment::materials
  std::map<const language::Object*, BodyIndex> bodies;
  std::vector<const language::Object*> bases;  ///< one a robot
  ObjectTrails trails;
  std::vector<const language::Object*> components;  ///< one a ComponentSpec
  std::vector<FormulaInput> formula_inputs;
  std::size_t boundary_points = 0;     ///< requested, of all bodies
  std::vector<ShapeOverlap> overlaps;  ///< one a body whose shapes overlap
  language::Names names{};             ///< of the tree that is read, each scope's made once
  /// The scene serves runs of a study, which chose the law or the engine of this one: what they do not
  /// read of it is meant for others.
  bool serves_study = false;

  void error(const language::Position& position, std::string message) {
    diagnostics.error(position, std::move(message));
  }
};

// Fields that more than one file of the load step works on, by the class that declares them.

inline constexpr const char* deltat_field = "deltat";      ///< of a World
inline constexpr const char* duration_field = "duration";  ///< of a World
namespace base_field {
inline constexpr const char *location = "location", *orientation = "orientation",
                            *velocity = "velocity", *angular_velocity = "angular_velocity",
                            *rest_on = "rest_on", *at = "at", *yaw = "yaw", *settled = "settled";
}
/// Of a Record and of a Movie.
namespace run_file_field {
inline constexpr const char *rate = "rate", *file = "file";
}
/// Of a Shape.
inline constexpr const char *boundary_points_field = "boundary_points", *contact_field = "contact";
/// Of a Shape, a ContactPoint, a Link and a Base.
inline constexpr const char* material_field = "material";
/// Of a component: what it is attached to.
std::string_view attachment_field(control::Attachment attachment);

// Reading objects (load_object.cpp).

/// All objects of `type` (a family when it ends in '.') anywhere below `parent`, in file order.
std::vector<const language::Object*> collect_all(const language::Object& parent,
                                                 std::string_view type);
/// The object's trail from `ancestor` down: "left.leg" for a chain created by an Include named
/// left.
std::string name_within(const language::Object& object, const language::Object& ancestor);
/// Where `field` was written, else where the object was.
const language::Position& place_of(const language::Object& object, std::string_view field);
Vector3d vector_of(const language::Object& object, std::string_view field);

/// `name` beside the file that names it at `from`, then along the search path; empty, after saying
/// so, if nowhere. The experiment remembers it.
std::filesystem::path find_file(const std::string& name, const language::Position& from,
                                Loading& loading);

// The parts of a World, each into `loading.experiment`.

/// All that a World says of itself but its step where it is `auto`.
void load_world(const language::Object& world, Loading& loading);
void load_materials(const language::Object& root, Loading& loading);
/// The material of ground that names none: it states nothing.
MaterialSpec default_material();
/// The index of the Material that a Shape, ContactPoint, Link or Base names; `otherwise` if none.
int foot_material(const language::Object& object, int otherwise, Loading& loading);
void load_terrain(const language::Object& world, Loading& loading);
/// Once the wires are known: says what to do where a ground that moves would not be felt.
void check_moving_ground(const language::Object& root, Loading& loading);
/// Warns of Materials in use that state none of the constants which the law has for itself.
void warn_of_unstated_constants(const language::Object& world, Loading& loading);
/// Robots as written; `rest_on` is resolved afterwards.
void load_robots(const language::Object& world, Loading& loading);
/// Those that are not free; free ones are robots.
void load_obstacles(const language::Object& world, Loading& loading);
/// What a Link says of the joint that its own follows.
std::vector<language::FieldSchema> coupling_fields();
/// Joints that follow others; sets their angles.
void load_couplings(const language::Object& world, Loading& loading);
/// Loops of robots; joints are moved until they are closed.
void load_loops(const language::Object& world, Loading& loading);
void load_forces(const language::Object& world, Loading& loading);
/// Shapes, mass properties and boundary points of a base or a link. `must_have_inertia`: a body
/// that moves by itself.
BodySpec load_body(const language::Object& object, std::string name, bool must_have_inertia,
                   Loading& loading);
/// A body that moves by itself and has one shape, in its own frame.
BodySpec load_single_shape(const language::Object& object, ShapeGeometry geometry,
                           Loading& loading);
/// The index of the Material that `material` of the object names; the default material, appended
/// when first needed, if it names none.
int material_index(const language::Object& object, Loading& loading);
/// A robot as it grows, and the objects of its links that move, one a body beyond the base.
struct LoadedRobot {
  RobotSpec spec;
  std::vector<const language::Object*> links;
};
/// A Chain that hangs on `carrier`, its links, then the chains that stand in these.
void load_chain(const language::Object& object, const language::Object& robot, BodyIndex carrier,
                LoadedRobot& loaded, Loading& loading);
/// Says which joints move no inertia. O(links depth).
void check_joints(const LoadedRobot& loaded, Loading& loading);
LinkSpec load_link(const language::Object& object, std::string name, Loading& loading);
/// Whether a field or port of a Link is of a joint that moves.
bool is_of_joint(std::string_view field);
ShapeSpec load_shape(const language::Object& object, Loading& loading);
/// Of a Shape, or of another family's class of the same name: Obstacle.Box.
ShapeGeometry load_geometry(const language::Object& object, Loading& loading);
/// A ContactPoint; a ball of radius 0 is a point.
struct BallSpec {
  Vector3d location;   ///< p_BP, body axes [m]
  double radius = 0.;  ///< [m]
};
BallSpec load_contact_point(const language::Object& object);
/// A shape and the boundary points that it gives its body.
struct ShapePoints {
  const language::Object* object = nullptr;
  const ShapeSpec* shape = nullptr;
  std::vector<Vector3d> points;  ///< p_BP, body axes [m]
};
/// The first two shapes of a body that share surface: a boundary point of one is in or on the
/// other. Not where one has all of the other's points in it, which then bear nothing.
std::optional<ShapeOverlap> find_overlap(const std::vector<ShapePoints>& shapes);
/// Warns, once, of all overlaps that were found.
void warn_of_overlaps(Loading& loading);
/// Mass properties of `object` with the shapes `shapes`, whose objects are `shape_objects`.
MassSpec load_mass(const language::Object& object, const std::vector<ShapeSpec>& shapes,
                   const std::vector<const language::Object*>& shape_objects,
                   bool must_have_inertia, Loading& loading);
/// Lays robots that `rest_on` a terrain on it; which ones, without an error.
std::vector<bool> lay_on_terrain(Loading& loading);
/// Gives Materials that state MuJoCo's parameters the stiffness and damping that follow from them under
/// the load of a robot, and says so. `automatic`: the World's step is not chosen yet.
void complete_mujoco_materials(bool automatic, Loading& loading);
/// Lets those that were laid settle, and checks that every robot starts above its terrain.
void settle_on_terrain(const std::vector<bool>& laid, Loading& loading);
/// Of robots that start deep inside something, and those that are too heavy for their ground.
void warn_of_start_depths(Loading& loading);
/// What cannot run together: laws, integrators, engines, robots.
void check_combinations(const language::Object& world, Loading& loading);

// Signals, when the rest is right.

/// Gives every object its trail, none to two; collects the numbers that are readable as they stand
/// in the file.
void load_values(const language::Object& root, Loading& loading);
/// ContactPoints, by their trails.
void load_points(Loading& loading);
/// Controllers, sensors, actuators, sources.
void load_components(const language::Object& root, Loading& loading);
/// Wires and attachments. Finds second drivers, missing attachments, loops without delay, and
/// components that cannot start.
void load_wires(const language::Object& root, Loading& loading);
/// The number that `trail`, written at `place`, names from `from`; none after saying what is wrong.
std::optional<NumberPort> find_number(const language::Object& from, const std::string& trail,
                                      const language::Position& place, language::Names& names,
                                      Loading& loading);
/// What the run must show.
void load_expectations(const language::Object& root, Loading& loading);
/// Data files.
void load_records(const language::Object& root, Loading& loading);
/// "" or what is wrong with a rate at which something is written, for steps of `deltat` [s].
std::string rate_problem(double rate, double deltat);
/// "" or what is wrong with the name of a file in the run's folder, where all of `files` come to
/// lie: one that is none, that the run writes itself, or that the Records and Movies loaded so far
/// write.
std::string file_problem(const std::vector<std::string>& files, const Experiment& experiment);
/// Logs of the whole state.
void load_movies(const language::Object& root, Loading& loading);

}  // namespace hookpoint::simulation
