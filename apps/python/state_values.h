// Initial states as Python gives them.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

#include "apps/python/arguments.h"
#include "simulation/run/initial_state.h"

namespace hookpoint::python {

/// A dict {trail: numbers}: of a port one number, of a vector its elements, of an orientation also
/// roll, pitch, yaw. An array with one dimension more has a row (a number) a world.
class StateValues {
 public:
  /// The numbers of the initial state that a trail names (InitialState::find).
  using Find = std::function<std::vector<std::size_t>(const std::string& trail)>;
  /// `state` may be None. Throws hookpoint.Error, and TypeError for what is no dict of text.
  StateValues(const pybind11::object& state, std::size_t worlds, const Find& find);

  bool empty() const { return ports_.empty(); }
  /// What world `world` begins with.
  std::vector<simulation::InitialValue> of(std::size_t world) const;

 private:
  struct Written {
    std::string trail;
    std::vector<std::size_t> numbers;
    std::vector<double> values;  ///< rows
    std::size_t width = 1;       ///< of a row
    bool by_world = false;       ///< a row a world, else one for all
  };
  std::vector<Written> ports_;
};

}  // namespace hookpoint::python
