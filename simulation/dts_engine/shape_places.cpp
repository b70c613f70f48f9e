#include "simulation/dts_engine/shape_places.h"

#include <algorithm>
#include <limits>

namespace hookpoint::simulation {
namespace {

/// Places that come and go within a step, as multiples of those that can touch at once.
constexpr std::size_t places_a_slot = 4;

}  // namespace

ShapePlaces::ShapePlaces(const Experiment& experiment, const contact::Terrain* ground,
                         const WorldInputs& inputs, double reach, double margin)
    : detection_(experiment, ground, reach, {.stays_outside = true}),
      materials_(experiment),
      inputs_(inputs),
      ground_(ground),
      margin_(margin),
      room_(places_a_slot * slots_for(detection_.objects())) {
  places_.reserve(room_);
  names_.reserve(room_);
  sorted_.reserve(room_);
}

void ShapePlaces::begin_step() {
  places_.clear();
  names_.clear();
  sorted_.clear();
}

std::optional<std::size_t> ShapePlaces::number_of(const Name& name) {
  const auto at = std::ranges::lower_bound(sorted_, name, {},
                                           [&](std::size_t number) { return names_[number]; });
  if (at != sorted_.end() && names_[*at] == name) return *at;
  if (places_.size() == room_) return std::nullopt;
  sorted_.insert(at, places_.size());
  names_.push_back(name);
  places_.emplace_back();
  return places_.size() - 1;
}

void ShapePlaces::locate(std::span<const ArticulatedRobot> robots,
                         const contact::GroundQuery& /*ground*/, double elapsed) {
  for (ImpulsePlace& place : places_) place.ground.gap = std::numeric_limits<double>::infinity();
  const auto motion = [&](const ShapeObject& object) -> const dts::BodyMotion<double>& {
    return robots[object.index].workspace().bodies[object.body];
  };
  Name name;
  for (const ShapeContact& contact : detection_.detect(inputs_, motion, elapsed)) {
    name = {contact.key, contact.key == name.key ? name.repeat + 1 : 0};
    if (const auto number = number_of(name)) put(contact, robots, places_[*number]);
  }
}

void ShapePlaces::put(const ShapeContact& contact, std::span<const ArticulatedRobot> robots,
                      ImpulsePlace& place) const {
  place.side_count = 0;
  place.surface = -1;
  place.ground = {-contact.depth - margin_, contact.normal, &constants_of(materials_, contact)};
  place.surface_velocity = belt_velocity(contact, detection_.motions());
  const auto add = [&](std::int64_t number, double sign, const Vector3d& center) {
    const auto index = static_cast<std::size_t>(number);
    const ShapeObject& object = detection_.objects()[index];
    if (object.kind == ShapeObject::Kind::body) {
      const Vector3d& origin = robots[object.index].workspace().bodies[object.body].p_WB;
      place.sides[place.side_count++] = {object.index, object.body, sign, contact.place - origin,
                                         center - origin};
      return;
    }
    place.surface = object.kind == ShapeObject::Kind::terrain
                        ? 0
                        : static_cast<int>(object.index) + (ground_ != nullptr ? 1 : 0);
    place.surface_velocity += sign * detection_.motions()[index].velocity_at(contact.place);
  };
  const std::vector<BallFeature>& balls =
      detection_.objects()[static_cast<std::size_t>(contact.key.a)].balls;
  const double ball =
      contact.is_tracked() ? balls[static_cast<std::size_t>(contact.key.feature)].radius : 0.;
  add(contact.key.a, 1., contact.place + ball * contact.normal);
  add(contact.key.b, -1., contact.place);
}

std::optional<Vector3d> ShapePlaces::beside_ground(const Vector3d& p_W) const {
  if (ground_ == nullptr) return std::nullopt;
  const Vector3d place = detection_.motions()[0].to_object(p_W);
  return ground_->query(place).outside ? std::optional(place) : std::nullopt;
}

double ShapePlaces::longest_flight(double turn, double travel) const {
  double longest = std::numeric_limits<double>::infinity();
  const auto look = [&](const SurfaceMotion& surface) {
    if (surface.velocity != Vector3d{})
      longest = std::min(longest, travel / norm(surface.velocity));
    if (surface.angular_velocity != Vector3d{})
      longest = std::min(longest, turn / norm(surface.angular_velocity));
  };
  if (ground_ != nullptr) look(inputs_.ground);
  for (const SurfaceMotion& obstacle : inputs_.obstacles) look(obstacle);
  return longest;
}

}  // namespace hookpoint::simulation
