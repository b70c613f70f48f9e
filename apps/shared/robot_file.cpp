#include "apps/shared/robot_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "text/display.h"
#include "text/number.h"

namespace hookpoint::application {
namespace {

constexpr double gravity = 9.81;          // [m/s^2], the default of a World
constexpr double parts_of_weight = 4.;    // on a contact point, as of four feet
constexpr const char* hold = "0.03 rad";  // by which joints deflect at most

using Arguments = std::vector<std::string>;

/// What an Include of the file may be given, the best first. A module of the language takes none of them.
std::vector<Arguments> choices(bool stands) {
  std::vector<Arguments> all;
  for (const bool keyframe : {true, false})
    for (const char* shapes : {"meshes = hull", "", "shapes = inertia"}) {
      Arguments& arguments = all.emplace_back();
      if (stands) arguments.emplace_back("rest_on = ground");
      arguments.push_back(fmt::format("hold = {}", hold));
      if (keyframe) arguments.emplace_back("keyframe = home");
      if (*shapes != '\0') arguments.emplace_back(shapes);
    }
  all.emplace_back();
  return all;
}

std::string include_of(const std::filesystem::path& file, const Arguments& arguments) {
  const std::string name = language::quote(file.filename().string());
  if (arguments.empty()) return fmt::format("Include {};", name);
  return fmt::format("Include {} ({});", name, fmt::join(arguments, ", "));
}

/// On a floor that gives way by 1 mm under `load` [N] on a contact point; in the air where that is 0.
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

}  // namespace

std::filesystem::path with_a_world(Application& application, const std::filesystem::path& file,
                                   bool allow_plugins) {
  const auto silent = [](const language::Diagnostics&) {};
  Application trial(allow_plugins, silent);
  const auto alone = trial.evaluate(file, {});
  if (!alone || !alone->children_of("World").empty()) return file;
  const auto robots = alone->children_of("Robot");
  if (robots.empty()) return file;

  const bool stands = std::ranges::none_of(robots, [](const language::Object* robot) {
    return !robot->children_of("Base.fixed").empty();
  });
  const std::filesystem::path place =
      file.parent_path() / (file.stem().string() + "_on_a_plane.hook");
  for (const Arguments& arguments : choices(stands)) {
    const std::string include = include_of(file, arguments);
    Application world(allow_plugins, silent);
    world.give(place, world_with(include, stands ? 1. : 0.));
    const auto root = world.evaluate(place, {});
    if (!root || !has_shape(*root->children_of("World").front())) continue;
    const auto experiment = world.load(*root);
    if (!experiment) continue;
    const double load = stands ? weight_of(*experiment) / parts_of_weight : 0.;
    application.give(place, world_with(include, load));
    std::cerr << "hookpoint: note: " << text::printable(file.filename().string())
              << " has no World: it is put into one with " << text::printable(include) << '\n';
    return place;
  }
  return file;
}

}  // namespace hookpoint::application
