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
  /// Whether some joint's dry friction would exceed tau_f at the end of that step, with these
  /// accelerations: it is tau_f from now on, until unbind_friction().
  bool bind_friction(double h, std::span<const double> positions, std::span<const double> rates,
                     std::span<const double> accelerations);
  void unbind_friction();

  /// The state is accepted: dry friction is hooked where the joints have dragged it. `keep`
  /// remembers where it was, `undo` takes it back there.
  void commit(std::span<const double> positions, std::span<const double> rates);
  void keep() { anchors_before_ = anchors_; }
  void undo() { anchors_ = anchors_before_; }

  /// Events of adaptive integrators: each limit that a joint has, then where each joint with dry
  /// friction begins to slip or, while it slips, reverses.
  std::size_t event_count() const;
  void event_values(std::span<const double> positions, std::span<const double> rates,
                    std::span<double> values) const;
  /// Whether a commit changes anything.
  bool remembers() const { return !dry_joints_.empty(); }

  const std::vector<JointProperties>& properties() const { return properties_; }
  /// Where the dry friction of each joint is hooked.
  const std::vector<double>& anchors() const { return anchors_; }

  template <class Self, class Archive>
  static void exchange(Self& self, Archive& archive) {
    archive.each("friction_anchor", self.dry_joints_,
                 [&self](auto& dry, auto& each) { each("", self.anchors_[dry.joint]); });
  }

 private:
  /// A joint with dry friction.
  struct DryJoint {
    std::size_t joint = 0;
    bool slips = false;  ///< when its anchor was committed
    /// At the end of the step, where its state would say more than tau_f [N m, N].
    std::optional<double> bound{};
  };

  std::vector<JointProperties> properties_;
  std::vector<DryJoint> dry_joints_;
  std::vector<double> anchors_, anchors_before_;
};

}  // namespace hookpoint::simulation
