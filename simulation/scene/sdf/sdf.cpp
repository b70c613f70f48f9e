// The robots, the ground and the obstacles of an SDFormat file as objects of the language, with the
// arguments of its Include.
#include "simulation/scene/sdf/sdf.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace hookpoint::simulation {
namespace {

using language::ForeignArguments;
using language::ForeignField;
using language::ForeignObject;
using language::Value;
using language::ValueKind;

class SdfInclude : private RobotInclude {
 public:
  SdfInclude(const ForeignArguments& arguments, language::FileStore& files,
             language::Report& report)
      : RobotInclude(arguments, robot_arguments, files, report) {}

  std::vector<ForeignObject> run(const language::SourceFile& file) {
    const std::string shapes = word_argument("shapes", {"collision", "visual", "inertia"});
    const UrdfChoices choices = choices_argument(shapes);
    auto scene = read_sdf(file, choices, files_, report_);
    if (!scene) return {};
    check_arguments(scene->robots);
    lock_joints(scene->robots);
    for (const UrdfRobot& robot : scene->robots) {
      for (const auto& [what, times] : robot.left_out) scene->left_out[what] += times;
    }
    tell_left_out(scene->left_out, scene->place);
    const bool one = scene->robots.size() == 1;
    prefix_ = is_given("name") ? robot_name("") + "_" : "";
    const std::string of_surfaces = one ? robot_name(scene->robots.front().name) + "_" : prefix_;
    std::vector<ForeignObject> objects =
        material_objects(scene->materials, of_surfaces + "surface_", scene->robots);
    if (scene->ground) add_ground(*scene->ground, objects);
    for (SdfSolid& solid : scene->solids) {
      ForeignObject object{"", unique(prefix_ + identifier(solid.name)), solid.shape.place, {}, {}};
      if (!solid.shape.material.empty())
        solid.shape.material = material_names_.at(solid.shape.material);
      object.type = "Obstacle." + add_shape_fields(solid.shape, object);
      objects.push_back(std::move(object));
    }
    for (UrdfRobot& robot : scene->robots) {
      const bool is_first = &robot == &scene->robots.front();
      const std::string name = one ? robot_name(robot.name) : prefix_ + identifier(robot.name);
      for (ForeignObject& object :
           robot_objects(robot, unique(name), shapes == "inertia", is_first))
        objects.push_back(std::move(object));
    }
    return objects;
  }

 private:
  std::string unique(std::string name) {
    std::size_t& number = names_[name];
    if (++number == 1) return name;
    return unique(fmt::format("{}_{}", name, number));
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
      add_text("material", material_names_.at(ground.material), ValueKind::word);
    objects.push_back(std::move(object));
  }

  std::string prefix_;  ///< of all names but that of a single robot, where `name` is given
  std::map<std::string, std::size_t> names_;  ///< and how often each was requested
};

}  // namespace

std::vector<ForeignObject> include_sdf(const language::SourceFile& file,
                                       const ForeignArguments& arguments,
                                       language::FileStore& files, language::Report& report) {
  return SdfInclude(arguments, files, report).run(file);
}

}  // namespace hookpoint::simulation
