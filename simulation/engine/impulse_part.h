// A robot under an impulse law: no forces of the ground and no integrator, but flight from impact
// to impact (docs/contact_impulse.md). What single bodies and robots with chains have in common.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contact/impulse/impulse_resolution.h"
#include "contact/terrain/terrain.h"
#include "simulation/engine/robot_part.h"

namespace hookpoint::simulation {

class ImpulsePart : public RobotPart {
 public:
  StepStatus step(double time) final;
  void undo() final;
  std::uint64_t impacts() const final { return impacts_; }
  const std::string& notice() const final { return notice_; }
  void forget_notice() final { notice_.clear(); }
  void add_contacts(std::size_t first_body, std::span<const BodyState> bodies,
                    std::vector<ContactView>& contacts) const final;

  /// Advances the robot by one step under the present inputs, above `ground`. On any status but ok
  /// the state is that before.
  virtual contact::ImpulseTally advance(const contact::GroundQuery& ground) = 0;

 protected:
  /// `ground` may be null: no boundary points. All that is referred to outlives the part.
  ImpulsePart(const Experiment& experiment, std::size_t index, const contact::Terrain* ground)
      : experiment_(experiment), index_(index), ground_(ground) {}

  /// Takes the motion of the last successful step back.
  virtual void go_back() = 0;

  const Experiment& experiment_;
  const std::size_t index_;
  const contact::Terrain* const ground_;
  std::uint64_t impacts_ = 0;  ///< archived by the part

 private:
  std::uint64_t impacts_before_ = 0;  ///< the present step, to undo it
  bool noticed_before_ = false;       ///< likewise
  std::string notice_;
};

/// Robot `index` of the experiment under its impulse law: a single body, or a robot with chains.
/// Throws ExperimentError when there is no such law.
std::unique_ptr<RobotPart> make_impulse_part(const Experiment& experiment, std::size_t index,
                                             const contact::Terrain* ground,
                                             const WorldInputs& inputs);

}  // namespace hookpoint::simulation
