#include "simulation/engine/impulse_part.h"

#include <algorithm>

#include "contact/force_law.h"
#include "simulation/engine/contact_point.h"
#include "simulation/engine/impulse_body.h"
#include "simulation/engine/impulse_robot.h"

namespace hookpoint::simulation {
namespace {

/// A point that lies still is thrown up less high than that [m], beside what its rebound speed
/// gives.
constexpr double most_bounce = 1e-6;

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

void ImpulsePart::add_contacts(std::size_t first_body, std::span<const BodyState> bodies,
                               std::vector<ContactView>& contacts) const {
  if (ground_ == nullptr) return;
  const std::size_t before = contacts.size();
  for (const BoundaryPoint& point : boundary_points(experiment_.robots[index_])) {
    const BodyState& body = bodies[point.body];
    if (body.contacts == 0) continue;
    const Vector3d center = body.position + rotate(body.orientation, point.p_BP);
    const Vector3d place = center - point.radius * ground_->query(center).normal;
    const contact::TilePoint tile = ground_->query(place);
    // Twice u0^2 / 2 g.
    const double u0 = experiment_.materials[tile.material].constants.rebound_speed;
    const double bounce = u0 * u0 / std::max(norm(experiment_.gravity), 1e-3);
    if (tile.depth < -most_bounce - bounce) continue;
    contacts.push_back(
        {first_body + point.body, place, body.contact_force, place, tile.depth, -1.});
  }
  const auto told = std::span(contacts).subspan(before);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto of_body = [&](const ContactView& contact) { return contact.body == first_body + i; };
    const auto count = std::ranges::count_if(told, of_body);
    for (ContactView& contact : told)
      if (of_body(contact)) contact.force = (1. / static_cast<double>(count)) * contact.force;
  }
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
  const RobotSpec& robot = experiment.robots[index];
  if (robot.chains.empty() && !robot.plane_normal)
    return std::make_unique<ImpulseBody>(experiment, index, law, ground, inputs);
  return std::make_unique<ImpulseRobot>(experiment, index, law, ground, inputs);
}

}  // namespace hookpoint::simulation
