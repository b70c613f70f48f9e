// A gait of any even number of legs from a table: when in the period each leg touches down.
// Wave gaits: McGhee & Frank, "On the stability properties of quadruped creeping gaits",
// Mathematical Biosciences 3 (1968); Song & Waldron, Machines That Walk (1989), chapter 3.
#include <cmath>
#include <stdexcept>

#include "control/components/clocked_gait.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class Gait final : public ClockedGait {
 public:
  static constexpr std::size_t most = 16;

  Parameter leg_number = Parameter{*this, "legs", "", 6., "how many: even, 2 to 16"}.range(
      2., static_cast<double>(most));
  Text pattern =
      Text{*this, "pattern",
           "alternating: neighbours half a period apart; wave: each leg lifts off as the "
           "one behind it touches down, the sides half a period apart; table: `phase`",
           "alternating"}
          .choices({"alternating", "wave", "table"});
  Parameter touch_down =
      Parameter{*this, "touch_down", "", 0., "of `table`: when each leg touches down, in periods",
                most}
          .counted_by("legs")
          .range(0., 1.);

  Gait() : ClockedGait(most, 0.01, "legs") {}

 private:
  std::size_t legs_at_start() const override {
    if (std::fmod(leg_number, 2.) != 0.) throw std::runtime_error("legs is no even number");
    return static_cast<std::size_t>(leg_number);
  }

  void begin() override {
    // The legs whose touch-down is at 0 are about to swing.
    for (std::size_t leg = 0; leg < legs(); ++leg) {
      const double time = duty_factor - touch_down_of(leg);
      set_clock(leg, time - std::floor(time));
    }
  }

  double touch_down_of(std::size_t leg) const {
    if (pattern.value() == "table") return touch_down[leg];
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
