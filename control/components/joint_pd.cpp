// Proportional-derivative control of the joints of up to six legs of three, one set of constants for
// all coxae, femora, tibiae, or hips, thighs, shanks.
#include <algorithm>
#include <cstddef>

#include "control/components/hexapod_gait.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class JointPD final : public Component {
 public:
  static constexpr std::size_t joints = leg_count * leg_joints;
  Parameter legs = Parameter{*this, "legs", "", 6., "how many: 1 to 6"}.range(1., 6.);
  Parameter pconstant =
      Parameter{
          *this,     "pconstant", "N.m/rad", 30., "torque per angle error: coxa, femur, tibia",
          leg_joints}
          .range(0., 1e9);
  Parameter dconstant =
      Parameter{*this,     "dconstant", "N.m.s/rad", 0.3, "torque per rate: coxa, femur, tibia",
                leg_joints}
          .range(0., 1e9);
  Parameter limit =
      Parameter{*this, "limit", "N.m", 10., "largest torque: coxa, femur, tibia", leg_joints}.range(
          0., 1e9);

  Input goal{*this, "goal", "rad", "wanted angles: coxa, femur, tibia of leg 0, then of leg 1 ...",
             0.,    joints};
  Input angle{*this, "angle", "rad", "measured angles", 0., joints};
  Input rate_in{*this, "rate_in", "rad/s", "measured rates", 0., joints};

  Output torque{*this, "torque", "N.m",
                "pconstant (goal - angle) - dconstant rate_in within the limit", joints};

  void update(const Tick&) override {
    for (std::size_t joint = 0; joint < count(); ++joint) {
      const std::size_t kind = joint % leg_joints;
      const double wanted =
          pconstant[kind] * (goal[joint] - angle[joint]) - dconstant[kind] * rate_in[joint];
      torque.set(joint, std::clamp(wanted, -limit[kind], limit[kind]));
    }
  }

  // Without goals: a gait moves them.
  std::vector<LinearFeedback> linearise() const override {
    std::vector<LinearFeedback> all;
    for (std::size_t joint = 0; joint < count(); ++joint) {
      const std::size_t kind = joint % leg_joints;
      all.push_back({.input = angle.index(joint),
                     .output = torque.index(joint),
                     .rate = rate_in.index(joint),
                     .gains = {.proportional = pconstant[kind], .derivative = dconstant[kind]}});
    }
    return all;
  }

 private:
  std::size_t count() const { return leg_joints * static_cast<std::size_t>(legs); }
};

HOOKPOINT_REGISTER_COMPONENT(JointPD, "Controller.JointPD",
                             "a PD controller on each joint of up to six legs", Attachment::none,
                             "goal", "torque")

}  // namespace
}  // namespace hookpoint::control
