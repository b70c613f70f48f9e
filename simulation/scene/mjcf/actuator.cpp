#include "simulation/scene/mjcf/actuator.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace hookpoint::simulation {
namespace {

/// What MuJoCo's compiler writes of an actuator, one tag after the other.
struct ActuatorNumbers {
  std::array<double, 10> gain{1.}, bias{};
  bool is_affine = false, is_other = false;
  double inherited_range = 0.;
};

void take_numbers(const XmlElement& level, const char* attribute, std::span<double> into) {
  std::ranges::copy(level.file->numbers(level.node, attribute, into.size()), into.begin());
}

std::optional<double> given_number(const XmlElement& level, const char* attribute) {
  if (!level.node.attribute(attribute)) return std::nullopt;
  double value = 0.;
  take_numbers(level, attribute, {&value, 1});
  return value;
}

/// An error below 0.
std::optional<double> given_damping(const XmlElement& level, const char* attribute) {
  const std::optional<double> value = given_number(level, attribute);
  if (value && *value < 0.)
    level.file->fail(level.place(attribute), std::string(attribute) + " is not negative");
  return value;
}

void take_general(const XmlElement& level, ActuatorNumbers& of) {
  take_numbers(level, "gainprm", of.gain);
  take_numbers(level, "biasprm", of.bias);
  const std::string gain = level.text("gaintype"), bias = level.text("biastype");
  if (!bias.empty()) of.is_affine = bias == "affine";
  const bool is_other =
      (!gain.empty() && gain != "fixed") || (!bias.empty() && bias != "affine" && bias != "none");
  of.is_other = is_other || (of.is_other && gain.empty() && bias.empty());
}

void take_position(const XmlElement& level, ActuatorNumbers& of) {
  of.gain[0] = given_number(level, "kp").value_or(of.gain[0]);
  of.bias[1] = -of.gain[0];
  const std::optional<double> damping = given_damping(level, "kv"),
                              ratio = given_damping(level, "dampratio");
  if (damping && ratio)
    level.file->fail(level.place("dampratio"), "kv and dampratio are given: one is allowed");
  if (damping) of.bias[2] = -*damping;
  if (ratio) of.bias[2] = *ratio;
  take_numbers(level, "inheritrange", {&of.inherited_range, 1});
  of.is_affine = true;
  of.is_other = false;
}

void take_velocity(const XmlElement& level, ActuatorNumbers& of) {
  of.gain[0] = given_number(level, "kv").value_or(of.gain[0]);
  of.bias = {0., 0., -of.gain[0]};
  of.is_affine = true;
  of.is_other = false;
}

/// Numbers of a bias stay for a tag that has one.
void take_motor(ActuatorNumbers& of) {
  of.gain[0] = 1.;
  of.is_affine = of.is_other = false;
}

}  // namespace

MjcfActuator read_mjcf_actuator(const MjcfAttributes& given) {
  ActuatorNumbers read;
  for (const XmlElement& level : given.levels()) {
    const std::string_view tag = level.tag();
    if (tag == "general") {
      take_general(level, read);
    } else if (tag == "position") {
      take_position(level, read);
    } else if (tag == "velocity") {
      take_velocity(level, read);
    } else if (tag == "motor") {
      take_motor(read);
    } else {
      read.is_other = true;
    }
  }
  MjcfActuator actuator;
  actuator.gear = given.numbers("gear", {1., 0., 0., 0., 0., 0.})[0];
  actuator.gain = read.gain[0];
  if (read.is_affine) actuator.bias = {read.bias[0], read.bias[1], read.bias[2]};
  actuator.is_linear = !read.is_other;
  actuator.inherited_range = read.inherited_range;
  return actuator;
}

void MjcfActuator::settle_damping(double inertia) {
  if (!(bias[2] > 0.) || bias[1] != -gain || gear == 0.) return;
  bias[2] *= -2. * std::sqrt(std::max(gain, 0.) * inertia) / std::abs(gear);
}

}  // namespace hookpoint::simulation
