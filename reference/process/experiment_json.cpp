#include "reference/process/experiment_json.h"

#include <algorithm>
#include <set>
#include <variant>
#include <vector>

#include "reference/experiment_checks.h"
#include "reference/ground.h"
#include "reference/mujoco_materials.h"
#include "reference/pair_materials.h"
#include "reference/robot_tree.h"
#include "reference/solids.h"
#include "reference/touching_points.h"
#include "simulation/experiment/joint_type.h"
#include "simulation/experiment/material_fields.h"
#include "text/json.h"

namespace hookpoint::reference {
namespace {

using simulation::Experiment;
using text::JsonWriter;

class ExperimentText {
 public:
  explicit ExperimentText(const Experiment& experiment)
      : experiment_(experiment), tree_(robot_tree(experiment)) {}

  std::string text() {
    json_.begin_object().member("type", "experiment");
    json_.member("world", experiment_.world).member("deltat", experiment_.deltat);
    vector("gravity", experiment_.gravity);
    json_.member("settings", experiment_.settings).member("seed", experiment_.seed);
    list("ground", [this] { add_ground(); });
    list("bodies", [this] { add_bodies(); });
    list("joints", [this] { add_joints(); });
    list("contacts", [this] { add_contacts(); });
    json_.end_object();
    return json_.text();
  }

 private:
  template <class Add>
  void list(std::string_view name, const Add& add) {
    json_.key(name).begin_array();
    add();
    json_.end_array();
  }
  void vector(std::string_view name, const Vector3d& v) {
    json_.key(name).numbers({v.x, v.y, v.z});
  }
  void pose(const Vector3d& position, const Quaterniond& q) {
    vector("position", position);
    json_.key("orientation").numbers({q.w, q.x, q.y, q.z});
  }

  void add_shape(const simulation::ShapeGeometry& geometry) {
    if (const auto* box = std::get_if<simulation::Box>(&geometry)) {
      json_.member("type", "box");
      vector("dimensions", box->dimensions);
    } else if (const auto* sphere = std::get_if<simulation::Sphere>(&geometry)) {
      json_.member("type", "sphere").member("radius", sphere->radius);
    } else if (const auto* cylinder = std::get_if<simulation::Cylinder>(&geometry)) {
      json_.member("type", "cylinder").member("radius", cylinder->radius);
      json_.member("length", cylinder->length);
    } else if (const auto* capsule = std::get_if<simulation::Capsule>(&geometry)) {
      json_.member("type", "capsule").member("radius", capsule->radius);
      json_.member("length", capsule->length);
    } else if (const auto* hull = std::get_if<simulation::Hull>(&geometry)) {
      json_.member("type", "hull");
      vertices(hull->vertices);
    }
  }

  void vertices(const std::vector<Vector3d>& points) {
    std::vector<double> numbers;
    for (const Vector3d& p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
    json_.key("vertices").numbers(numbers);
  }

  void add_ground() {
    if (experiment_.terrain) {
      const int material = experiment_.terrain->material;
      const Ground ground = ground_of(*experiment_.terrain);
      if (const auto* plane = std::get_if<GroundPlane>(&ground)) {
        json_.begin_object().member("type", "plane");
        vector("normal", plane->normal);
        json_.member("offset", plane->offset).member("material", material).end_object();
      } else if (const auto* mesh = std::get_if<GroundMesh>(&ground)) {
        json_.begin_object().member("type", "triangles");
        vertices(mesh->vertices);
        std::vector<double> corners;
        for (const auto& triangle : mesh->triangles)
          corners.insert(corners.end(), triangle.begin(), triangle.end());
        json_.key("triangles").numbers(corners);
        json_.member("material", material).end_object();
      }
    }
    for (const Solid& solid : solids_of(experiment_)) {
      json_.begin_object();
      add_shape(solid.geometry);
      pose(solid.pose.position, solid.pose.orientation);
      json_.member("material", solid.material).end_object();
    }
  }

  void add_bodies() {
    const std::vector<TouchingPoint> points = touching_points(experiment_, tree_);
    auto point = points.begin();
    for (std::size_t i = 0; i < tree_.bodies.size(); ++i) {
      const TreeBody& body = tree_.bodies[i];
      const simulation::MassSpec& mass = body.body->mass;
      const simulation::RobotSpec& robot = experiment_.robots[static_cast<std::size_t>(body.robot)];
      json_.begin_object().member("name", body.body->name).member("robot", robot.name);
      json_.member("parent", body.parent).member("mobile", body.mobile).member("mass", mass.mass);
      vector("center_of_mass", mass.center_of_mass);
      const Symmetric3d& I = mass.inertia;
      json_.key("inertia").numbers({I.xx, I.yy, I.zz, I.xy, I.xz, I.yz});
      pose(body.initial.position, body.initial.orientation);
      vector("velocity", body.initial.velocity);
      vector("angular_velocity", body.initial.angular_velocity);
      if (body.plane_normal) vector("keeps_in_plane", plane_axes(*body.plane_normal).normal);
      json_.key("colliders").begin_array();
      if (body.mobile)
        for (const simulation::ShapeSpec* shape : touching_shapes(experiment_, *body.body)) {
          json_.begin_object();
          add_shape(shape->geometry);
          pose(shape->location, shape->orientation);
          json_.member("material", shape->material).end_object();
        }
      for (; point != points.end() && point->body == i; ++point) {
        json_.begin_object().member("type", "point").member("radius", point->radius);
        vector("position", point->p_BP);
        json_.member("material", point->material).end_object();
      }
      json_.end_array().end_object();
    }
  }

  void add_joints() {
    for (std::size_t i = 0; i < tree_.bodies.size(); ++i) {
      const TreeBody& body = tree_.bodies[i];
      if (body.link == nullptr) continue;
      json_.begin_object().member("body", i).member("parent", body.parent);
      json_.member("type", simulation::joint_type(body.link->joint).name);
      pose(body.X_PL0.position, body.X_PL0.orientation);
      json_.member("angle", body.link->angle).member("rate", body.link->rate);
      json_.member("rotor_inertia", body.link->rotor_inertia).end_object();
    }
  }

  void add_contacts() {
    if (!experiment_.terrain && experiment_.obstacles.empty()) return;
    std::set<int> feet, grounds;
    if (experiment_.terrain) grounds.insert(experiment_.terrain->material);
    for (const simulation::ObstacleSpec& obstacle : experiment_.obstacles)
      grounds.insert(obstacle.material);
    for (const TreeBody& body : tree_.bodies)
      if (body.mobile)
        for (const simulation::ShapeSpec* shape : touching_shapes(experiment_, *body.body))
          feet.insert(shape->material);
    for (const TouchingPoint& point : touching_points(experiment_, tree_))
      feet.insert(point.material);
    const PairMaterials pairs(experiment_);
    const bool is_stated = std::ranges::any_of(
        experiment_.materials, [](const auto& material) { return material.mujoco.has_value(); });
    for (const int ground : grounds)
      for (const int foot : feet) {
        json_.begin_object().member("foot", foot).member("ground", ground);
        for (const simulation::MaterialField& field : simulation::material_fields())
          json_.member(field.name, pairs.of(foot, ground).*field.member);
        if (is_stated) add_mujoco(foot, ground);
        json_.end_object();
      }
  }

  /// The words of MuJoCo's files, where a Material states them.
  void add_mujoco(int foot, int ground) {
    const contact::MujocoRow row = mujoco_row_of(experiment_, foot, ground);
    const contact::MujocoFriction friction = mujoco_friction_of(experiment_);
    json_.key("mujoco").begin_object();
    json_.key("solref").numbers({row.reference.begin(), row.reference.end()});
    json_.key("solimp").numbers({row.impedance.begin(), row.impedance.end()});
    json_.member("impratio", friction.impedance_ratio);
    json_.member("cone", friction.elliptic ? "elliptic" : "pyramidal").end_object();
  }

  const Experiment& experiment_;
  const RobotTree tree_;
  JsonWriter json_;
};

}  // namespace

std::string experiment_json(const Experiment& experiment) {
  return ExperimentText(experiment).text();
}

}  // namespace hookpoint::reference
