// The force of the ground on a body, as a load cell under a foot gives it, and whether the foot
// stood in the time that a reading covers.
//
// A reading is the mean force since the last one, momentum that the ground gave by the sensor's own
// period. So the step of the simulation is not seen in it, neither in a force nor in impulses.
#include "control/registry.h"
#include "math/vector3.h"

namespace hookpoint::control {
namespace {

class FootSensor final : public Component {
 public:
  Parameter threshold =
      Parameter{*this, "threshold", "N", 0., "a greater force counts as contact"}.range(0., 1e9);
  Input contact_force =
      Input{*this, "contact_force",
            "N",   "force of the ground on the body, world axes: mean since the last reading",
            0.,    3}
          .attached("contact.force")
          .mean();
  Output force{*this, "force", "N",
               "measured force on the body, mean since the last reading, world axes x, y, z", 3};
  Output normal{*this, "normal", "N", "its part along the world's z"};
  Output magnitude{*this, "magnitude", "N", "its magnitude"};
  Output contact{*this, "contact", "",
                 "1 where the magnitude exceeds the threshold, else 0; with a threshold of 0: "
                 "whether there was any contact since the last reading"};

  void update(const Tick&) override {
    const Vector3d f{contact_force[0], contact_force[1], contact_force[2]};
    force.set(0, f.x);
    force.set(1, f.y);
    force.set(2, f.z);
    normal = f.z;
    magnitude = norm(f);
    contact = magnitude > threshold ? 1. : 0.;
  }
};

HOOKPOINT_REGISTER_COMPONENT(FootSensor, "Sensor.Foot",
                             "ground force on a body, and contact yes or no", Attachment::body, "",
                             "contact")

}  // namespace
}  // namespace hookpoint::control
