// The components of an experiment, made and given their values.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/component.h"
#include "simulation/experiment/experiment.h"

namespace hookpoint::simulation {

/// A value of a component.
struct ComponentValue {
  std::size_t component = 0;  ///< index
  std::size_t index = 0;      ///< among its values
  bool computed = false;      ///< by its update: an output or a state, not an input or a parameter
};

/// What kept a component from starting, for the user.
struct StartProblem {
  std::size_t component = 0;
  std::string message;
};

class Components {
 public:
  /// Makes `experiment.components` with the values that their specs give, and says which inputs
  /// wires drive. Throws ExperimentError for a class that the registry does not hold.
  explicit Components(const Experiment& experiment);

  /// Gives each its own random stream, and starts all. Those that fail are returned.
  std::vector<StartProblem> start(const Experiment& experiment);

  std::size_t size() const { return components_.size(); }
  control::Component& operator[](std::size_t i) { return *components_[i]; }
  const control::Component& operator[](std::size_t i) const { return *components_[i]; }
  double& value(const ComponentValue& at) { return components_[at.component]->values()[at.index]; }
  /// The value that "pd1.goal", "gait.goal[3]" or "imu.gyroscope.x" names; none if it is not one of
  /// a component. O(log components).
  std::optional<ComponentValue> find(std::string_view trail) const;

 private:
  std::vector<std::unique_ptr<control::Component>> components_;
  std::map<std::string, std::size_t, std::less<>> by_trail_;
};

/// What follows the port's name in the trail of element `index`: "", ".y" (of two or three), "[7]".
std::string element_suffix(const control::PortDescription& port, std::size_t index);

}  // namespace hookpoint::simulation
