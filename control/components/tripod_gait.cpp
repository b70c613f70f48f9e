// Two tripods in turn on one clock: while one swings the other carries the body.
#include "control/components/clocked_gait.h"
#include "control/components/hexapod_gait.h"
#include "control/registry.h"

namespace hookpoint::control {
namespace {

class TripodGait final : public ClockedGait {
 public:
  TripodGait() : ClockedGait(leg_count, 0.5) {}

 private:
  void begin() override {
    // The first tripod is about to swing, the other half a period from it.
    for (std::size_t leg = 0; leg < leg_count; ++leg)
      set_clock(leg, in_first_tripod(leg) ? duty_factor : duty_factor - 0.5);
  }
};

HOOKPOINT_REGISTER_COMPONENT(TripodGait, "Controller.TripodGait",
                             "joint goals of a hexapod that walks in alternating tripods",
                             Attachment::none, "forward", "goal")

}  // namespace
}  // namespace hookpoint::control
