// A single rigid body under an impulse law.
#pragma once

#include "contact/impulse/impulse_advance.h"
#include "simulation/dts_engine/impulse_part.h"

namespace hookpoint::simulation {

class ImpulseBody final : public ImpulsePart {
 public:
  /// Robot `index` of the experiment, without chains.
  ImpulseBody(const Experiment& experiment, std::size_t index, contact::ImpulseLaw law,
              const contact::Terrain* ground, const WorldInputs& inputs);

  std::size_t body_count() const override { return 1; }
  std::size_t joint_count() const override { return 0; }
  contact::ImpulseTally advance(const contact::GroundQuery& ground) override;
  void publish(std::span<BodyState> bodies, std::span<JointState> joints) const override;
  void measure_work() override {}
  void publish_works(std::span<double> works) const override;

  std::size_t state_size() const override;
  std::string state_layout() const override;
  void save(std::span<double> numbers, std::span<const BodyState> bodies) const override;
  void restore(std::span<const double> numbers, std::span<BodyState> bodies) override;

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    archive("position", self.motion_.position);
    archive("orientation", self.motion_.orientation);
    archive("velocity", self.motion_.velocity);
    archive("angular_velocity", self.motion_.angular_velocity);
    archive("impulse", self.result_.impulse);
    archive("contacts", self.result_.contacts);
    archive("impacts", self.impacts_);
  }

 private:
  void go_back() override;
  contact::ImpulseLoad load() const;

  const std::size_t index_;
  const WorldInputs& inputs_;
  contact::ImpulseAdvance law_;
  contact::ImpulseState motion_, motion_before_;   ///< before: the present step, to undo it
  contact::AdvanceResult result_, result_before_;  ///< of the last step
};

}  // namespace hookpoint::simulation
