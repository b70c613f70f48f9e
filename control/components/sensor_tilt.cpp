// How a body leans: the two angles that do not depend on its heading.
#include <cmath>

#include "control/registry.h"
#include "math/rotation.h"

namespace hookpoint::control {
namespace {

class TiltSensor final : public Component {
 public:
  Input orientation =
      Input{*this, "orientation", "", "R_WB as a quaternion w, x, y, z", 0., 4}.attached(
          "orientation");
  Output roll{*this, "roll", "rad",
              "about the body's x, in R_WB = Rot_z(yaw) Rot_y(pitch) Rot_x(roll)"};
  Output pitch{*this, "pitch", "rad", "about y, positive with the nose (+x) down; within +-pi/2"};

  void update(const Tick&) override {
    const Quaterniond q_WB{orientation[0], orientation[1], orientation[2], orientation[3]};
    // The bottom row of R_WB is the world's z in body axes: (-sin pitch, cos pitch sin roll, cos
    // pitch cos roll).
    const Vector3d up_B = rotate(conjugate(q_WB), Vector3d{0., 0., 1.});
    roll = std::atan2(up_B.y, up_B.z);
    pitch = std::atan2(-up_B.x, std::hypot(up_B.y, up_B.z));
  }
};

HOOKPOINT_REGISTER_COMPONENT(TiltSensor, "Sensor.Tilt", "roll and pitch of a body",
                             Attachment::body, "", "roll")

}  // namespace
}  // namespace hookpoint::control
