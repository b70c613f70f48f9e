#include "simulation/dts_engine/impulse_part.h"

#include <algorithm>

#include "contact/force_law.h"
#include "simulation/dts_engine/contact_point.h"
#include "simulation/dts_engine/impulse_body.h"
#include "simulation/dts_engine/impulse_group.h"
#include "simulation/dts_engine/shape_object.h"

namespace hookpoint::simulation {
namespace {

/// A point that lies still is thrown up less high than that [m], beside what its rebound speed
/// gives.
constexpr double most_bounce = 1e-6;

const char* seen_order(contact::OrderCause cause) {
  switch (cause) {
    case contact::OrderCause::none:
      return "";
    case contact::OrderCause::microcollisions:
      return ": points that rest and strike equally fast are hit one after another, so that creep and "
             "drift, of the order of rebound_speed, depend on the order of the points.";
    case contact::OrderCause::different_bodies:
      return ": points of different bodies that act on each other landed at one instant equally "
             "fast: the bodies were hit one after another, so that the result depends on their order.";
    case contact::OrderCause::many_corners:
      return ": more than 64 corners of one face landed at one instant: they were hit one after "
             "another, so that the result depends on their order. Give the face fewer points.";
    case contact::OrderCause::unsolved:
      return ": points of one face that landed at one instant had no common impulse: they were hit one "
             "after another, so that the result depends on their order. Check the inertia.";
  }
  return "";
}
static_assert(contact::most_hit_together == 64);

contact::ImpulseLaw impulse_law(const std::string& name) {
  if (const auto* const law = contact::find_impulse_law(name)) return law->impulse->law;
  throw ExperimentError("there is no impulse law `" + name + "`");
}

}  // namespace

StepStatus ImpulsePart::step(double time) {
  left_.clear();
  const auto ground = [&](const Vector3d& point, int foot_material) -> contact::GroundPoint {
    const ImpulseGround::Place place = ground_.at(point, foot_material);
    if (place.outside) look_for_edge(robots_.first, point);
    return place;
  };
  in_run_ = time > 0.;
  const contact::ImpulseTally tally = advance(ground);
  if (tally.status != contact::AdvanceStatus::ok) {
    const bool lost = tally.status == contact::AdvanceStatus::not_finite;
    const bool inside = tally.status == contact::AdvanceStatus::inside_ground ||
                        tally.status == contact::AdvanceStatus::inside_body;
    const contact::AdvanceStatus status =
        inside && in_run_ ? contact::AdvanceStatus::came_inside : tally.status;
    return {lost ? StepStatus::Kind::not_finite : StepStatus::Kind::solver_failed, time,
            failed_robot() + ".base", contact::advice(status)};
  }
  look_for_order(tally.order_matters);
  noticed_before_ = !notice_.empty();
  if (!left_.empty()) notice_ = left_;
  impacts_before_ = impacts_;
  impacts_ += static_cast<std::uint64_t>(tally.impacts);
  return {};
}

ImpulsePart::ImpulsePart(const Experiment& experiment, RobotRange robots,
                         const contact::Terrain* ground)
    : experiment_(experiment), robots_(robots), ground_(experiment, ground), terrain_(ground) {
  notice_.reserve(longest_notice);
  left_.reserve(longest_notice);
}

void ImpulsePart::look_for_order(contact::OrderCause cause) {
  if (cause == contact::OrderCause::none || !notice_.empty() || !left_.empty()) return;
  left_ = specs().front().name;
  left_ += seen_order(cause);
}

const std::string& ImpulsePart::failed_robot() const { return specs().front().name; }

void ImpulsePart::look_for_edge(std::size_t robot, const Vector3d& place) {
  if (!notice_.empty() || !left_.empty()) return;
  left_ = experiment_.robots[robot].name + ": " + terrain_->outside_message(place);
}

void ImpulsePart::add_contacts(std::size_t first_body, std::span<const BodyState> bodies,
                               std::vector<ContactView>& contacts) const {
  if (!ground_.exists()) return;
  const std::size_t before = contacts.size();
  for (const BoundaryPoint& point : boundary_points(specs().front())) {
    const BodyState& body = bodies[point.body];
    if (body.contacts == 0) continue;
    const Vector3d center = body.position + rotate(body.orientation, point.p_BP);
    const contact::GroundPoint below = ground_.at(center, point.foot_material);
    const Vector3d place = center - point.radius * below.normal;
    const double depth = point.radius - below.gap;
    // Twice u0^2 / 2 g.
    const double u0 = below.material->rebound_speed;
    const double bounce = u0 * u0 / std::max(norm(experiment_.gravity), 1e-3);
    if (depth < -most_bounce - bounce) continue;
    contacts.push_back({first_body + point.body, place, body.contact_force, place, depth, -1.});
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

bool impulses_together(const Experiment& experiment) {
  return contact::find_impulse_law(experiment.contact) != nullptr && shapes_matter(experiment);
}

std::unique_ptr<RobotPart> make_impulse_part(const Experiment& experiment, std::size_t index,
                                             const contact::Terrain* ground,
                                             const WorldInputs& inputs) {
  const contact::ImpulseLaw law = impulse_law(experiment.contact);
  if (impulses_together(experiment))
    return std::make_unique<ImpulseGroup>(experiment, RobotRange{0, experiment.robots.size()}, law,
                                          ground, inputs);
  const RobotSpec& robot = experiment.robots[index];
  if (robot.chains.empty() && !robot.plane_normal)
    return std::make_unique<ImpulseBody>(experiment, index, law, ground, inputs);
  return std::make_unique<ImpulseGroup>(experiment, RobotRange{index, 1}, law, ground, inputs);
}

}  // namespace hookpoint::simulation
