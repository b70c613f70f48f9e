// What a player of records draws: bodies and obstacles with their shapes, and the ground. Plain
// values; whoever records fills them in.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "math/rotation.h"

namespace hookpoint::output {

struct SceneBox {
  Vector3d dimensions;  ///< edge lengths [m], centred
};
struct SceneSphere {
  double radius = 0.;  ///< [m]
};
/// Truncated cone along z, centred; a cylinder where both radii are the same.
struct SceneCone {
  double length = 0.;                          ///< [m]
  double bottom_radius = 0., top_radius = 0.;  ///< of the faces at -z and at +z [m]
};
struct SceneMesh {
  std::vector<Vector3d> vertices;                       ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

struct SceneShape {
  std::variant<SceneBox, SceneSphere, SceneCone, SceneMesh> geometry;
  Vector3d location;        ///< p_BS, of the shape's frame in its body [m]
  Quaterniond orientation;  ///< R_BS
};

/// What has a pose in every row: a body, an obstacle, ground that moves.
struct SceneBody {
  std::string name;  ///< trail: "w.simplebot.leg1.link1"
  std::vector<SceneShape> shapes;
};

/// Triangles of one material.
struct SceneSurface {
  std::string name;      ///< trail of the terrain
  std::string material;  ///< its name
  std::string frame;     ///< SceneBody::name whose axes the vertices are in; "": world axes
  std::vector<Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from above
};

struct Scene {
  std::vector<SceneBody> bodies;
  std::vector<SceneSurface> ground;
};

/// Of a body's pose in a row: location x, y, z [m], then orientation w, x, y, z, in world axes.
inline constexpr std::size_t numbers_of_pose = 7;

}  // namespace hookpoint::output
