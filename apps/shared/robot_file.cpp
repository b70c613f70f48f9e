#include "apps/shared/robot_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "text/display.h"
#include "text/number.h"

namespace hookpoint::application {
namespace {

constexpr double gravity = 9.81;          // [m/s^2], the default of a World
constexpr double parts_of_weight = 4.;    // on a contact point, as of four feet
constexpr const char* hold = "0.03 rad";  // by which joints deflect at most

using Arguments = std::vector<std::string>;

std::string include_of(const std::filesystem::path& file, const Arguments& arguments) {
  const std::string name = language::quote(file.filename().string());
  if (arguments.empty()) return fmt::format("Include {};", name);
  return fmt::format("Include {} ({});", name, fmt::join(arguments, ", "));
}

/// On a floor that deflects by 1 mm under `load` [N] on a contact point; without a floor where that is 0.
std::string world_with(const std::string& include, double load) {
  std::string floor;
  if (load > 0.)
    floor = fmt::format(
        "  Include \"materials/rigid_floor.hook\" (load = {} N, allowance = 1 mm);\n"
        "  Terrain.Flat ground {{ material = rigid_floor; }}\n",
        text::shortest(load));
  return fmt::format("World world {{\n  deltat = auto;\n{}  {}\n}}\n", floor, include);
}

bool has_shape(const language::Object& object) {
  return object.type.starts_with("Shape.") || object.type == "ContactPoint" ||
         std::ranges::any_of(object.children, [](const auto& child) { return has_shape(*child); });
}

/// Of all robots [N].
double weight_of(const simulation::Experiment& experiment) {
  double mass = 0.;
  for (const simulation::RobotSpec& robot : experiment.robots) {
    mass += robot.base.mass.mass;
    for (const simulation::ChainSpec& chain : robot.chains)
      for (const simulation::LinkSpec& link : chain.links) mass += link.body.mass.mass;
  }
  return gravity * mass;
}

/// A world around the file: the Include in it, and what came of it.
struct Trial {
  std::string include;
  double weight = 0.;  ///< of all robots [N]
  double height = 0.;  ///< of the first base [m]
};

class Trials {
 public:
  Trials(std::filesystem::path file, std::filesystem::path place, bool stands, RobotJoints joints,
         Consent consent)
      : file_(std::move(file)),
        place_(std::move(place)),
        stands_(stands),
        joints_(joints),
        consent_(consent) {}

  /// The best that there is: its keyframe rather than its zero pose, its own shapes rather than boxes of
  /// inertia, but for a robot whose feet are meshes that are not there.
  std::optional<Trial> best() const {
    for (const char* pose : {"keyframe = home", ""}) {
      if (auto whole = with(pose, "meshes = hull")) return whole;
      const auto own = with(pose, ""), boxes = with(pose, "shapes = inertia");
      constexpr double part = 0.87;  // of its height, less where feet do not touch
      if (own && !(boxes && own->height < part * boxes->height)) return own;
      if (boxes) return boxes;
    }
    return of({});
  }

 private:
  std::optional<Trial> with(const std::string& pose, const std::string& shapes) const {
    Arguments arguments;
    if (stands_) arguments.emplace_back("rest_on = ground");
    if (joints_ == RobotJoints::held) arguments.push_back(fmt::format("hold = {}", hold));
    for (const std::string& further : {pose, shapes})
      if (!further.empty()) arguments.push_back(further);
    return of(arguments);
  }

  std::optional<Trial> of(const Arguments& arguments) const {
    Trial trial;
    trial.include = include_of(file_, arguments);
    Application application(consent_, [](const language::Diagnostics&) {});
    application.give(place_, world_with(trial.include, stands_ ? 1. : 0.));
    const auto root = application.evaluate(place_, {});
    if (!root || !has_shape(*root->children_of("World").front())) return std::nullopt;
    const auto experiment = application.load(*root);
    if (!experiment) return std::nullopt;
    trial.weight = weight_of(*experiment);
    trial.height = experiment->robots.front().location.z;
    return trial;
  }

  const std::filesystem::path file_, place_;
  const bool stands_;
  const RobotJoints joints_;
  const Consent consent_;
};

}  // namespace

std::optional<RobotWorld> world_of_robot(Application& application,
                                         const std::filesystem::path& file, Consent consent,
                                         RobotJoints joints) {
  if (application.library().declares(file, "World")) return std::nullopt;
  Application quiet(consent, [](const language::Diagnostics&) {});
  const auto alone = quiet.evaluate(file, {});
  if (!alone || !alone->children_of("World").empty()) return std::nullopt;
  const auto robots = alone->children_of("Robot");
  if (robots.empty()) return std::nullopt;

  // A file of another format may hold the ground, too.
  const bool stands = alone->children_of("Terrain.").empty() &&
                      std::ranges::any_of(robots, [](const language::Object* robot) {
                        return robot->children_of("Base.fixed").empty();
                      });
  const std::filesystem::path place =
      file.parent_path() / (file.stem().string() + "_on_a_plane.hook");
  const auto best = Trials(file, place, stands, joints, consent).best();
  if (!best) return std::nullopt;
  return RobotWorld{
      place, world_with(best->include, stands ? best->weight / parts_of_weight : 0.),
      fmt::format("{} has no World: it is put into one with {}",
                  text::printable(file.filename().string()), text::printable(best->include))};
}

std::filesystem::path file_with_world(Application& application, const std::filesystem::path& file,
                                      Consent consent, RobotJoints joints) {
  const auto world = world_of_robot(application, file, consent, joints);
  if (!world) return file;
  language::Diagnostics said;
  said.note({}, world->note);
  application.tell(said);
  application.give(world->file, world->text);
  return world->file;
}

}  // namespace hookpoint::application
