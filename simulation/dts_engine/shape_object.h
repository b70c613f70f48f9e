// What may touch and be touched under `touch = shapes`: the terrain, obstacles and bodies, each as
// the features of its shapes in its own frame.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "contact/geometry/polyhedron.h"
#include "contact/geometry/rim.h"
#include "contact/geometry/round_solid.h"
#include "contact/geometry/surface.h"
#include "contact/terrain/terrain.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// A ball, or a point (radius 0): a corner of a polyhedron, the tip of a cone, a ContactPoint.
struct BallFeature {
  Vector3d center;     ///< [m]
  double radius = 0.;  ///< [m]
  int material = no_material;
  /// Its number among the body's boundary points; none of a cone's tip.
  std::optional<std::size_t> boundary_point{};
  bool is_corner = false;  ///< of a polyhedron
  /// A sample of a rim, which only a grid of heights feels: there rims are points.
  bool is_rim_sample = false;
  double rim_radius = 0.;  ///< of the rim that a sample is of; 0 of others [m]
  /// Out of its shape, unit: a capsule's axis at its end; of a corner as contact::outward_of; else zero.
  Vector3d outward{};
};
struct RimFeature {
  contact::Rim rim;
  Vector3d middle;  ///< of the shape: what it touches lies before this place [m]
  int material = no_material;
};
/// The side of a capsule, a cylinder or a cone.
struct SideFeature {
  contact::RoundSide side;
  int material = no_material;
};
struct PolyhedronFeature {
  std::unique_ptr<contact::Polyhedron> solid;
  double half_thickness = 0.;  ///< least depth of its middle below a face [m]
  int material = no_material;
  std::size_t first_corner = 0;  ///< its vertices among the object's balls begin here
};
struct RoundFeature {
  contact::RoundSolid solid;
  int material = no_material;
};

struct ShapeObject {
  enum class Kind { terrain, obstacle, body };
  Kind kind = Kind::body;
  std::size_t index = 0;  ///< of the obstacle; of the robot
  std::size_t body = 0;   ///< of the robot
  bool movable = false;   ///< forces move it

  std::unique_ptr<contact::Surface> ground;  ///< of the terrain
  std::vector<BallFeature> balls;
  std::vector<RimFeature> rims;
  std::vector<SideFeature> sides;
  std::vector<PolyhedronFeature> polyhedra;
  std::vector<RoundFeature> rounds;
  int ground_material = no_material;  ///< of a terrain, where its surface says none
  contact::Region bounds;             ///< of all features; of a terrain unused

  bool is_empty() const {
    return !ground && balls.empty() && rims.empty() && polyhedra.empty() && rounds.empty();
  }
  /// How many places it may touch with at once, for the room that contacts need.
  std::size_t place_count() const;
};

/// The terrain (if there is one), the obstacles, then the bodies of the experiment's robots in order.
/// `ground` outlives them.
std::vector<ShapeObject> shape_objects(const Experiment& experiment,
                                       const contact::Terrain* ground);

/// Whether the ground is one plane.
bool is_plane(const contact::TerrainDescription& terrain);

/// Whether under `touch = shapes` something touches otherwise than by boundary points on one tile:
/// ground that is no plane or moves, obstacles, several robots, round shapes.
bool shapes_matter(const Experiment& experiment);

}  // namespace hookpoint::simulation
