// A PD controller that also carries the weight of its joint's link:
//
//   output = pconstant (goal - angle) - dconstant rate + weight_moment cos(angle)
//
// for an angle that is 0 where the link lies level. The weight is cancelled whatever the angle, so
// what remains is linear, J angle'' = pconstant (goal - angle) - dconstant angle', and comes to
// rest at the goal itself, where plain PD sags by weight_moment cos(angle)/pconstant.
#include <cmath>

#include "control/component.h"
#include "control/registry.h"

namespace {

using namespace hookpoint::control;

class CompensatedPd final : public Component {
 public:
  Input goal{*this, "goal", "rad", "where the joint should be"};
  Input angle =
      Input{*this, "angle", "rad", "where it is, 0 when the link lies level"}.attached("angle");
  Input joint_rate = Input{*this, "joint_rate", "rad/s", "how fast it turns"}.attached("rate");
  Parameter pconstant =
      Parameter{*this, "pconstant", "N.m/rad", 10., "torque per error"}.range(0., 1e6);
  Parameter dconstant =
      Parameter{*this, "dconstant", "N.m.s/rad", 1., "torque per rate"}.range(0., 1e6);
  Parameter weight_moment{*this, "weight_moment", "N.m", 0.,
                          "moment of the link's weight about the joint, lying level"};
  Output output = Output{*this, "output", "N.m", "torque"}.attached("torque");

  void update(const Tick&) override {
    output = pconstant * (goal - angle) - dconstant * joint_rate + weight_moment * std::cos(angle);
  }
};

HOOKPOINT_REGISTER_COMPONENT(CompensatedPd, "Controller.CompensatedPD",
                             "PD that carries the weight of its link", Attachment::joint, "goal")

}  // namespace
