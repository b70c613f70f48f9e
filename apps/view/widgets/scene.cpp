#include "apps/view/widgets/scene.h"

#include <algorithm>

#include "simulation/experiment/robot_tree.h"
#include "simulation/run/shown_scene.h"

namespace hookpoint::view {
namespace {

using simulation::ComponentSpec;
using simulation::Experiment;

// Data.

/// Fills the bodies that a scene has a place for.
class BodyFiller {
 public:
  explicit BodyFiller(std::vector<SceneBody>& bodies) : next_(bodies.begin()), first_(next_) {}

  void add(const simulation::RobotSpec& robot, int index) {
    const auto base = next_ - first_;
    const auto begin = next_;
    add(robot.base, index);
    simulation::for_each_link(robot, [&](const simulation::TreeLink& at) {
      SceneBody& body = add(at.link.body, index);
      body.parent = static_cast<int>(base + static_cast<std::ptrdiff_t>(at.parent));
      body.joint = at.link.joint;
      body.lower_limit = at.link.lower_limit;
      body.upper_limit = at.link.upper_limit;
    });
    const simulation::Pose start{robot.location, robot.orientation};
    auto body = begin;
    for (const simulation::Pose& pose : simulation::body_poses(robot)) body++->start = start * pose;
  }
  void add(const simulation::ObstacleSpec& obstacle) {
    SceneBody& body = *next_++;
    body.material = obstacle.material;
    body.shapes.push_back({obstacle.geometry, {}, {}});
    body.start = {obstacle.location, obstacle.orientation};
  }

 private:
  SceneBody& add(const simulation::BodySpec& spec, int robot) {
    SceneBody& body = *next_++;
    body.robot = robot;
    body.mass = spec.mass;
    body.shapes = spec.shapes;
    body.shapes.insert(body.shapes.end(), spec.shapes_without_contact.begin(),
                       spec.shapes_without_contact.end());
    body.points = spec.boundary_points;
    return body;
  }

  std::vector<SceneBody>::iterator next_;
  const std::vector<SceneBody>::iterator first_;
};

std::vector<SceneBody> bodies_of(const Experiment& experiment) {
  std::vector<SceneBody> bodies;
  for (simulation::ShownFrame& frame : simulation::shown_frames(experiment))
    bodies.emplace_back().trail = std::move(frame.trail);
  BodyFiller filler(bodies);
  int index = 0;
  for (const simulation::RobotSpec& robot : experiment.robots) filler.add(robot, index++);
  for (const simulation::ObstacleSpec& obstacle : experiment.obstacles) filler.add(obstacle);
  return bodies;
}

/// Index of the body at `trail`, or in which it is a port; -1 if none.
int body_at(const std::vector<SceneBody>& bodies, const std::string& trail) {
  const auto found = std::ranges::find_if(bodies, [&](const SceneBody& body) {
    return trail == body.trail || trail.starts_with(body.trail + ".");
  });
  return found == bodies.end() ? -1 : static_cast<int>(found - bodies.begin());
}

int body_of(const ComponentSpec& sensor, const Experiment& experiment,
            const std::vector<SceneBody>& bodies) {
  if (const int body = body_at(bodies, sensor.attached); body >= 0) return body;
  for (const simulation::WireSpec& wire : experiment.wires) {
    if (!wire.to.starts_with(sensor.trail + ".")) continue;
    if (const int body = body_at(bodies, wire.from); body >= 0) return body;
  }
  return -1;
}

std::vector<SceneSensor> sensors_of(const Experiment& experiment,
                                    const std::vector<SceneBody>& bodies) {
  std::vector<SceneSensor> sensors;
  for (const ComponentSpec& component : experiment.components) {
    if (!component.type.starts_with("Sensor.")) continue;
    const int body = body_of(component, experiment, bodies);
    if (body >= 0) sensors.push_back({component.trail, component.type, body, {}});
  }
  return sensors;
}

// JSON.

class SceneWriter {
 public:
  explicit SceneWriter(text::JsonWriter& json) : json_(json) {}

  void operator()(const Scene& scene) {
    json_.begin_object();
    json_.key("bodies").begin_array();
    for (const SceneBody& body : scene.bodies) (*this)(body);
    json_.end_array();
    json_.key("terrain");
    if (scene.terrain) {
      ground(scene);
    } else {
      json_.null();
    }
    json_.key("materials").begin_array();
    for (const std::string& material : scene.materials) json_.value(material);
    json_.end_array();
    vector("gravity", scene.gravity);
    json_.key("sensors").begin_array();
    for (const SceneSensor& sensor : scene.sensors) (*this)(sensor);
    json_.end_array();
    json_.end_object();
  }

  void operator()(const SceneBody& body) {
    json_.begin_object().member("trail", body.trail).member("robot", body.robot);
    json_.member("parent", body.parent).member("mass", body.mass.mass);
    vector("center_of_mass", body.mass.center_of_mass);
    const Symmetric3d& I = body.mass.inertia;
    json_.key("inertia").numbers({I.xx, I.yy, I.zz, I.xy, I.xz, I.yz});
    json_.key("joint");
    if (body.joint) {
      json_.value(simulation::joint_types[static_cast<std::size_t>(*body.joint)].name);
    } else {
      json_.null();
    }
    json_.key("limits").begin_array();
    for (const std::optional<double>& limit : {body.lower_limit, body.upper_limit}) {
      if (limit) {
        json_.value(*limit);
      } else {
        json_.null();
      }
    }
    json_.end_array();
    json_.key("material");
    if (body.material) {
      json_.value(*body.material);
    } else {
      json_.null();
    }
    json_.key("shapes").begin_array();
    for (const simulation::ShapeSpec& shape : body.shapes) (*this)(shape);
    json_.end_array();
    json_.key("points").begin_array();
    for (const Vector3d& point : body.points) json_.numbers({point.x, point.y, point.z});
    json_.end_array();
    const Vector3d& p = body.start.position;
    const Quaterniond& q = body.start.orientation;
    json_.key("start").numbers({p.x, p.y, p.z, q.w, q.x, q.y, q.z});
    json_.end_object();
  }

  void operator()(const simulation::ShapeSpec& shape) {
    json_.begin_object();
    std::visit(*this, shape.geometry);
    vector("location", shape.location);
    const Quaterniond& q = shape.orientation;
    json_.key("orientation").numbers({q.w, q.x, q.y, q.z});
    json_.end_object();
  }
  void operator()(const simulation::Box& box) {
    json_.member("kind", "box");
    vector("dimensions", box.dimensions);
  }
  void operator()(const simulation::Sphere& sphere) {
    json_.member("kind", "sphere").member("radius", sphere.radius);
  }
  void operator()(const simulation::Cylinder& cylinder) {
    json_.member("kind", "cylinder").member("radius", cylinder.radius);
    json_.member("length", cylinder.length);
  }
  void operator()(const simulation::Legcone& cone) {
    json_.member("kind", "legcone").member("length", cone.length);
    json_.member("proximal_radius", cone.proximal_radius);
    json_.member("distal_radius", cone.distal_radius);
  }
  void operator()(const simulation::Capsule& capsule) {
    json_.member("kind", "capsule").member("radius", capsule.radius);
    json_.member("length", capsule.length);
  }
  void operator()(const simulation::Hull& hull) {
    std::vector<double> numbers;
    for (const Vector3d& vertex : hull.vertices)
      numbers.insert(numbers.end(), {vertex.x, vertex.y, vertex.z});
    json_.member("kind", "hull").key("vertices").numbers(numbers);
    json_.key("faces").begin_array();
    for (const std::vector<std::size_t>& face : hull.faces) {
      numbers.assign(face.begin(), face.end());
      json_.numbers(numbers);
    }
    json_.end_array();
  }

  void ground(const Scene& scene) {
    std::vector<double> numbers;
    for (const Vector3d& vertex : scene.terrain->vertices)
      numbers.insert(numbers.end(), {vertex.x, vertex.y, vertex.z});
    json_.begin_object().key("vertices").numbers(numbers);
    json_.key("tiles").begin_array();
    for (const simulation::GroundTiles::Tile& tile : scene.terrain->tiles) {
      numbers.assign(1, tile.material);
      numbers.insert(numbers.end(), tile.corners.begin(), tile.corners.begin() + tile.corner_count);
      json_.numbers(numbers);
    }
    json_.end_array().member("body", scene.terrain_body).key("endless");
    if (scene.endless) {
      json_.value(*scene.endless);
    } else {
      json_.null();
    }
    json_.end_object();
  }

  void operator()(const SceneSensor& sensor) {
    json_.begin_object().member("trail", sensor.trail).member("type", sensor.type);
    json_.member("body", sensor.body);
    vector("location", sensor.location);
    json_.end_object();
  }

 private:
  void vector(const char* name, const Vector3d& v) { json_.key(name).numbers({v.x, v.y, v.z}); }

  text::JsonWriter& json_;
};

}  // namespace

Scene make_scene(const Experiment& experiment) {
  Scene scene;
  scene.bodies = bodies_of(experiment);
  if (experiment.terrain) {
    scene.terrain = simulation::visible_ground(experiment);
    // Off the tiles of a plane the same plane goes on (docs/terrain.md).
    if (!std::holds_alternative<simulation::GridSpec>(experiment.terrain->surface))
      scene.endless = experiment.terrain->material;
  }
  if (simulation::ground_moves(experiment))
    scene.terrain_body = static_cast<int>(scene.bodies.size()) - 1;
  for (const simulation::MaterialSpec& material : experiment.materials)
    scene.materials.push_back(material.name);
  scene.gravity = experiment.gravity;
  scene.sensors = sensors_of(experiment, scene.bodies);
  return scene;
}

void write_scene(const Scene& scene, text::JsonWriter& json) { SceneWriter{json}(scene); }

}  // namespace hookpoint::view
