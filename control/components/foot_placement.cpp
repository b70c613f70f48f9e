// Where feet are to land so that a running body keeps its speed: Raibert, Legged Robots That Balance
// (1986), chapters 2 and 3. A foot that lands v T_s/2 before the hip is at its neutral point: the body
// passes over it as fast as it came. Further forward it slows the body, further back it speeds it up:
//
//   x_f = v T_s/2 + k (v - v_d)
//
// A gait lands half a stance of its command before the neutral position, v_d T_s/2. What is left to add
// is (T_s/2 + k) (v - v_d). Over ground that is not level, and under a body that leans, the neutral point
// is on the plumb line through the hip.
#include <algorithm>
#include <cmath>

#include "control/registry.h"
#include "math/rotation.h"

namespace hookpoint::control {
namespace {

class FootPlacement final : public Component {
 public:
  static constexpr std::size_t most = 16;

  Parameter legs =
      Parameter{*this, "legs", "", 4., "how many: 1 to 16"}.range(1., static_cast<double>(most));
  Parameter forward{*this, "forward", "m/s", 0., "wanted speed along the body's x"};
  Parameter sideways{*this, "sideways", "m/s", 0., "wanted speed along the body's y (left)"};
  Parameter turn{*this, "turn", "rad/s", 0., "wanted yaw rate, positive to the left"};
  Parameter stance_time =
      Parameter{*this, "stance_time", "s", 0.2, "T_s, how long a foot stands"}.range(0., 1e3);
  Parameter speed_gain =
      Parameter{*this, "speed_gain", "s", 0.05, "k, how far a foot moves per error of speed"}.range(
          0., 1e3);
  Parameter plumb =
      Parameter{*this, "plumb", "", 1.,
                "part of the way from below the hip in the body's axes to the plumb line "
                "through the hip"}
          .range(0., 1.);
  Parameter body_height =
      Parameter{*this, "body_height", "m", 0.3, "of the hips above the feet"}.range(0., 1e3);
  Parameter largest =
      Parameter{*this, "largest", "m", 0.15, "placement along either axis"}.range(0., 1e3);
  Parameter foot_x =
      Parameter{*this, "foot_x", "m", 0., "neutral foot positions in the body's axes", most}
          .counted_by("legs");
  Parameter foot_y =
      Parameter{*this, "foot_y", "m", 0., "neutral foot positions in the body's axes", most}
          .counted_by("legs");

  Input orientation =
      Input{*this, "orientation", "", "R_WB as a quaternion w, x, y, z", 0., 4}.attached(
          "orientation");
  Input velocity =
      Input{*this, "velocity", "m/s", "of the body's origin, world axes", 0., 3}.attached(
          "velocity");
  Input angular_velocity =
      Input{*this, "angular_velocity", "rad/s", "of the body, world axes", 0., 3}.attached(
          "angular_velocity");

  Output placement_x{*this, "placement_x", "m",
                     "what is to be added to where each foot lands, along the body's x", most};
  Output placement_y{*this, "placement_y", "m", "the same, along the body's y", most};
  Output speed{*this, "speed", "m/s", "of the body along its heading and to the left of it", 2};

  void update(const Tick&) override {
    const Quaterniond q_BW =
        conjugate(Quaterniond{orientation[0], orientation[1], orientation[2], orientation[3]});
    const Vector3d up_B = rotate(q_BW, Vector3d{0., 0., 1.});
    // The heading is the body's x without its rise.
    const Vector3d x_W = rotate(conjugate(q_BW), Vector3d{1., 0., 0.});
    const double level = std::hypot(x_W.x, x_W.y);
    const double cosine = level > 0. ? x_W.x / level : 1., sine = level > 0. ? x_W.y / level : 0.;
    const double ahead = cosine * velocity[0] + sine * velocity[1];
    const double left = cosine * velocity[1] - sine * velocity[0];
    speed.set(0, ahead);
    speed.set(1, left);

    // Of a body that lies on its side there is no plumb line to the ground below its feet.
    const double drop = plumb * body_height / std::max(up_B.z, 0.5);
    const double share = 0.5 * stance_time + speed_gain;
    const double turns = angular_velocity[2] - turn;
    const auto count = static_cast<std::size_t>(legs);
    for (std::size_t leg = 0; leg < count; ++leg) {
      // Of the point of the body over the foot.
      const double faster_ahead = ahead - forward - turns * foot_y[leg];
      const double faster_left = left - sideways + turns * foot_x[leg];
      placement_x.set(leg, within(share * faster_ahead - drop * up_B.x));
      placement_y.set(leg, within(share * faster_left - drop * up_B.y));
    }
  }

 private:
  double within(double placement) const { return std::clamp<double>(placement, -largest, largest); }
};

HOOKPOINT_REGISTER_COMPONENT(
    FootPlacement, "Controller.FootPlacement",
    "where feet land so that a body keeps its speed, after Raibert; for a gait's placement",
    Attachment::body, "", "placement_x")

}  // namespace
}  // namespace hookpoint::control
