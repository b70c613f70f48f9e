#include "translation/models/writing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <sstream>

#include "reference/touching_points.h"
#include "text/number.h"

namespace hookpoint::translation {
namespace {

/// "leg[1].tibia" as a name of letters, digits and _: "leg_1_tibia".
std::string plain(const std::string& name) {
  std::string result;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_')
      result += c;
    else if (!result.empty() && result.back() != '_')
      result += '_';
  }
  return result;
}

}  // namespace

std::string numbers(std::span<const double> values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ' ';
    text::append_shortest(text, value == 0. ? 0. : value);  // no -0
  }
  return text;
}
std::string numbers(std::initializer_list<double> values) {
  return numbers(std::span<const double>(values.begin(), values.size()));
}
std::string numbers(const Vector3d& v) { return numbers({v.x, v.y, v.z}); }
std::string numbers(const Quaterniond& q) { return numbers({q.w, q.x, q.y, q.z}); }

Vector3d roll_pitch_yaw(const Quaterniond& q) {
  const Matrix3d r = rotation_matrix(normalized(q));
  const double level = std::hypot(r.xx, r.yx);
  // Where x points up or down roll and yaw turn about one axis: all of it is the roll's.
  const double yaw = level > 1e-12 ? std::atan2(r.yx, r.xx) : 0.;
  const double pitch = std::atan2(-r.zx, level);
  // The roll is what is left of y and z once the yaw is taken away.
  const double s = std::sin(yaw), c = std::cos(yaw);
  const double roll = std::atan2(s * r.xz - c * r.yz, c * r.yy - s * r.xy);
  return {roll, pitch, yaw};
}

pugi::xml_node element(pugi::xml_node parent, const char* name,
                       std::initializer_list<std::pair<const char*, std::string>> attributes) {
  pugi::xml_node node = parent.append_child(name);
  for (const auto& [attribute, value] : attributes)
    node.append_attribute(attribute).set_value(value.c_str());
  return node;
}

void leaf(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).text().set(text.c_str());
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream stream;
  document.save(stream, "  ", pugi::format_indent | pugi::format_no_declaration);
  return stream.str();
}

std::vector<std::string> LeftOut::list() const {
  std::vector<std::string> list;
  for (const auto& [what, count] : counts_)
    list.push_back(count == 1 ? what : fmt::format("{} ({} times)", what, count));
  return list;
}

ModelTree::ModelTree(const simulation::Experiment& experiment, std::span<const std::size_t> robots)
    : tree_(reference::robot_tree(experiment)) {
  std::set<std::string> taken;
  const bool several = robots.size() > 1;
  for (std::size_t r = 0; r < experiment.robots.size(); ++r) {
    const simulation::RobotSpec& robot = experiment.robots[r];
    const std::string prefix = several ? robot.name + "_" : "";
    const auto add = [&](const std::string& chain, const std::string& link) {
      std::string name = plain(prefix + link);
      if (taken.contains(name)) name = plain(prefix + chain + "_" + link);
      const std::string stem = name;
      for (int i = 2; taken.contains(name); ++i) name = fmt::format("{}_{}", stem, i);
      taken.insert(name);
      names_.push_back(name);
    };
    add(robot.name, robot.base.name);
    simulation::for_each_link(
        robot, [&](const simulation::TreeLink& at) { add(at.chain.name, at.link.body.name); });
  }
}

std::vector<std::size_t> ModelTree::children(std::size_t index) const {
  std::vector<std::size_t> list;
  for (std::size_t i = index + 1; i < tree_.bodies.size(); ++i)
    if (tree_.bodies[i].parent == static_cast<int>(index)) list.push_back(i);
  return list;
}

std::vector<ContactBall> contact_balls(const simulation::BodySpec& body) {
  std::vector<ContactBall> balls;
  for (std::size_t i = 0; i < body.boundary_points.size(); ++i) {
    const bool is_sample =
        std::ranges::any_of(body.shapes, [i](const simulation::ShapeSpec& shape) {
          return i >= shape.first_point && i < shape.first_point + shape.point_count;
        });
    if (is_sample) continue;
    const double radius = body.boundary_radius(i);
    balls.push_back({body.boundary_points[i], radius > 0. ? radius : reference::point_ball_radius,
                     radius == 0.});
  }
  return balls;
}

void leave_out_joint(const simulation::LinkSpec& link, LeftOut& left_out) {
  if (link.static_friction)
    left_out.add("static_friction and stribeck_velocity of a joint: it has one friction");
}

void leave_out_parts(const simulation::Experiment& experiment, LeftOut& left_out) {
  for (const simulation::ComponentSpec& component : experiment.components)
    left_out.add("the " + component.type);
  left_out.add("a Force", experiment.forces.size());
}

}  // namespace hookpoint::translation
