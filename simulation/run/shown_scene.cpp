#include "simulation/run/shown_scene.h"

#include <numbers>

#include "simulation/names.h"
#include "simulation/robot_tree.h"

namespace hookpoint::simulation {
namespace {

/// A shape's own geometry, and where its centre and its z axis lie in the shape's frame.
struct Centred {
  output::SceneShape shape;

  Centred(const Box& box) { shape.geometry = output::SceneBox{box.dimensions}; }
  Centred(const Sphere& sphere) { shape.geometry = output::SceneSphere{sphere.radius}; }
  Centred(const Cylinder& cylinder) {
    shape.geometry = output::SceneCone{cylinder.length, cylinder.radius, cylinder.radius};
  }
  /// From its proximal face, at the origin, along x: z is turned to x, about y by 90 degrees.
  Centred(const Legcone& cone) {
    shape.geometry = output::SceneCone{cone.length, cone.proximal_radius, cone.distal_radius};
    shape.location = {0.5 * cone.length, 0., 0.};
    constexpr double half = 0.5 * std::numbers::sqrt2;
    shape.orientation = {half, 0., half, 0.};
  }
};

output::SceneShape shown(const ShapeSpec& spec) {
  output::SceneShape shape =
      std::visit([](const auto& geometry) { return Centred(geometry); }, spec.geometry).shape;
  shape.location = spec.location + rotate(spec.orientation, shape.location);
  shape.orientation = spec.orientation * shape.orientation;
  return shape;
}

}  // namespace

output::Scene shown_scene(const Experiment& experiment) {
  output::Scene scene;
  for (const std::string& trail : body_trails(experiment))
    scene.bodies.push_back({experiment.world + "." + trail, {}});
  std::size_t index = 0;
  for (const RobotSpec& robot : experiment.robots) {
    for_each_body(robot, [&](const BodySpec& body) {
      for (const auto* shapes : {&body.shapes, &body.shapes_without_contact})
        for (const ShapeSpec& shape : *shapes) scene.bodies[index].shapes.push_back(shown(shape));
      ++index;
    });
  }
  scene.ground = shown_ground(experiment);
  return scene;
}

}  // namespace hookpoint::simulation
