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
#include "simulation/experiment.h"
#include "simulation/scene/trails.h"

namespace hookpoint::simulation {

/// A body of a robot: 0 the base, then the links chain by chain.
struct BodyIndex {
  int robot = 0, body = 0;
};

/// What a name in a formula of a component reads.
struct FormulaInput {
  std::size_t component = 0;  ///< index
  std::size_t element = 0;    ///< of its input `in`
  language::Reference from;
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
  std::size_t boundary_points = 0;  ///< asked for, of all bodies

  void error(const language::Position& position, std::string message) {
    diagnostics.error(position, std::move(message));
  }
};

// Fields that more than one file of the load step works on, by the class that declares them.

inline constexpr const char* deltat_field = "deltat";  ///< of a World
namespace base_field {
inline constexpr const char *location = "location", *orientation = "orientation",
                            *velocity = "velocity", *angular_velocity = "angular_velocity",
                            *rest_on = "rest_on", *at = "at", *yaw = "yaw";
}
/// Of a Record and of a Movie.
namespace run_file_field {
inline constexpr const char *rate = "rate", *file = "file";
}
/// Of a Shape.
inline constexpr const char* boundary_points_field = "boundary_points";
/// Of a component: what it is attached to.
std::string_view attachment_field(control::Attachment attachment);

// Reading objects (load_object.cpp).

/// All objects of `type` (a family when it ends in '.') anywhere below `parent`, in file order.
std::vector<const language::Object*> collect_all(const language::Object& parent,
                                                 std::string_view type);
/// The object's trail from `ancestor` down: "left.leg" for a chain laid down by an Include named
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
void load_terrain(const language::Object& world, Loading& loading);
/// Warns of Materials in use that state none of the constants which the law has for itself.
void warn_of_unstated_constants(const language::Object& world, Loading& loading);
/// Robots as written; `rest_on` is resolved afterwards.
void load_robots(const language::Object& world, Loading& loading);
void load_forces(const language::Object& world, Loading& loading);
/// Shapes, mass properties and boundary points of a base or a link. `must_have_inertia`: a body
/// that moves by itself.
BodySpec load_body(const language::Object& object, std::string name, bool must_have_inertia,
                   Loading& loading);
/// A robot as it grows, and the objects of its links, one a body beyond the base.
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
ShapeSpec load_shape(const language::Object& object, Loading& loading);
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
/// Warns, once a body, where a boundary point of one shape is in or on another.
void warn_of_overlap(const std::vector<ShapePoints>& shapes, const std::string& body,
                     Loading& loading);
/// Mass properties of `object` with the shapes `shapes`, whose objects are `shape_objects`.
MassSpec load_mass(const language::Object& object, const std::vector<ShapeSpec>& shapes,
                   const std::vector<const language::Object*>& shape_objects,
                   bool must_have_inertia, Loading& loading);
/// Lays robots that `rest_on` a terrain on it and checks that every robot starts above its terrain.
void place_on_terrain(Loading& loading);
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
