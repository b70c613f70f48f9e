// A single rigid body under an impulse law.
#pragma once

#include "contact/impulse/impulse_advance.h"
#include "simulation/engine/impulse_part.h"

namespace hookpoint::simulation {

class ImpulseBody final : public ImpulsePart {
 public:
  /// Robot `index` of the experiment, without chains; all that is referred to outlives the body.
  /// Without a ground it has no boundary points.
  ImpulseBody(const Experiment& experiment, std::size_t index, contact::ImpulseLaw law,
              bool has_ground, const WorldInputs& inputs);

  std::size_t body_count() const override { return 1; }
  std::size_t joint_count() const override { return 0; }
  contact::ImpulseTally advance(const contact::GroundQuery& ground) override;
  void undo() override;
  void publish(std::span<BodyState> bodies, std::span<JointState> joints) const override;

  std::size_t state_size() const override;
  std::string state_layout() const override;
  void save(std::span<double> numbers, std::span<const BodyState> bodies) const override;
  void restore(std::span<const double> numbers, std::span<BodyState> bodies) override;

 private:
  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive);
  contact::ImpulseLoad load() const;

  const Experiment& experiment_;
  const std::size_t index_;
  const WorldInputs& inputs_;
  contact::ImpulseAdvance law_;
  contact::ImpulseState motion_, motion_before_;   ///< before: the present step, to undo it
  contact::AdvanceResult result_, result_before_;  ///< of the last step
};

}  // namespace hookpoint::simulation
