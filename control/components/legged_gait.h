// What every gait has: commands, the robot's measures, feet, and the joint goals that follow from
// where the feet are.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "control/component.h"
#include "control/components/foot_path.h"
#include "control/leg_kinematics.h"

namespace hookpoint::control {

constexpr std::size_t leg_joints = 3;

/// Legs are numbered along the right side from the rear, then along the left one.
class LeggedGait : public Component {
  // Before the ports, which are built by them.
  const std::size_t most_;     ///< legs that the ports are for
  const std::string counter_;  ///< parameter that says how many there are; "": all of them

 public:
  Parameter forward{*this, "forward", "m/s", 0., "commanded speed along the body's x"};
  Parameter sideways{*this, "sideways", "m/s", 0., "commanded speed along the body's y (left)"};
  Parameter turn{*this, "turn", "rad/s", 0., "commanded yaw rate, positive to the left"};
  Parameter command_lag = Parameter{*this, "command_lag", "s", 0.3,
                                    "time constant with which the commands are followed"}
                              .range(0., 100.);
  Parameter stand =
      Parameter{*this, "stand", "s", 0.5, "time to stand before the first step"}.range(0., 1e6);
  Text leg =
      Text{*this, "leg",
           "insect: a coxa about the hip's z (up), then femur and tibia about parallel horizontal "
           "axes; mammal: a hip about its z (forward), then thigh and shank about its y (left), x "
           "is down",
           "insect"}
          .choices({"insect", "mammal"});
  Parameter joints =
      Parameter{
          *this, "joints", "", 3.,
          "of each leg; 2: femur and tibia, or thigh and shank, alone, in the hip's plane of x and "
          "z (of mammals down and backwards)"}
          .range(2., 3.);
  Parameter coxa_length = Parameter{*this,
                                    "coxa_length",
                                    "m",
                                    0.05,
                                    "of each insect leg, from the coxa's axis to the femur's",
                                    most_}
                              .counted_by(counter_)
                              .range(0., 1e3);
  Parameter hip_offset =
      Parameter{
          *this,
          "hip_offset",
          "m",
          0.,
          "of each mammal leg, from the hip's axis to the plane of thigh and shank, positive to the "
          "left",
          most_}
          .counted_by(counter_);
  Parameter femur_length =
      Parameter{*this,
                "femur_length",
                "m",
                0.1,
                "of each leg, from the femur's axis to the tibia's, or the thigh's to the shank's",
                most_}
          .counted_by(counter_)
          .range(1e-6, 1e3);
  Parameter tibia_length =
      Parameter{*this, "tibia_length", "m", 0.15, "of each leg, from the tibia's axis to the foot",
                most_}
          .counted_by(counter_)
          .range(1e-6, 1e3);
  Parameter knee_up =
      Parameter{*this, "knee_up", "", 1.,
                "of insects, 1: the knee is above the line from hip to foot, 0: below"}
          .range(0., 1.);
  Parameter knee_forward =
      Parameter{
          *this,
          "knee_forward",
          "",
          1.,
          "of mammals, each leg, 1: the knee is before the line from hip to foot, 0: behind it",
          most_}
          .counted_by(counter_)
          .range(0., 1.);
  Parameter hip_x = Parameter{*this,
                              "hip_x",
                              "m",
                              0.,
                              "hips in the body's axes, right legs from the rear, then left ones",
                              most_}
                        .counted_by(counter_);
  Parameter hip_y =
      Parameter{*this, "hip_y", "m", 0., "hips in the body's axes", most_}.counted_by(counter_);
  Parameter hip_heading =
      Parameter{*this, "hip_heading", "rad", 0., "yaw of the hip's x axis in the body", most_}
          .counted_by(counter_);
  Parameter foot_x =
      Parameter{*this, "foot_x", "m", 0., "neutral foot positions in the body's axes", most_}
          .counted_by(counter_);
  Parameter foot_y =
      Parameter{*this, "foot_y", "m", 0., "neutral foot positions in the body's axes", most_}
          .counted_by(counter_);
  Parameter body_height =
      Parameter{*this, "body_height", "m", 0.1, "of the hips above the feet"}.range(0., 1e3);
  Parameter step_height =
      Parameter{*this, "step_height", "m", 0.03, "of the foot above the ground in mid-swing"}.range(
          0., 1e3);
  Parameter swing_lift =
      Parameter{
          *this, "swing_lift", "", 0.,
          "part of the swing in which the foot rises before it goes forwards, and sinks after"}
          .range(0., 0.4);
  Parameter search_depth = Parameter{*this, "search_depth", "m", 0.02,
                                     "how far a foot whose wired contact is 0 reaches below"}
                               .range(0., 1e3);
  Parameter search_speed =
      Parameter{*this, "search_speed", "m/s", 0.2, "how fast it does"}.range(0., 1e3);

  Input height_offset =
      Input{*this, "height_offset", "m", "lengthens a leg: raises the body there", 0., most_}
          .counted_by(counter_);
  Input placement_x =
      Input{*this, "placement_x", "m", "moves the place where a swing ends, along the body's x",
            0.,    most_}
          .counted_by(counter_);
  Input placement_y =
      Input{*this, "placement_y", "m", "the same, along the body's y", 0., most_}.counted_by(
          counter_);
  Input contact =
      Input{*this, "contact",
            "?",   "above 0 while the foot carries load; a swing past its middle ends there",
            0.,    most_}
          .counted_by(counter_);

  Output goal{
      *this, "goal", "rad",
      "joint angles: coxa, femur, tibia, or hip, thigh, shank of leg 0, then of leg 1 ...; of "
      "2 joints the first is 0",
      most_* leg_joints};
  Output phase{*this, "phase", "", "0 to 0.5 through stance, 0.5 to 1 through swing", most_};
  Output stance{*this, "stance", "", "1 in stance, 0 in swing", most_};
  Output unreachable{*this, "unreachable", "", "legs whose foot is out of reach at the moment"};

  State foot_position{*this, "foot_position", "m",
                      "x, y in the body's axes and height over the ground, leg by leg", 3 * most_};
  State lift_off_position{*this, "lift_off_position", "m", "where the last swing of each leg began",
                          3 * most_};
  State lift_off_velocity{*this, "lift_off_velocity", "m/s", "how fast the ground moved there",
                          3 * most_};
  State swing_progress{*this, "swing_progress", "", "through the swing, 0 to 1; -1 in stance",
                       most_};
  State followed_forward{*this, "followed_forward", "m/s", "the command as followed"};
  State followed_sideways{*this, "followed_sideways", "m/s", "the command as followed"};
  State followed_turn{*this, "followed_turn", "rad/s", "the command as followed"};
  State elapsed{*this, "elapsed", "s", "since the start"};

  /// Feet at their neutral positions. Throws std::runtime_error for one out of reach.
  void start(double period) final;
  void update(const Tick& tick) final;

 protected:
  /// For at most `most` legs; how many there are says the parameter `counter`, "" for all of them.
  explicit LeggedGait(std::size_t most, std::string counter = "")
      : most_(most), counter_(std::move(counter)), feet_(most) {}
  /// How many legs there are, at the start; the ports of the others stay as they are.
  virtual std::size_t legs_at_start() const { return most_; }
  std::size_t legs() const { return legs_; }
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
  /// What is added to where a swing ends.
  Vector3d placement(std::size_t leg) const { return {placement_x[leg], placement_y[leg], 0.}; }
  SwingHeight swing_height() const { return {step_height, swing_lift}; }
  GroundSearch search(std::size_t leg) const;
  /// A swing ends early: past its middle the foot has met something.
  bool meets_ground(std::size_t leg) const;

  std::vector<FootPath> feet_;  ///< during an update; between two they rest in the states

 private:
  std::size_t legs_ = most_;
  LegKind kind_ = LegKind::insect;
  bool is_mammal_ = false;
  void load_feet();
  void save_feet();
  LegGoal solve(std::size_t leg) const;
  Leg leg_of(std::size_t leg) const;
  void write_outputs();
};

}  // namespace hookpoint::control
