#include <fmt/format.h>

#include <algorithm>

#include "simulation/kinematics.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {
namespace {

std::optional<double> limit_of(const language::Object& object, std::string_view field) {
  const language::Field* limit = object.find(field);
  return limit == nullptr ? std::nullopt : std::optional(limit->numbers[0]);
}

double number_or(const language::Object& object, std::string_view field, double otherwise) {
  return object.given(field) ? object.number(field) : otherwise;
}

void check_limits(const language::Object& object, const LinkSpec& link, Loading& loading) {
  if (link.lower_limit && link.upper_limit && *link.lower_limit >= *link.upper_limit) {
    return loading.error(place_of(object, "lower_limit"),
                         "lower_limit is not below upper_limit; exchange them");
  }
  const bool below = link.lower_limit && link.angle < *link.lower_limit;
  const bool above = link.upper_limit && link.angle > *link.upper_limit;
  if (below || above) {
    loading.error(
        place_of(object, "angle"),
        fmt::format("the joint starts at angle {:g}, {} of {:g}; start it within its limits",
                    link.angle, below ? "below its lower_limit" : "above its upper_limit",
                    below ? *link.lower_limit : *link.upper_limit));
  }
}

LinkSpec load_link(const language::Object& object, std::string name, Loading& loading) {
  LinkSpec link;
  link.body = load_body(object, std::move(name), false, loading);
  link.joint_location = vector_of(object, "joint_location");
  link.joint_orientation = orientation_of(object, "joint_orientation");
  link.a = object.number("dhlength");
  link.alpha = object.number("dhtwist");
  link.d = object.number("dhoffset");
  link.theta = object.number("dhangle");
  link.joint = object.word("joint") == "prismatic" ? JointKind::prismatic : JointKind::revolute;
  link.angle = object.number("angle");
  link.rate = object.number("rate");
  link.torque = object.number("torque");
  link.damping = object.number("damping");
  link.friction = object.number("friction");
  link.friction_deflection =
      number_or(object, "friction_deflection", default_friction_deflection(link.joint));
  link.friction_speed = number_or(object, "friction_speed", default_friction_speed(link.joint));
  link.limit_stiffness = number_or(object, "limit_stiffness", default_limit_stiffness(link.joint));
  link.limit_damping = number_or(object, "limit_damping", default_limit_damping(link.joint));
  link.stiffness = object.number("stiffness");
  link.rest_angle = object.number("rest_angle");
  link.lower_limit = limit_of(object, "lower_limit");
  link.upper_limit = limit_of(object, "upper_limit");
  check_limits(object, link, loading);
  return link;
}

/// What joint `joint` of the chain accelerates: the inertia of its link and all further out about
/// its axis (their mass, for a prismatic joint), and the size that such an inertia is measured
/// against.
struct MovedInertia {
  double value = 0., scale = 0.;
};
MovedInertia moved_inertia(const std::vector<LinkSpec>& links, std::size_t joint) {
  MovedInertia moved;
  Pose X_JL;
  for (std::size_t i = joint; i < links.size(); ++i) {
    if (i > joint) X_JL = X_JL * joint_pose(links[i]);
    const MassSpec& mass = links[i].body.mass;
    const Vector3d p_JC = X_JL.position + rotate(X_JL.orientation, mass.center_of_mass);
    const Symmetric3d I_C = rotate(rotation_matrix(X_JL.orientation), mass.inertia);
    const Symmetric3d I_J = I_C + point_inertia(mass.mass, p_JC);
    const bool turns = links[joint].joint == JointKind::revolute;
    moved.value += turns ? I_J.zz : mass.mass;
    moved.scale += turns ? I_J.xx + I_J.yy + I_J.zz : mass.mass;
  }
  return moved;
}

void check_joints(const std::vector<const language::Object*>& objects, const ChainSpec& chain,
                  Loading& loading) {
  for (std::size_t joint = 0; joint < chain.links.size(); ++joint) {
    const MovedInertia moved = moved_inertia(chain.links, joint);
    if (moved.value > 1e-12 * moved.scale) continue;
    loading.error(
        place_of(*objects[joint], "mass"),
        fmt::format(
            "the joint of `{}` moves no {}: give the link, or one further out, a mass{}",
            chain.links[joint].body.name,
            chain.links[joint].joint == JointKind::revolute ? "inertia about its axis" : "mass",
            chain.links[joint].joint == JointKind::revolute ? " and a shape or an `inertia`" : ""));
  }
}

ChainSpec load_chain(const language::Object& object, std::string name, BodyIndex& next,
                     Loading& loading) {
  ChainSpec chain;
  chain.name = std::move(name);
  chain.hip_distance = vector_of(object, "hip_distance");
  chain.hip_orientation = orientation_of(object, "hip_orientation");
  const std::size_t errors_before = loading.diagnostics.error_count();
  const std::vector<const language::Object*> links = object.children_of("Link");
  for (const language::Object* link : links) {
    chain.links.push_back(load_link(*link, name_within(*link, object), loading));
    loading.bodies.emplace(link, next);
    ++next.body;
  }
  if (links.empty()) {
    loading.error(
        object.position,
        fmt::format("chain `{}` has no links; give it a Link NAME {{ ... }}", chain.name));
  }
  if (loading.diagnostics.error_count() == errors_before) check_joints(links, chain, loading);
  return chain;
}

bool is_zero(const Vector3d& a) { return a == Vector3d{}; }

void load_base(const language::Object& object, RobotSpec& robot, Loading& loading) {
  robot.mobile = object.type == "Base.mobile";
  robot.base = load_body(object, object.name, robot.mobile, loading);
  robot.location = vector_of(object, "location");
  robot.orientation = orientation_of(object, "orientation");
  robot.velocity = vector_of(object, "velocity");
  robot.angular_velocity = vector_of(object, "angular_velocity");
  if (!robot.mobile) {
    for (const char* field : {"velocity", "angular_velocity"}) {
      if (is_zero(vector_of(object, field))) continue;
      loading.error(place_of(object, field),
                    "a Base.fixed does not move; make it a Base.mobile or leave this out");
    }
    return;
  }
  const bool rests = object.given("rest_on");
  for (const char* field : {"location", "orientation"}) {
    if (!rests || !object.given(field)) continue;
    loading.error(place_of(object, field),
                  fmt::format("rest_on already places the base; leave out {} or rest_on (`at` and "
                              "`yaw` go with rest_on)",
                              field));
  }
  for (const char* field : {"at", "yaw"}) {
    if (rests || !object.given(field)) continue;
    loading.error(
        place_of(object, field),
        fmt::format("{} goes with rest_on; add `rest_on = TERRAIN` or use location and orientation",
                    field));
  }
}

/// The one base, or null after saying why there is none.
const language::Object* find_base(const language::Object& robot, Loading& loading) {
  const std::vector<const language::Object*> bases = robot.children_of("Base.");
  if (bases.empty()) {
    loading.error(
        robot.position,
        fmt::format("robot `{}` has no base; give it a Base.fixed or a Base.mobile", robot.name));
    return nullptr;
  }
  for (std::size_t i = 1; i < bases.size(); ++i) {
    loading.error(bases[i]->position, "a second base; a robot has exactly one");
    loading.diagnostics.note(bases[0]->position, "the first is here");
  }
  return bases[0];
}

}  // namespace

void load_robots(const language::Object& world, Loading& loading) {
  for (const language::Object* object : world.children_of("Robot")) {
    RobotSpec robot;
    robot.name = name_within(*object, world);
    const language::Object* base = find_base(*object, loading);
    if (base == nullptr) continue;
    BodyIndex next{static_cast<int>(loading.experiment.robots.size()), 0};
    load_base(*base, robot, loading);
    loading.bodies.emplace(base, next);
    ++next.body;
    for (const language::Object* chain : object->children_of("Chain")) {
      robot.chains.push_back(load_chain(*chain, name_within(*chain, *object), next, loading));
    }
    loading.bases.push_back(base);
    loading.experiment.robots.push_back(std::move(robot));
  }
}

}  // namespace hookpoint::simulation
