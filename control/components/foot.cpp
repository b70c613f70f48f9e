// Where a foot is to be, as angles of its joints; closed form (leg_kinematics.h).
#include <cmath>
#include <stdexcept>

#include "control/component.h"
#include "control/leg_kinematics.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Foot final : public Component {
 public:
  Input target{*this, "target", "m", "where the foot is to be, x, y, z in the hip's axes", 0., 3};
  Parameter joints =
      Parameter{
          *this, "joints", "", 3.,
          "3: coxa about the hip's z, then femur and tibia about parallel horizontal axes; 2: "
          "femur and tibia alone, in the hip's plane of x and z"}
          .range(2., 3.);
  Parameter coxa_length =
      Parameter{*this, "coxa_length", "m", 0.05, "of 3 joints: from the coxa's axis to the femur's"}
          .range(0., 1e3);
  Parameter femur_length =
      Parameter{*this, "femur_length", "m", 0.1, "from the femur's axis to the tibia's"}.range(1e-6,
                                                                                               1e3);
  Parameter tibia_length =
      Parameter{*this, "tibia_length", "m", 0.15, "from the tibia's axis to the foot"}.range(1e-6,
                                                                                             1e3);
  Parameter knee_up = Parameter{*this, "knee_up", "", 1.,
                                "1: the knee is above the line from hip to foot, 0: below"}
                          .range(0., 1.);
  Output angle{*this, "angle", "rad", "of the joints, from the hip; of 2 joints angle[2] is 0", 3};
  Output miss{*this, "miss", "m", "from the foot at these angles to the target: 0 within reach"};

  void start(double) override {
    if (joints != 2. && joints != 3.) throw std::runtime_error("joints is neither 2 nor 3");
    coxa_ = joints == 3.;
  }

  void update(const Tick&) override {
    const Vector3d wanted{target[0], target[1], target[2]};
    const Knee knee = knee_up > 0.5 ? Knee::up : Knee::down;
    if (coxa_) {
      const LegLengths lengths{coxa_length, femur_length, tibia_length};
      const LegAngles angles = leg_angles(lengths, wanted, knee).angles;
      angle.set(0, angles.coxa);
      angle.set(1, angles.femur);
      angle.set(2, angles.tibia);
      miss = norm(foot_position(lengths, angles) - wanted);
    } else {
      const ShankAngles angles = shank_angles(femur_length, tibia_length, wanted.x, wanted.z, knee);
      angle.set(0, angles.femur);
      angle.set(1, angles.tibia);
      miss =
          norm(foot_position({0., femur_length, tibia_length}, {0., angles.femur, angles.tibia}) -
               wanted);
    }
  }

 private:
  bool coxa_ = true;
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Foot, "Controller.Foot",
                             "joint angles of a leg of 2 or 3 joints that put its foot on a target",
                             Attachment::none, "target", "angle")
}  // namespace hookpoint::control
