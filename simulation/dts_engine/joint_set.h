// What the joints of a robot exert by themselves, and what their dry friction remembers.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "simulation/experiment/experiment.h"
#include "simulation/experiment/joint_forces.h"

namespace hookpoint::simulation {

/// Joints in the order of the chains. Positions q [rad, m] and rates q' are one a joint.
class JointSet {
 public:
  /// Dry friction begins unstretched, where the joints are at first.
  explicit JointSet(const RobotSpec& robot);

  /// tau = drive, within effort_limit, + what each joint exerts by itself
  /// (simulation/experiment/joint_forces.h) [N m, N].
  void torques(std::span<const double> drive, std::span<const double> positions,
               std::span<const double> rates, std::span<double> torques) const;

  /// The same with what joints exert by themselves as it is at the end of a step of `h` [s], but for
  /// its part that is proportional to their acceleration: that times `inertias` is left [kg m^2, kg].
  void torques_at_end_of(double h, std::span<const double> drive, std::span<const double> positions,
                         std::span<const double> rates, std::span<double> torques,
                         std::span<double> inertias) const;
  /// Whether some joint's dry friction would exceed the most that it gives at the end of that step,
  /// with these accelerations: it is that much from now on, until unbind_friction().
  bool bind_friction(double h, std::span<const double> positions, std::span<const double> rates,
                     std::span<const double> accelerations);
  void unbind_friction();

  /// The state is accepted: dry friction is hooked where the joints have dragged it. `keep`
  /// remembers where it was, `undo` takes it back there.
  void commit(std::span<const double> positions, std::span<const double> rates);
  void keep() { hooks_before_ = hooks_; }
  void undo() { hooks_ = hooks_before_; }

  /// Events of adaptive integrators: each limit that a joint has, then where each joint with dry
  /// friction begins to slip or, while it slips, reverses.
  std::size_t event_count() const;
  void event_values(std::span<const double> positions, std::span<const double> rates,
                    std::span<double> values) const;
  /// Whether a commit changes anything.
  bool remembers() const { return !dry_joints_.empty(); }

  const std::vector<JointProperties>& properties() const { return properties_; }
  /// What the dry friction of each joint remembers.
  const std::vector<FrictionHook>& hooks() const { return hooks_; }

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    archive.each("friction", self.dry_joints_, [&self](auto& dry, auto& each) {
      each("anchor", self.hooks_[dry.joint].anchor);
      each("rate", self.hooks_[dry.joint].rate);
      each("drags", self.hooks_[dry.joint].drags);
      each("slips", self.hooks_[dry.joint].slips);
    });
  }

 private:
  /// A joint with dry friction.
  struct DryJoint {
    std::size_t joint = 0;
    /// At the end of the step, where its state would say more than it gives [N m, N].
    std::optional<double> bound{};
  };

  std::vector<JointProperties> properties_;
  std::vector<DryJoint> dry_joints_;
  std::vector<FrictionHook> hooks_, hooks_before_;
};

}  // namespace hookpoint::simulation
