// A URDF's robot as objects of the language, with the arguments of its Include.
#include "simulation/scene/urdf/urdf.h"

#include "language/document/document.h"
#include "simulation/scene/urdf/robot_include.h"
#include "simulation/scene/urdf/xacro.h"

namespace hookpoint::simulation {
namespace {

using language::ForeignArguments;
using language::ForeignObject;

class UrdfInclude : private RobotInclude {
 public:
  UrdfInclude(const ForeignArguments& arguments, language::FileStore& files,
              language::Report& report)
      : RobotInclude(arguments, robot_arguments, files, report) {}

  std::vector<ForeignObject> run(const language::SourceFile& file) {
    const ExpandedUrdf expanded = expand_xacro(file, arguments_, own_arguments_, files_, report_);
    if (expanded.source == nullptr) return {};
    const std::string shapes = word_argument("shapes", {"collision", "visual", "inertia"});
    const UrdfChoices choices = choices_argument(shapes);
    auto robot = read_urdf(*expanded.source, choices, files_, report_);
    if (!robot) return {};
    // A file that a run is repeated from is the one that was written.
    if (expanded.source != &file) robot->place = {&file, 0, 1};
    check_arguments({&*robot, 1}, expanded.arguments);
    lock_joints({&*robot, 1});
    tell_left_out(robot->left_out, robot->place);
    const std::string name = robot_name(robot->name);
    std::vector<ForeignObject> objects =
        material_objects(robot->materials, name + "_", {&*robot, 1});
    for (ForeignObject& object : robot_objects(*robot, name, shapes == "inertia"))
      objects.push_back(std::move(object));
    return objects;
  }
};

}  // namespace

std::vector<ForeignObject> include_urdf(const language::SourceFile& file,
                                        const ForeignArguments& arguments,
                                        language::FileStore& files, language::Report& report) {
  return UrdfInclude(arguments, files, report).run(file);
}

}  // namespace hookpoint::simulation
