#include "simulation/run/shown_scene.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <utility>

#include "simulation/experiment/names.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// Puts what a player draws of a shape into a list, in the axes of the shape's body.
class ShapeShower {
 public:
  ShapeShower(const ShapeSpec& spec, std::vector<output::SceneShape>& list)
      : spec_(spec), list_(list) {}

  void operator()(const Box& box) const { add(output::SceneBox{box.dimensions}); }
  void operator()(const Sphere& sphere) const { add(output::SceneSphere{sphere.radius}); }
  void operator()(const Cylinder& cylinder) const {
    // A disc as thick as can be seen.
    constexpr double thinnest = 1e-3;  // of the radius
    const double length = cylinder.length > 0. ? cylinder.length : thinnest * cylinder.radius;
    add(output::SceneCone{length, cylinder.radius, cylinder.radius});
  }
  /// From its proximal face, at the origin, along x: z is turned to x, about y by 90 degrees.
  void operator()(const Legcone& cone) const {
    constexpr double half = 0.5 * std::numbers::sqrt2;
    add(output::SceneCone{cone.length, cone.proximal_radius, cone.distal_radius},
        {0.5 * cone.length, 0., 0.}, {half, 0., half, 0.});
  }
  void operator()(const Capsule& capsule) const {
    const Vector3d end{0., 0., 0.5 * capsule.length};
    add(output::SceneCone{capsule.length, capsule.radius, capsule.radius});
    add(output::SceneSphere{capsule.radius}, -end);
    add(output::SceneSphere{capsule.radius}, end);
  }
  void operator()(const Hull& hull) const {
    output::SceneMesh mesh{hull.vertices, {}};
    for (const std::vector<std::size_t>& face : hull.faces)
      for (std::size_t i = 2; i < face.size(); ++i)
        mesh.triangles.push_back({static_cast<std::uint32_t>(face[0]),
                                  static_cast<std::uint32_t>(face[i - 1]),
                                  static_cast<std::uint32_t>(face[i])});
    add(std::move(mesh));
  }

 private:
  /// At `location`, turned by `orientation`, in the shape's frame.
  template <class Geometry>
  void add(Geometry geometry, const Vector3d& location = {},
           const Quaterniond& orientation = {}) const {
    list_.push_back({std::move(geometry), spec_.location + rotate(spec_.orientation, location),
                     spec_.orientation * orientation});
  }

  const ShapeSpec& spec_;
  std::vector<output::SceneShape>& list_;
};

}  // namespace

std::vector<ShownFrame> shown_frames(const Experiment& experiment) {
  const std::string world = experiment.world + ".";
  std::vector<ShownFrame> frames;
  for (const std::string& trail : body_trails(experiment))
    frames.push_back({world + trail, "location"});
  for (const ObstacleSpec& obstacle : experiment.obstacles)
    frames.push_back({world + obstacle.name, "position"});
  if (ground_moves(experiment)) frames.push_back({world + experiment.terrain->name, "position"});
  return frames;
}

void shown_poses(const Experiment& experiment, const World& world, std::vector<Pose>& poses) {
  poses.clear();
  for (const BodyState& body : world.state().bodies)
    poses.push_back({body.position, body.orientation});
  for (const SurfaceMotion& obstacle : world.inputs().obstacles)
    poses.push_back({obstacle.position, obstacle.orientation});
  const SurfaceMotion& ground = world.inputs().ground;
  if (ground_moves(experiment)) poses.push_back({ground.position, ground.orientation});
}

output::Scene shown_scene(const Experiment& experiment) {
  output::Scene scene;
  for (const ShownFrame& frame : shown_frames(experiment))
    scene.bodies.push_back({frame.trail, {}});
  std::size_t index = 0;
  const auto show = [&](const ShapeSpec& shape) {
    std::visit(ShapeShower(shape, scene.bodies[index].shapes), shape.geometry);
  };
  for (const RobotSpec& robot : experiment.robots) {
    for_each_body(robot, [&](const BodySpec& body) {
      std::ranges::for_each(body.shapes, show);
      std::ranges::for_each(body.shapes_without_contact, show);
      ++index;
    });
  }
  for (const ObstacleSpec& obstacle : experiment.obstacles) {
    show({obstacle.geometry, {}, {}});
    ++index;
  }
  scene.ground = shown_ground(experiment);
  if (ground_moves(experiment))
    for (output::SceneSurface& surface : scene.ground) surface.frame = scene.bodies.back().name;
  return scene;
}

}  // namespace hookpoint::simulation
