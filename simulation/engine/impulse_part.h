// One robot of a world under an impulse law, which owns the advance of its time.
#pragma once

#include <span>
#include <string>

#include "contact/impulse/impulse_resolution.h"
#include "simulation/engine.h"

namespace hookpoint::simulation {

class ImpulsePart {
 public:
  virtual ~ImpulsePart() = default;
  virtual std::size_t body_count() const = 0;
  virtual std::size_t joint_count() const = 0;
  /// Advances the robot by one step, `experiment.deltat`, under the present inputs. On any status
  /// but ok the state is that before.
  virtual contact::ImpulseTally advance(const contact::GroundQuery& ground) = 0;
  /// Takes the last successful step back.
  virtual void undo() = 0;
  /// Writes the published values of this robot's bodies and joints.
  virtual void publish(std::span<BodyState> bodies, std::span<JointState> joints) const = 0;

  /// What evolves (resumable.h). `bodies`: this robot's published values, of whose quaternions the
  /// signs go on.
  virtual std::size_t state_size() const = 0;
  virtual std::string state_layout() const = 0;
  virtual void save(std::span<double> numbers, std::span<const BodyState> bodies) const = 0;
  virtual void restore(std::span<const double> numbers, std::span<BodyState> bodies) = 0;
};

}  // namespace hookpoint::simulation
