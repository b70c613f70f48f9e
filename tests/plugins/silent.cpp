// A class that is not registered.
#include "control/component.h"

namespace {

class Silent final : public hookpoint::control::Component {
 public:
  void update(const hookpoint::control::Tick&) override {}
};

[[maybe_unused]] const Silent silent;

}  // namespace
