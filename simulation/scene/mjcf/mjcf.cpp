// The robots of an MJCF as objects of the language, with the arguments of its Include.
#include "simulation/scene/mjcf/mjcf.h"

#include <array>

#include "simulation/scene/urdf/robot_include.h"

namespace hookpoint::simulation {
namespace {

using language::ForeignArguments;
using language::ForeignObject;

/// Arguments with a meaning of their own.
constexpr std::array mjcf_arguments{"name",  "base", "shapes",  "meshes", "keyframe",     "contact",
                                    "mimic", "lock", "inertia", "hold",   "rotor_inertia"};

class MjcfInclude : private RobotInclude {
 public:
  MjcfInclude(const ForeignArguments& arguments, language::FileStore& files,
              language::Report& report)
      : RobotInclude(arguments, mjcf_arguments, files, report) {}

  std::vector<ForeignObject> run(const language::SourceFile& file) {
    const std::string shapes = word_argument("shapes", {"collision", "inertia"});
    auto scene = read_mjcf(file, choices(), files_, report_);
    if (!scene) return {};
    check_arguments(scene->robots);
    lock_joints(scene->robots);
    tell_left_out(scene->robots.front().left_out, scene->robots.front().place);
    const std::string name = robot_name(scene->name);
    std::vector<ForeignObject> objects =
        material_objects(scene->materials, name + "_", scene->robots);
    for (UrdfRobot& robot : scene->robots) {
      const bool is_first = &robot == &scene->robots.front();
      for (ForeignObject& object :
           robot_objects(robot, is_first ? name : name + "_" + identifier(robot.name),
                         shapes == "inertia", is_first))
        objects.push_back(std::move(object));
    }
    return objects;
  }

 private:
  MjcfChoices choices() {
    MjcfChoices chosen;
    chosen.meshes = meshes_argument();
    chosen.mimic = mimic_argument();
    chosen.inertia = inertia_argument();
    chosen.contact = contact_argument();
    if (is_given("keyframe")) {
      const language::ForeignField& given = arguments_.at("keyframe");
      chosen.keyframe = given.values[0].text;
      chosen.keyframe_place = given.position;
      if (chosen.keyframe.empty())
        report_.error(given.position, "the argument `keyframe` is the name of a <key>");
    }
    return chosen;
  }
};

}  // namespace

std::vector<ForeignObject> include_mjcf(const language::SourceFile& file,
                                        const ForeignArguments& arguments,
                                        language::FileStore& files, language::Report& report) {
  return MjcfInclude(arguments, files, report).run(file);
}

}  // namespace hookpoint::simulation
