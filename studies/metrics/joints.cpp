// The metric of the joints: whether an engine keeps them together.
#include <algorithm>
#include <array>
#include <span>

#include "simulation/experiment/kinematics.h"
#include "studies/measure/metric.h"
#include "studies/metrics/table.h"

namespace hookpoint::studies {
namespace {

using simulation::Pose;

/// How far the links are from where their joints let them be. In reduced coordinates rounding; an
/// engine whose bodies are free but for constraints lets joints open.
class JointGap : public Metric {
 public:
  explicit JointGap(const RunContext& context) : context_(context) {
    simulation::for_each_link(context.robot_spec(), [&](const simulation::TreeLink& at) {
      joints_.push_back({simulation::frame_before(at) * simulation::joint_pose(at.link), at.parent,
                         !simulation::joint_type(at.link.joint).turns});
    });
  }
  void observe(const Observation& observation) override {
    if (!settled(context_, observation)) return;
    const simulation::BodyState* bodies = &observation.world.bodies[context_.body];
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const simulation::BodyState& parent = bodies[joints_[i].parent];
      gap_ = std::max(gap_, gap(joints_[i], parent, bodies[i + 1]));
    }
  }
  std::optional<double> value() const override {
    return joints_.empty() ? std::nullopt : std::optional(gap_);
  }

 private:
  struct Joint {
    Pose X_PL;  ///< at the initial angle; a joint that turns leaves its origin where it is
    std::size_t parent = 0;
    bool slides = false;
  };
  static double gap(const Joint& joint, const simulation::BodyState& parent,
                    const simulation::BodyState& link) {
    const Pose X_WL = Pose{parent.position, parent.orientation} * joint.X_PL;
    const Vector3d apart = link.position - X_WL.position;
    if (!joint.slides) return norm(apart);
    return norm(tangential(apart, rotate(X_WL.orientation, Vector3d{0., 0., 1.})));
  }

  const RunContext& context_;
  std::vector<Joint> joints_;
  double gap_ = 0.;
};

std::unique_ptr<Metric> make_joint_gap(const RunContext& context) {
  return std::make_unique<JointGap>(context);
}

}  // namespace

std::span<const MetricDefinition> joints_metrics() {
  static const auto rows = std::to_array<MetricDefinition>({
      {.name = "joint_gap",
       .unit = "m",
       .doc = "greatest distance after `settle` of a link from where its joint lets it be",
       .make = make_joint_gap},
  });
  return rows;
}

}  // namespace hookpoint::studies
