// An experiment as plain typed values, SI units, world z up: what a `.hook` file says once every
// name, unit and expression is resolved. It is what every engine is built from, ours and the peers
// alike.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "contact/combination.h"
#include "contact/mujoco_contact.h"
#include "contact/terrain/terrain.h"
#include "contact/vocabulary.h"
#include "math/rotation.h"
#include "output/records/channel.h"
#include "simulation/experiment/joint_type.h"

namespace hookpoint::simulation {

/// Mass, centre of mass and inertia about the centre of mass, in the axes of the body's frame.
struct MassSpec {
  double mass = 0.;         ///< [kg]
  Vector3d center_of_mass;  ///< [m]
  Symmetric3d inertia;      ///< [kg m^2]
};

struct Box {
  Vector3d dimensions;  ///< edge lengths along x, y, z [m], centred
};
struct Sphere {
  double radius = 0.;
};
struct Cylinder {
  double radius = 0.;
  double length = 0.;  ///< along z, centred; 0 of a disc
};
/// Solid truncated cone along +x of its body, proximal face at the body's origin.
struct Legcone {
  double length = 0.;
  double proximal_radius = 0.;
  double distal_radius = 0.;
};
/// All places within `radius` of the z axis between -length/2 and length/2.
struct Capsule {
  double radius = 0.;
  double length = 0.;  ///< of its cylindrical part
};
/// A convex solid.
struct Hull {
  std::vector<Vector3d> vertices;
  std::vector<std::vector<std::size_t>> faces;  ///< counter-clockwise as seen from outside; closed
};
using ShapeGeometry = std::variant<Box, Sphere, Cylinder, Legcone, Capsule, Hull>;

/// Of a shape, a point or a feature that has no material of its own.
inline constexpr int no_material = -1;

struct ShapeSpec {
  ShapeGeometry geometry;
  Vector3d location;        ///< p_BS, of the shape's frame in its body [m]
  Quaterniond orientation;  ///< R_BS
  int boundary_points = 0;  ///< how densely the surface is sampled; 0 is the shape's own default
  /// The samples among BodySpec::boundary_points.
  std::size_t first_point = 0, point_count = 0;
  int material = no_material;  ///< index into Experiment::materials
};

/// What every body has: a name, mass, shapes to draw and to collide, and the points that may touch
/// the ground.
struct BodySpec {
  std::string name;  ///< "base" or the link's name
  MassSpec mass;
  std::vector<ShapeSpec> shapes;                  ///< drawn, and what may touch the ground
  std::vector<ShapeSpec> shapes_without_contact;  ///< drawn alone
  std::vector<Vector3d>
      boundary_points;  ///< p_BP, body axes [m]: ContactPoints, then sampled from the shapes
  /// Of the balls about the first boundary points [m]; beyond its end they are points, radius 0.
  std::vector<double> boundary_radii;
  /// Materials of the first boundary points, indices into Experiment::materials; beyond its end they
  /// have none.
  std::vector<int> boundary_materials;

  int boundary_material(std::size_t point) const {
    return point < boundary_materials.size() ? boundary_materials[point] : no_material;
  }
  double boundary_radius(std::size_t point) const {
    return point < boundary_radii.size() ? boundary_radii[point] : 0.;
  }
};

/// A link: its own MDH numbers place its frame after the preceding one, Rot_x(alpha) Trans_x(a)
/// Rot_z(theta) Trans_z(d); the joint turns about (slides along) the link's own z. Any fixed
/// transform may stand ahead of them.
struct LinkSpec {
  BodySpec body;
  Vector3d joint_location;        ///< of the fixed transform, preceding link's axes [m]
  Quaterniond joint_orientation;  ///< of the fixed transform
  double a = 0., alpha = 0., d = 0., theta = 0.;
  JointKind joint = joint_types[0].kind;
  double angle = 0., rate = 0.,
         torque = 0.;    ///< initial angle, rate and constant torque (SI by joint kind)
  double damping = 0.;   ///< torque = -damping rate
  double friction = 0.;  ///< dry friction torque, opposes the rate
  std::optional<double> static_friction;  ///< of a joint that sticks, at least `friction`
  double stribeck_velocity = 0.;          ///< over this rate it falls to `friction`; 0: at once
  double friction_deflection = joint_types[0].defaults.friction_deflection;
  double friction_speed = joint_types[0].defaults.friction_speed;
  double stiffness = 0., rest_angle = 0.;  ///< torque = -stiffness (angle - rest_angle)
  std::optional<double> lower_limit, upper_limit;
  double limit_stiffness = joint_types[0].defaults.limit_stiffness;
  double limit_damping = joint_types[0].defaults.limit_damping;
  std::optional<double> effort_limit;    ///< of the drive's torque, either way
  std::optional<double> velocity_limit;  ///< to which the drive takes the joint, either way
  double rotor_inertia = 0.;             ///< of motor and gears, at the joint
};

/// Links in series that hang on the base or on a link of an earlier chain.
struct ChainSpec {
  std::string name;             ///< its trail below the robot: "waist.torso.left_arm"
  Vector3d hip_distance;        ///< p_BH, in the axes of the body that carries it [m]
  Quaterniond hip_orientation;  ///< R_BH
  std::vector<LinkSpec> links;
  std::size_t carrier = 0;  ///< that body: 0 the base, or a link, counted chain by chain from 1
};

/// Start in static balance (analysis/resting_state.h): what it adds to the pose of a robot.
struct SettledStart {
  Vector3d level_location;        ///< p_WB before it leaned and deflected: level on its points [m]
  Quaterniond level_orientation;  ///< R_WB, likewise
  /// Stretch of the tangential springs of the boundary points, body by body, world axes [m]; empty
  /// for a law without such springs.
  std::vector<Vector3d> stretch;
};

struct RobotSpec {
  std::string name;
  bool mobile = false;
  /// Of a mobile base that is kept in a plane of world axes: 0, 1, 2, its normal x, y or z.
  std::optional<std::size_t> plane_normal;
  BodySpec base;
  Vector3d location;                    ///< p_WB [m]
  Quaterniond orientation;              ///< R_WB
  Vector3d velocity;                    ///< v_WB, of the base origin, world axes [m/s]
  Vector3d angular_velocity;            ///< w_WB, world axes [rad/s]
  std::vector<ChainSpec> chains;        ///< each after the one that carries it
  std::optional<SettledStart> settled;  ///< none: tangential springs start slack
  /// Its bodies touch each other, but for those that a joint joins.
  bool self_contact = false;
};

/// A ContactPoint that the file names by a trail of its own.
struct PointSpec {
  std::string trail;  ///< from the top
  int robot = 0;
  int body = 0;   ///< 0 is the base, then the links, chain by chain
  int point = 0;  ///< index into BodySpec::boundary_points
};

struct MaterialSpec {
  std::string name;
  contact::MaterialConstants<double> constants;
  /// Constants that the file leaves at their defaults: where the other side of a contact states one,
  /// that holds.
  std::vector<double contact::MaterialConstants<double>::*> unstated{};
  /// Constants that are stated for this run: those that its engine does not read are reported.
  std::vector<double contact::MaterialConstants<double>::*> meant{};
  /// Where the file states MuJoCo's own parameters.
  std::optional<contact::MujocoContact> mujoco{};
};

/// Constants of contacts between two materials, whichever is the foot's, instead of what they
/// combine to. Indices into Experiment::materials.
struct PairSpec {
  int a = 0, b = 0, material = 0;
};

using FlatSpec = contact::FlatSurface;
using SlopeSpec = contact::SlopeSurface;
using GridSpec = contact::GridSurface;
using PatchSpec = contact::MaterialPatch;
/// The ground; its materials are indices into Experiment::materials.
struct TerrainSpec : contact::TerrainDescription {
  std::string name;
  Vector3d velocity;  ///< of the material along the surface, which does not move: a belt [m/s]
  /// Of the whole ground, at first: of its frame's origin, the world's at time 0 [m/s, rad/s].
  Vector3d frame_velocity, frame_angular_velocity;
};

/// A body of the world that no robot carries: it stands still, or its motion is prescribed (engine.h,
/// SurfaceMotion). A free one is a robot without chains.
struct ObstacleSpec {
  std::string name;
  ShapeGeometry geometry;
  Vector3d location;          ///< p_WO, of the shape's frame, at first [m]
  Quaterniond orientation;    ///< R_WO, at first
  Vector3d velocity;          ///< v_WO, at first [m/s]
  Vector3d angular_velocity;  ///< w_WO, at first [rad/s]
  int material = 0;           ///< index into Experiment::materials
};

/// Places of two bodies of one robot that stay together: the joint that closes a chain of links.
struct LoopSpec {
  std::string name;
  int robot = 0;
  int body_a = 0, body_b = 0;  ///< 0 is the base, then the links, chain by chain
  Vector3d point_a, point_b;   ///< in the axes of either body [m]
  /// Of a hinge, its direction in the axes of either body; none: the bodies turn freely.
  std::optional<std::array<Vector3d, 2>> axes;
  std::optional<double> stiffness;  ///< of a compliant one [N/m]; none: exact
  double damping = 0.;              ///< of a compliant one [N s/m]
};

/// A joint that follows another of its robot: q_follower = ratio q_leader + offset. Joints are counted
/// chain by chain from 0.
struct CouplingSpec {
  int robot = 0;
  std::size_t leader = 0, follower = 0;
  double ratio = 1.;   ///< of the rates, SI units of either [rad/rad, m/rad, ...]
  double offset = 0.;  ///< [rad, m]
};

/// When a force acts: from `from` to `to`, rising and falling over `edge` as half a cosine.
struct ForceWindow {
  double from = 0., to = 0.;  ///< [s]
  double edge = 0.;           ///< [s]; 0 switches between steps
};

/// An external force on a body, constant unless it has a window or wires drive it.
struct ForceSpec {
  std::string name;
  int robot = 0;
  int body = 0;     ///< 0 is the base, then the links, chain by chain
  Vector3d point;   ///< where it acts, body axes [m]
  Vector3d force;   ///< world axes [N]
  Vector3d torque;  ///< world axes [N m]
  std::optional<ForceWindow> window;
};

/// A value of an object that no engine and no component computes: a constant (a mass, a material's
/// stiffness), or one that holds what was written last (a slider's value, a camera's zoom).
struct ValueSpec {
  std::string trail;  ///< from the top, port included: "SimpleWorld.clay.normal_stiffness"
  std::string unit;
  std::optional<double> value;  ///< none: that of the input which it is wired to, else 0
  bool writable = false;
  bool momentary = false;  ///< it is false again by itself: a push button's
};

/// A component and the values that the file gives it.
struct ComponentSpec {
  std::string trail;           ///< from the top, no two alike: "pd1"
  std::string type;            ///< class of control::Registry: "Controller.PD"
  std::string attached;        ///< trail of the body or link that it is attached to; "" if none
  std::optional<double> rate;  ///< of its updates [Hz]; none: every step
  std::vector<std::pair<std::size_t, double>> values;  ///< index among the component's values
  std::vector<std::pair<std::size_t, std::string>>
      texts;                    ///< index among its texts; paths absolute
  std::size_t open_inputs = 0;  ///< elements of its open input; one where it is 0
};

/// One number's way from a port to a port, by their trails from the top.
struct WireSpec {
  std::string from, to;
  std::optional<double> rate;  ///< of sampling [Hz]; none: every step
  double delay = 0.;           ///< [s]
  double noise = 0.;           ///< standard deviation, in the unit of the value
  bool mean = false;           ///< a sample is the mean over the steps since the last one
};

/// A data file of the run.
struct RecordSpec {
  std::string name;
  std::string format = "csv";  ///< of output::record_formats
  std::string file;            ///< in the run's folder
  std::optional<double> rate;  ///< of its rows [Hz]; none: every step
  std::vector<output::Channel>
      channels;       ///< `path`: the port's trail from the top; an open `unit` is the port's
  bool scene = true;  ///< with poses and shapes, where the format takes them
};

/// A log of the run's whole state, from which it can be resumed.
struct MovieSpec {
  std::string name;
  std::string file;            ///< in the run's folder
  std::optional<double> rate;  ///< of its instants [Hz]; none: every step
};

/// A file that the experiment reads.
struct FileSpec {
  std::string name;  ///< as written
  std::string path;  ///< absolute
};

/// What becomes of a port's values over a time (docs/studies.md defines each).
enum class Reduction {
  final,
  maximum,
  minimum,
  mean,
  rms,
  range,
  change,
  slope,
  time_at,
  last,  ///< as `final`
  time_of_maximum,
  time_of_minimum,
  integral,
  settle_time,
  count_above,
  time_above,
  curvature
};

/// One number of a quantity's values over a time.
struct ReductionSpec {
  Reduction take = Reduction::final;
  double from = 0.;             ///< [s]
  std::optional<double> to;     ///< [s]; none: the run's end
  std::optional<double> level;  ///< SI
  std::optional<double> band;   ///< of `settle_time`, SI
};

struct Experiment;

/// What the run must show: a truth that comes with the scene.
struct ExpectationSpec {
  std::string name;
  std::string trail;        ///< of the port, from the top; empty where it does not cover the run
  ReductionSpec reduction;  ///< of the port's values to one number
  double expected = 0.;     ///< SI
  double tolerance = 0.;    ///< relative
  double within = 0.;       ///< absolute
  std::optional<double> scale;  ///< of decades of error; none: the size of `expected`
  std::string unit;             ///< of the expected value
  std::string formula;          ///< as the file writes it
  std::string source;           ///< where it comes from
  std::vector<std::string> laws, except_laws;  ///< no law: all
  std::vector<std::string> integrators;        ///< none: all

  /// Whether it says something of a run under that law and integrator of our engine.
  bool covers(std::string_view law, std::string_view integrator) const;
  /// Whether it says something of a run of `experiment`. A peer has neither our laws nor our
  /// integrators, so what names some says nothing of it.
  bool covers(const Experiment& experiment) const;
};

struct Experiment {
  std::string world;
  Vector3d gravity{0., 0., -9.81};
  double deltat = 1e-3;
  /// Of `deltat = auto`: the largest stable step that it was chosen from [s]; infinity where there
  /// is none, 0 where no step is stable.
  std::optional<double> chosen_from;
  std::string integrator = "semi_implicit_euler";
  double relative_tolerance = 1e-6, absolute_tolerance = 1e-8;  ///< of adaptive integrators
  std::string contact = "hookpoint";
  std::string engine = "dts";
  std::string settings = "default";         ///< of a peer: default, recommended, matched
  std::optional<double> constraint_mixing;  ///< CFM of ODE's world, if not its own [m/(N s)]
  double duration = 10.;
  std::uint64_t seed = 1;
  std::vector<MaterialSpec> materials;
  contact::Combination combine = contact::Combination::foot;  ///< of the materials of two sides
  std::vector<PairSpec> pairs;
  /// "points": sampled points and balls, each against the one tile under it (Reichler & Delcomyn 2000,
  /// 3.3); "shapes": the shapes as they are, against planes, edges, obstacles and other bodies.
  std::string touch = "shapes";
  std::optional<TerrainSpec> terrain;
  std::vector<ObstacleSpec> obstacles;
  std::vector<RobotSpec> robots;
  std::vector<ForceSpec> forces;
  std::vector<LoopSpec> loops;
  std::vector<CouplingSpec> couplings;
  std::vector<PointSpec> points;
  std::vector<ComponentSpec> components;
  std::vector<WireSpec> wires;  ///< attachments included
  std::vector<RecordSpec> records;
  std::vector<ExpectationSpec> expectations;
  std::vector<MovieSpec> movies;
  std::vector<FileSpec> files;
  std::shared_ptr<const std::vector<ValueSpec>> values;  ///< shared: copies of an experiment differ
                                                         ///< in what runs, not in what is readable
};

}  // namespace hookpoint::simulation
