// One thread at a time steps a world.
#pragma once

#include <atomic>

#include "apps/python/errors.h"

namespace hookpoint::python {

/// Marks an object as being stepped while it lives. Needs the GIL.
class Busy {
 public:
  /// Throws hookpoint.Error where another thread steps it.
  explicit Busy(std::atomic<bool>& busy) : busy_(busy) {
    require_idle(busy);
    busy_ = true;
  }
  ~Busy() { busy_ = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

  static void require_idle(const std::atomic<bool>& busy) {
    if (busy) throw_error("it is being stepped: wait until that has ended");
  }

 private:
  std::atomic<bool>& busy_;
};

}  // namespace hookpoint::python
