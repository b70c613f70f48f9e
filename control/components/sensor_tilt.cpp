// How a body leans: the two angles that do not depend on its heading, of axes that the mounting
// turns from the body's.
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
  Parameter mounting_orientation =
      Parameter{*this,
                "mounting_orientation",
                "",
                0.,
                "R_BS: turns the unit's axes into the body's; by default not",
                4}
          .orientation();
  Output roll{*this, "roll", "rad",
              "about the unit's x, in R_WS = Rot_z(yaw) Rot_y(pitch) Rot_x(roll)"};
  Output pitch{*this, "pitch", "rad", "about y, positive with the nose (+x) down; within +-pi/2"};

  void update(const Tick&) override {
    const Quaterniond q_WB{orientation[0], orientation[1], orientation[2], orientation[3]};
    const Quaterniond q_BS =
        normalized(Quaterniond{mounting_orientation[0], mounting_orientation[1],
                               mounting_orientation[2], mounting_orientation[3]});
    // The bottom row of R_WS is the world's z in the unit's axes: (-sin pitch, cos pitch sin roll,
    // cos pitch cos roll).
    const Vector3d up_S = rotate(conjugate(q_WB * q_BS), Vector3d{0., 0., 1.});
    roll = std::atan2(up_S.y, up_S.z);
    pitch = std::atan2(-up_S.x, std::hypot(up_S.y, up_S.z));
  }
};

HOOKPOINT_REGISTER_COMPONENT(TiltSensor, "Sensor.Tilt", "roll and pitch of a body",
                             Attachment::body, "", "roll")

}  // namespace
}  // namespace hookpoint::control
