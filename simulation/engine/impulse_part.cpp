#include "simulation/engine/impulse_part.h"

#include "contact/force_law.h"
#include "simulation/engine/impulse_body.h"
#include "simulation/engine/impulse_robot.h"

namespace hookpoint::simulation {
namespace {

contact::ImpulseLaw impulse_law(const std::string& name) {
  if (const auto law = contact::find_impulse_law(name)) return *law;
  throw ExperimentError("there is no impulse law `" + name + "`");
}

}  // namespace

StepStatus ImpulsePart::step(double time) {
  std::string left;  // that the robot has left the terrain, in this step
  const auto ground = [&](const Vector3d& point) {
    const contact::TilePoint tile = ground_->query(point);
    if (tile.outside && notice_.empty() && left.empty())
      left = experiment_.robots[index_].name + ": " + ground_->outside_message(point);
    return contact::GroundPoint{-tile.depth, tile.normal,
                                &experiment_.materials[tile.material].constants};
  };
  const contact::ImpulseTally tally = advance(ground);
  if (tally.status != contact::AdvanceStatus::ok) {
    const bool lost = tally.status == contact::AdvanceStatus::not_finite;
    return {lost ? StepStatus::Kind::not_finite : StepStatus::Kind::solver_failed, time,
            experiment_.robots[index_].name + ".base", contact::advice(tally.status)};
  }
  noticed_before_ = !notice_.empty();
  if (!left.empty()) notice_ = left;
  impacts_before_ = impacts_;
  impacts_ += static_cast<std::uint64_t>(tally.impacts);
  return {};
}

void ImpulsePart::undo() {
  impacts_ = impacts_before_;
  if (!noticed_before_) notice_.clear();
  go_back();
}

std::unique_ptr<RobotPart> make_impulse_part(const Experiment& experiment, std::size_t index,
                                             const contact::Terrain* ground,
                                             const WorldInputs& inputs) {
  const contact::ImpulseLaw law = impulse_law(experiment.contact);
  if (experiment.robots[index].chains.empty())
    return std::make_unique<ImpulseBody>(experiment, index, law, ground, inputs);
  return std::make_unique<ImpulseRobot>(experiment, index, law, ground, inputs);
}

}  // namespace hookpoint::simulation
