// How a body leans: the two angles that do not depend on its heading, of axes that the mounting
// turns from the body's.
#include <cmath>

#include "control/components/mounting.h"
#include "control/registry.h"
#include "math/rotation.h"

namespace hookpoint::control {
namespace {

class TiltSensor final : public Component {
 public:
  Input orientation =
      Input{*this, "orientation", "", "R_WB as a quaternion w, x, y, z", 0., 4}.attached(
          "orientation");
  Parameter mounting_orientation = mounting_orientation_of(*this);
  Output roll{*this, "roll", "rad",
              "about the unit's x, in R_WS = Rot_z(yaw) Rot_y(pitch) Rot_x(roll)"};
  Output pitch{*this, "pitch", "rad", "about y, positive with the nose (+x) down; within +-pi/2"};

  void update(const Tick&) override {
    // The bottom row of R_WS is the world's z in the unit's axes: (-sin pitch, cos pitch sin roll,
    // cos pitch cos roll).
    const Quaterniond q_WS = unit_orientation(orientation, mounting_orientation);
    const Vector3d up_S = rotate(conjugate(q_WS), Vector3d{0., 0., 1.});
    roll = std::atan2(up_S.y, up_S.z);
    pitch = std::atan2(-up_S.x, std::hypot(up_S.y, up_S.z));
  }
};

HOOKPOINT_REGISTER_COMPONENT(TiltSensor, "Sensor.Tilt", "roll and pitch of a body",
                             Attachment::body, "", "roll")

}  // namespace
}  // namespace hookpoint::control
