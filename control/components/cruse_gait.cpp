// Six independent leg controllers, coordinated by the influences between neighbours that Cruse
// found in stick insects: Cruse, "What mechanisms coordinate leg movement in walking arthropods?",
// Trends in Neurosciences 13 (1990); Dürr, Schmitz & Cruse, "Behaviour-based modelling of hexapod
// locomotion", Arthropod Structure & Development 33 (2004).
#include <algorithm>
#include <cmath>

#include "control/components/hexapod_gait.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

constexpr std::size_t rows = 3;
constexpr std::size_t none = leg_count;
constexpr double long_ago = 1e9;  // [s]

constexpr std::size_t behind(std::size_t leg) { return leg % rows > 0 ? leg - 1 : none; }
constexpr std::size_t before(std::size_t leg) { return leg % rows + 1 < rows ? leg + 1 : none; }
constexpr std::size_t across(std::size_t leg) { return (leg + rows) % leg_count; }

class CruseGait final : public LeggedGait {
 public:
  CruseGait() : LeggedGait(leg_count) {}

  Parameter stride =
      Parameter{*this, "stride", "m", 0.05, "from the anterior to the posterior extreme position"}
          .range(1e-6, 1e3);
  Parameter swing_duration =
      Parameter{*this, "swing_duration", "s", 0.25, "of the way back, at any speed"}.range(1e-3,
                                                                                           1e3);
  Parameter rule1 = Parameter{*this, "rule1", "", 0.3,
                              "shift back of the lift-off while the leg behind swings, in strides"}
                        .range(0., 10.);
  Parameter rule2 =
      Parameter{*this, "rule2", "", 0.3, "shift forward just after the leg behind has touched down"}
          .range(0., 10.);
  Parameter rule2_time =
      Parameter{*this, "rule2_time", "s", 0.25, "how long that lasts"}.range(0., 1e3);
  Parameter rule3 = Parameter{*this, "rule3", "", 0.3,
                              "shift forward, growing as the stance leg before moves back"}
                        .range(0., 10.);
  Parameter rule3_across =
      Parameter{*this, "rule3_across", "", 0.15, "the same from the leg across"}.range(0., 10.);
  Parameter load = Parameter{*this, "load", "", 1.,
                             "shift back while a neighbour swings and leaves its load to this leg"}
                       .range(0., 10.);
  Parameter overreach = Parameter{*this, "overreach", "", 0.25,
                                  "strides past the lift-off at which a waiting leg stops the body"}
                            .range(1e-3, 10.);
  Parameter initial_phase = Parameter{*this,
                                      "initial_phase",
                                      "",
                                      0.5,
                                      "where in its stance each leg begins, 0 front to 1 rear",
                                      leg_count}
                                .range(0., 1.);
  Output pace{*this, "pace", "", "part of the commanded speed that waiting legs leave"};

  State placed{*this, "placed", "", "how many tripods have stepped to where they begin"};
  State landed{*this, "landed", "s", "since each leg's last touch-down", leg_count};
  State nominal_forward{*this, "nominal_forward", "m/s", "the command within what legs can step"};
  State nominal_sideways{*this, "nominal_sideways", "m/s", "the command within what legs can step"};
  State nominal_turn{*this, "nominal_turn", "rad/s", "the command within what legs can step"};
  State stance_time{*this, "stance_time", "s", "of a whole stance"};
  State walking{*this, "walking", "", "1 when fast enough that stepping is worth it"};

 private:
  void begin() override {
    placed = 0.;
    for (std::size_t leg = 0; leg < leg_count; ++leg) landed.set(leg, long_ago);
    measure(command());
    pace = 1.;
  }

  void step(double dt) override {
    if (placed < 2.) {
      place_feet(dt);
    } else {
      walk(dt);
    }
  }

  double phase_of(std::size_t leg) const override {
    return feet_[leg].swinging() ? 0.5 + 0.5 * feet_[leg].progress
                                 : 0.5 * std::clamp(progress(leg), 0., 1.);
  }

  /// The speed of the fastest foot over the ground that `twist` asks for [m/s].
  double fastest(const PlanarTwist& twist) const {
    double speed = 0.;
    for (std::size_t leg = 0; leg < leg_count; ++leg)
      speed = std::max(speed, norm(ground_velocity(neutral(leg), twist)));
    return speed;
  }

  /// From a commanded twist: that which leaves each leg a stance no shorter than its swing, and the
  /// time of a whole stance.
  void measure(const PlanarTwist& wanted) {
    const double speed = fastest(wanted);
    const double share = std::min(1., stride / (swing_duration * std::max(speed, 1e-12)));
    nominal_forward = share * wanted.forward;
    nominal_sideways = share * wanted.sideways;
    nominal_turn = share * wanted.turn;
    stance_time = stride / std::max(share * speed, 1e-12);
    walking = share * speed * 100. * swing_duration > stride ? 1. : 0.;
  }
  PlanarTwist nominal() const { return {nominal_forward, nominal_sideways, nominal_turn}; }

  /// Where the leg is on its way from the anterior (0) to the posterior (1) extreme position.
  double progress(std::size_t leg) const {
    const Vector3d velocity = ground_velocity(neutral(leg), nominal());
    const double squared = dot(velocity, velocity);
    const double least = 1e-3 * stride / swing_duration;
    const double along = dot(feet_[leg].position - neutral(leg), velocity);
    return 0.5 + along / (std::max(squared, least * least) * stance_time);
  }

  Vector3d target(std::size_t leg, double where) const {
    return carried(neutral(leg), nominal(), (where - 0.5) * stance_time);
  }

  /// Before the walk the legs step to where they are to begin, one tripod after the other.
  void place_feet(double dt) {
    measure(command());
    const bool first = placed < 1.;
    const double bound = first ? 1. : 2.;
    placed = std::min(bound, placed.get(0) + dt / swing_duration);
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      if (in_first_tripod(leg) != first || initial_phase[leg] == 0.5) continue;
      if (!feet_[leg].swinging()) feet_[leg].lift_off({});
      const double done = walking > 0.5 ? initial_phase[leg] : 0.5;
      feet_[leg].swing(placed - bound + 1., target(leg, done), {}, swing_duration, swing_height());
      if (placed == bound) feet_[leg].touch_down();
    }
  }

  void walk(double dt) {
    measure(follow_command(dt));
    double furthest = 0.;
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      if (!feet_[leg].swinging()) furthest = std::max(furthest, progress(leg));
    }
    pace = std::clamp(1. - (furthest - 1.) / overreach, 0., 1.);
    const PlanarTwist body{pace * nominal_forward, pace * nominal_sideways, pace * nominal_turn};
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      if (feet_[leg].swinging()) {
        swing(leg, body, dt);
      } else {
        feet_[leg].stand(body, dt, search(leg));
        landed.set(leg, landed.get(leg) + dt);
      }
    }
    for (std::size_t leg = 0; leg < leg_count; ++leg) {
      if (walking > 0.5 && !feet_[leg].swinging() && progress(leg) >= lift_off_at(leg))
        feet_[leg].lift_off(body);
    }
  }

  void swing(std::size_t leg, const PlanarTwist& body, double dt) {
    FootPath& foot = feet_[leg];
    foot.swing(std::min(1., foot.progress + dt / swing_duration), target(leg, 0.) + placement(leg),
               body, swing_duration, swing_height());
    if (foot.progress >= 1. || meets_ground(leg)) {
      foot.touch_down();
      landed.set(leg, 0.);
    }
  }

  bool swinging(std::size_t leg) const { return leg != none && feet_[leg].swinging(); }
  bool just_landed(std::size_t leg) const {
    return leg != none && !feet_[leg].swinging() && landed.get(leg) < rule2_time;
  }
  /// 0 while the leg swings or stands before its neutral position, growing to 1 at its posterior
  /// extreme position.
  double lateness(std::size_t leg) const {
    return leg == none || feet_[leg].swinging() ? 0. : std::clamp(2. * progress(leg) - 1., 0., 1.);
  }

  /// The progress at which the leg lifts off: its posterior extreme position as its neighbours
  /// shift it.
  double lift_off_at(std::size_t leg) const {
    double at = 1.;
    if (swinging(behind(leg))) at += rule1;
    if (just_landed(behind(leg))) at -= rule2;
    at -= rule3 * lateness(before(leg)) + rule3_across * lateness(across(leg));
    if (swinging(behind(leg)) || swinging(before(leg)) || swinging(across(leg))) at += load;
    return at;
  }
};

HOOKPOINT_REGISTER_COMPONENT(
    CruseGait, "Controller.CruseGait",
    "joint goals of a hexapod whose legs coordinate by Cruse's rules between neighbours",
    Attachment::none, "forward", "goal")

}  // namespace
}  // namespace hookpoint::control
