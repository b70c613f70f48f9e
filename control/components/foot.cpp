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
  Text leg =
      Text{*this, "leg",
           "insect: coxa about the hip's z, then femur and tibia about parallel horizontal axes; "
           "mammal: hip about its z (forward), then thigh and shank about its y (left), x is down",
           "insect"}
          .choices({"insect", "mammal"});
  Parameter joints =
      Parameter{*this, "joints", "", 3.,
                "2: femur and tibia, or thigh and shank, alone, in the hip's plane of x "
                "and z"}
          .range(2., 3.);
  Parameter coxa_length = Parameter{*this, "coxa_length", "m", 0.05,
                                    "of an insect: from the coxa's axis to the femur's"}
                              .range(0., 1e3);
  Parameter hip_offset{*this, "hip_offset", "m", 0.,
                       "of a mammal: from the hip's axis to the plane of thigh and shank, along y"};
  Parameter femur_length =
      Parameter{*this, "femur_length", "m", 0.1, "from the femur's axis to the tibia's"}.range(1e-6,
                                                                                               1e3);
  Parameter tibia_length =
      Parameter{*this, "tibia_length", "m", 0.15, "from the tibia's axis to the foot"}.range(1e-6,
                                                                                             1e3);
  Parameter knee_up =
      Parameter{*this, "knee_up", "", 1.,
                "1: the last angle is at most 0: an insect's knee is above the line from hip to "
                "foot, a mammal's behind it; 0: below it, before it"}
          .range(0., 1.);
  Output angle{*this, "angle", "rad", "of the joints, from the hip; of 2 joints angle[2] is 0", 3};
  Output miss{*this, "miss", "m", "from the foot at these angles to the target: 0 within reach"};

  void start(double) override {
    if (joints != 2. && joints != 3.) throw std::runtime_error("joints is neither 2 nor 3");
    kind_ = joints == 2.              ? LegKind::planar
            : leg.value() == "mammal" ? LegKind::mammal
                                      : LegKind::insect;
  }

  void update(const Tick&) override {
    const Vector3d wanted{target[0], target[1], target[2]};
    const Leg of{kind_,
                 {coxa_length, femur_length, tibia_length},
                 hip_offset,
                 knee_up > 0.5 ? Knee::up : Knee::down};
    JointAngles angles = joint_angles(of, wanted).angles;
    miss = norm(foot_position(of, angles) - wanted);
    if (kind_ == LegKind::planar) angles = {angles[1], angles[2], 0.};
    for (std::size_t joint = 0; joint < angles.size(); ++joint) angle.set(joint, angles[joint]);
  }

 private:
  LegKind kind_ = LegKind::insect;
};

}  // namespace
HOOKPOINT_REGISTER_COMPONENT(Foot, "Controller.Foot",
                             "joint angles of a leg of 2 or 3 joints that put its foot on a target",
                             Attachment::none, "target", "angle")
}  // namespace hookpoint::control
