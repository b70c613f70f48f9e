// What the writers of models share: the tree of bodies with names, numbers as text, and the list of
// what is left out.
#pragma once

#include <initializer_list>
#include <map>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <vector>

#include "reference/robot_tree.h"
#include "translation/models/model.h"

namespace hookpoint::translation {

/// Numbers that read back to the last bit, with blanks in between.
std::string numbers(std::span<const double> values);
std::string numbers(std::initializer_list<double> values);
std::string numbers(const Vector3d& v);
/// w, x, y, z.
std::string numbers(const Quaterniond& q);

/// Roll, pitch, yaw [rad] with from_roll_pitch_yaw(...) = `q` to rounding, also where pitch is
/// +-pi/2.
Vector3d roll_pitch_yaw(const Quaterniond& q);

/// A child of `parent` with these attributes.
pugi::xml_node element(pugi::xml_node parent, const char* name,
                       std::initializer_list<std::pair<const char*, std::string>> attributes = {});
/// A child that holds a text: <mass>2</mass>.
void leaf(pugi::xml_node parent, const char* name, const std::string& text);
/// The document as text, indented.
std::string text_of(const pugi::xml_document& document);

/// What is left out, once each, with how often.
class LeftOut {
 public:
  void add(const std::string& what, std::size_t times = 1) {
    if (times > 0) counts_[what] += times;
  }
  std::vector<std::string> list() const;

 private:
  std::map<std::string, std::size_t> counts_;
};

/// A robot's bodies as a tree, with names of letters, digits and _ that no two share.
class ModelTree {
 public:
  ModelTree(const simulation::Experiment& experiment, std::span<const std::size_t> robots);

  const reference::TreeBody& body(std::size_t index) const { return tree_.bodies[index]; }
  const std::string& name(std::size_t index) const { return names_[index]; }
  /// Bodies that `index` carries.
  std::vector<std::size_t> children(std::size_t index) const;
  /// Of a robot of the experiment.
  std::size_t base(std::size_t robot) const { return tree_.bases[robot]; }
  std::size_t size() const { return tree_.bodies.size(); }
  /// Of the body that joint `joint` of robot `robot` carries.
  std::size_t carried(int robot, std::size_t joint) const {
    return tree_.index(robot, static_cast<int>(joint) + 1);
  }

 private:
  reference::RobotTree tree_;
  std::vector<std::string> names_;
};

/// A ball of a body that touches beside its shapes.
struct ContactBall {
  Vector3d center;  ///< body axes [m]
  double radius;    ///< [m]
  bool is_point;    ///< a ContactPoint, whose ball has the radius of reference::point_ball_radius
};
/// Of the ContactPoints of a body: of its shapes' own samples there are none, for the shapes touch.
std::vector<ContactBall> contact_balls(const simulation::BodySpec& body);

/// What a joint has that no format of robots holds.
void leave_out_joint(const simulation::LinkSpec& link, LeftOut& left_out);
/// What an experiment has beside robots and ground that no model holds.
void leave_out_parts(const simulation::Experiment& experiment, LeftOut& left_out);

}  // namespace hookpoint::translation
