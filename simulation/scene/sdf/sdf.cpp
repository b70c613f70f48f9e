// The robots, the ground and the obstacles of an SDFormat file as objects of the language, with the
// arguments of its Include.
#include "simulation/scene/sdf/sdf.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>

namespace hookpoint::simulation {
namespace {

using language::ForeignArguments;
using language::ForeignField;
using language::ForeignObject;
using language::Value;
using language::ValueKind;

/// Arguments with a meaning of their own.
constexpr std::array sdf_arguments{"name",  "base", "shapes",  "meshes", "contact",
                                   "mimic", "lock", "inertia", "hold",   "rotor_inertia"};

class SdfInclude : private RobotInclude {
 public:
  SdfInclude(const ForeignArguments& arguments, language::FileStore& files,
             language::Report& report)
      : RobotInclude(arguments, sdf_arguments, files, report) {}

  std::vector<ForeignObject> run(const language::SourceFile& file) {
    const std::string shapes = word_argument("shapes", {"collision", "visual", "inertia"});
    auto scene = read_sdf(file, choices(shapes), files_, report_);
    if (!scene) return {};
    check_arguments(scene->robots);
    lock_joints(scene->robots);
    tell_left_out(scene->left_out, scene->place);
    prefix_ = is_given("name") && scene->robots.size() != 1 ? robot_name("") + "_" : "";
    std::vector<ForeignObject> objects =
        material_objects(scene->materials, material_name(""), scene->robots);
    if (scene->ground) add_ground(*scene->ground, objects);
    for (SdfSolid& solid : scene->solids) {
      ForeignObject object{"", unique(prefix_ + identifier(solid.name)), solid.shape.place, {}, {}};
      if (!solid.shape.material.empty()) solid.shape.material = material_name(solid.shape.material);
      object.type = "Obstacle." + add_shape_fields(solid.shape, object);
      objects.push_back(std::move(object));
    }
    for (UrdfRobot& robot : scene->robots) {
      const bool is_first = &robot == &scene->robots.front();
      const std::string name =
          scene->robots.size() == 1 ? robot_name(robot.name) : prefix_ + identifier(robot.name);
      for (ForeignObject& object :
           robot_objects(robot, unique(name), shapes == "inertia", is_first))
        objects.push_back(std::move(object));
    }
    return objects;
  }

 private:
  UrdfChoices choices(const std::string& shapes) {
    const UrdfShapes of = shapes == "visual" ? UrdfShapes::visual : UrdfShapes::collision;
    return {{of, meshes_argument()}, mimic_argument(), inertia_argument(), contact_argument()};
  }

  std::string material_name(const std::string& name) { return prefix_ + "surface_" + name; }

  std::string unique(std::string name) {
    if (names_.insert(name).second) return name;
    for (std::size_t number = 2;; ++number) {
      std::string other = fmt::format("{}_{}", name, number);
      if (names_.insert(other).second) return other;
    }
  }

  void add_ground(const SdfGround& ground, std::vector<ForeignObject>& objects) {
    ForeignObject object{"", unique(prefix_ + identifier(ground.name)), ground.place, {}, {}};
    const auto add = [&](const char* name, const std::vector<double>& values) {
      object.fields.push_back(numbers(name, values, ground.place));
    };
    const auto add_text = [&](const char* name, const std::string& text, ValueKind kind) {
      Value value;
      value.kind = kind;
      value.text = text;
      value.position = ground.place;
      object.fields.push_back({name, {value}, ground.place});
    };
    const Vector3d& n = ground.normal;
    const double across = std::hypot(n.x, n.y);
    constexpr double straight = 1e-12;
    if (!ground.file.empty()) {
      object.type = "Terrain.Grid";
      add_text("file", ground.file, ValueKind::text);
      add("spacing", {ground.spacing});
      add("origin", {ground.origin_x, ground.origin_y});
      add("low", {ground.low});
      add("high", {ground.high});
    } else if (across < straight && n.z > 0.) {
      object.type = "Terrain.Flat";
      if (ground.point.z != 0.) add("height", {ground.point.z});
    } else {
      constexpr double near_origin = 1e-9, steepest = 1.57;  // [m], [rad]
      const double angle = std::atan2(across, n.z);
      if (std::abs(dot(n, ground.point)) > near_origin || angle > steepest) {
        report_.error(ground.place,
                      "a plane that is tilted is read where it goes through the world's origin and "
                      "is less steep than 89.9 deg: move the rest of the world, or make it a box");
        return;
      }
      object.type = "Terrain.Slope";
      add("angle", {angle});
      add("azimuth", {std::atan2(n.y, n.x)});
    }
    if (!ground.material.empty())
      add_text("material", material_name(ground.material), ValueKind::word);
    objects.push_back(std::move(object));
  }

  std::string prefix_;  ///< of all names, where the file holds several robots and `name` is given
  std::set<std::string> names_;
};

}  // namespace

std::vector<ForeignObject> include_sdf(const language::SourceFile& file,
                                       const ForeignArguments& arguments,
                                       language::FileStore& files, language::Report& report) {
  return SdfInclude(arguments, files, report).run(file);
}

}  // namespace hookpoint::simulation
