// A gait of any even number of legs from a table: when in the period each leg touches down.
// Wave gaits: McGhee & Frank, "On the stability properties of quadruped creeping gaits",
// Mathematical Biosciences 3 (1968); Song & Waldron, Machines That Walk (1989), chapter 3. Of mammals:
// Hildebrand, "Symmetrical gaits of horses", Science 150 (1965) 701-708; Collins & Stewart, "Coupled
// nonlinear oscillators and the symmetries of animal gaits", J. Nonlinear Science 3 (1993) 349-392.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "control/components/clocked_gait.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

/// A gait of four legs: when in the period the right hind, right fore, left hind and left fore foot
/// touch down.
struct FourLegs {
  std::string_view name;
  std::array<double, 4> touch_down;
};
constexpr std::array four_legs{
    FourLegs{"walk", {0.5, 0.75, 0., 0.25}},  // each hind foot before the fore foot of its side
    FourLegs{"trot", {0.5, 0., 0., 0.5}},     // diagonal pairs
    FourLegs{"pace", {0.5, 0.5, 0., 0.}},     // the legs of a side
    FourLegs{"bound", {0., 0.5, 0., 0.5}},    // hind feet, then fore feet
    FourLegs{"gallop",
             {0.1, 0.6, 0., 0.5}}  // as a bound, the right feet a little later: transverse
};

class Gait final : public ClockedGait {
 public:
  static constexpr std::size_t most = 16;

  Parameter leg_number = Parameter{*this, "legs", "", 6., "how many: even, 2 to 16"}.range(
      2., static_cast<double>(most));
  Text pattern =
      Text{
          *this, "pattern",
          "alternating: neighbours half a period apart; wave: each leg lifts off as the "
          "one behind it touches down, the sides half a period apart; table: `touch_down`; of four "
          "legs: walk, trot, pace, bound, gallop",
          "alternating"}
          .choices({"alternating", "wave", "table", "walk", "trot", "pace", "bound", "gallop"});
  Parameter touch_down =
      Parameter{*this, "touch_down", "", 0., "of `table`: when each leg touches down, in periods",
                most}
          .counted_by("legs")
          .range(0., 1.);

  Gait() : ClockedGait(most, 0.01, "legs") {}

 private:
  std::size_t legs_at_start() const override {
    if (std::fmod(leg_number, 2.) != 0.) throw std::runtime_error("legs is no even number");
    if (named() != nullptr && leg_number != 4.)
      throw std::runtime_error("the pattern `" + pattern.value() +
                               "` is of four legs: write legs = 4");
    return static_cast<std::size_t>(leg_number);
  }

  void begin() override {
    // The legs whose touch-down is at 0 are about to swing.
    for (std::size_t leg = 0; leg < legs(); ++leg) {
      const double time = duty_factor - touch_down_of(leg);
      set_clock(leg, time - std::floor(time));
    }
  }

  const FourLegs* named() const {
    const auto* found = std::ranges::find(four_legs, pattern.value(), &FourLegs::name);
    return found == four_legs.end() ? nullptr : found;
  }

  double touch_down_of(std::size_t leg) const {
    if (pattern.value() == "table") return touch_down[leg];
    if (const FourLegs* gait = named()) return gait->touch_down[leg];
    const std::size_t rows = legs() / 2, row = leg % rows, side = leg / rows;
    if (pattern.value() == "alternating") return (row + side) % 2 == 0 ? 0. : 0.5;
    // It lifts off as the leg behind it touches down, and touches down a swing later.
    return static_cast<double>(row) * (1. - duty_factor) + (side == 0 ? 0. : 0.5);
  }
};

HOOKPOINT_REGISTER_COMPONENT(Gait, "Controller.Gait",
                             "joint goals of 2 to 16 legs that walk by a table of phases",
                             Attachment::none, "forward", "goal")

}  // namespace
}  // namespace hookpoint::control
