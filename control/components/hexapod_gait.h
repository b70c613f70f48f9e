// What every hexapod gait has: commands, the robot's measures, six feet, and the joint goals that
// follow from where the feet are.
#pragma once

#include <array>
#include <cstddef>

#include "control/component.h"
#include "control/components/foot_path.h"
#include "control/leg_kinematics.h"

namespace hookpoint::control {

constexpr std::size_t leg_count = 6;
constexpr std::size_t leg_joints = 3;

/// Legs are numbered as in configs/robots/hexapod_legs.hook: 0 to 2 the right ones from the rear, 3
/// to 5 the left ones. Legs 0, 2, 4 are one tripod (right hind and front, left middle), 1, 3, 5 the
/// other.
constexpr bool in_first_tripod(std::size_t leg) { return leg % 2 == 0; }

class HexapodGait : public Component {
 public:
  Parameter forward{*this, "forward", "m/s", 0., "commanded speed along the body's x"};
  Parameter sideways{*this, "sideways", "m/s", 0., "commanded speed along the body's y (left)"};
  Parameter turn{*this, "turn", "rad/s", 0., "commanded yaw rate, positive to the left"};
  Parameter command_lag = Parameter{*this, "command_lag", "s", 0.3,
                                    "time constant with which the commands are followed"}
                              .range(0., 100.);
  Parameter stand =
      Parameter{*this, "stand", "s", 0.5, "time to stand before the first step"}.range(0., 1e6);
  Parameter coxa_length =
      Parameter{
          *this,    "coxa_length", "m", 0.05, "of each leg, from the coxa's axis to the femur's",
          leg_count}
          .range(0., 1e3);
  Parameter femur_length =
      Parameter{
          *this,    "femur_length", "m", 0.1, "of each leg, from the femur's axis to the tibia's",
          leg_count}
          .range(1e-6, 1e3);
  Parameter tibia_length =
      Parameter{
          *this,    "tibia_length", "m", 0.15, "of each leg, from the tibia's axis to the foot",
          leg_count}
          .range(1e-6, 1e3);
  Parameter knee_up = Parameter{*this, "knee_up", "", 1.,
                                "1: the knee is above the line from hip to foot, 0: below"}
                          .range(0., 1.);
  Parameter hip_x{*this,
                  "hip_x",
                  "m",
                  0.,
                  "hips in the body's axes, right legs from the rear, then left ones",
                  leg_count};
  Parameter hip_y{*this, "hip_y", "m", 0., "hips in the body's axes", leg_count};
  Parameter hip_heading{*this,    "hip_heading", "rad", 0., "yaw of the hip's x axis in the body",
                        leg_count};
  Parameter foot_x{*this,    "foot_x", "m", 0., "neutral foot positions in the body's axes",
                   leg_count};
  Parameter foot_y{*this,    "foot_y", "m", 0., "neutral foot positions in the body's axes",
                   leg_count};
  Parameter body_height =
      Parameter{*this, "body_height", "m", 0.1, "of the hips above the feet"}.range(0., 1e3);
  Parameter step_height =
      Parameter{*this, "step_height", "m", 0.03, "of the foot above the ground in mid-swing"}.range(
          0., 1e3);
  Parameter search_depth = Parameter{*this, "search_depth", "m", 0.02,
                                     "how far a foot whose wired contact is 0 reaches below"}
                               .range(0., 1e3);
  Parameter search_speed =
      Parameter{*this, "search_speed", "m/s", 0.2, "how fast it does"}.range(0., 1e3);

  Input height_offset{*this, "height_offset", "m", "lengthens a leg: raises the body there",
                      0.,    leg_count};
  Input contact{*this, "contact",
                "?",   "above 0 while the foot carries load; a swing past its middle ends there",
                0.,    leg_count};

  Output goal{*this, "goal", "rad", "joint angles: coxa, femur, tibia of leg 0, then of leg 1 ...",
              leg_count* leg_joints};
  Output phase{*this, "phase", "", "0 to 0.5 through stance, 0.5 to 1 through swing", leg_count};
  Output stance{*this, "stance", "", "1 in stance, 0 in swing", leg_count};
  Output unreachable{*this, "unreachable", "", "legs whose foot is out of reach at the moment"};

  State foot_position{*this, "foot_position", "m",
                      "x, y in the body's axes and height over the ground, leg by leg",
                      3 * leg_count};
  State lift_off_position{*this, "lift_off_position", "m", "where the last swing of each leg began",
                          3 * leg_count};
  State lift_off_velocity{*this, "lift_off_velocity", "m/s", "how fast the ground moved there",
                          3 * leg_count};
  State swing_progress{*this, "swing_progress", "", "through the swing, 0 to 1; -1 in stance",
                       leg_count};
  State followed_forward{*this, "followed_forward", "m/s", "the command as followed"};
  State followed_sideways{*this, "followed_sideways", "m/s", "the command as followed"};
  State followed_turn{*this, "followed_turn", "rad/s", "the command as followed"};
  State elapsed{*this, "elapsed", "s", "since the start"};

  /// Feet at their neutral positions. Throws std::runtime_error for one out of reach.
  void start(double period) final;
  void update(const Tick& tick) final;

 protected:
  /// The gait's own state at the start.
  virtual void begin() = 0;
  /// Moves the feet on by `dt` > 0 [s].
  virtual void step(double dt) = 0;
  /// Of a leg, as the output says.
  virtual double phase_of(std::size_t leg) const = 0;

  PlanarTwist command() const { return {forward, sideways, turn}; }
  /// Moves the command as followed towards the command by the lag's share of `dt`; returns it.
  PlanarTwist follow_command(double dt);
  Vector3d neutral(std::size_t leg) const { return {foot_x[leg], foot_y[leg], 0.}; }
  GroundSearch search(std::size_t leg) const;
  /// A swing ends early: past its middle the foot has met something.
  bool meets_ground(std::size_t leg) const;

  std::array<FootPath, leg_count> feet_;  ///< during an update; between two they rest in the states

 private:
  void load_feet();
  void save_feet();
  LegSolution solve(std::size_t leg) const;
  void write_outputs();
};

}  // namespace hookpoint::control
