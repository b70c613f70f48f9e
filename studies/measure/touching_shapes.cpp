#include "studies/measure/touching_shapes.h"

namespace hookpoint::studies {

using simulation::ShapeObject;

bool TouchingShapes::matter(const RunContext& context) {
  const simulation::Experiment& experiment = *context.experiment;
  if (experiment.touch != "shapes") return false;
  const bool uneven = experiment.terrain && !simulation::is_plane(*experiment.terrain);
  return uneven || !experiment.obstacles.empty();
}

TouchingShapes::TouchingShapes(const RunContext& context)
    : context_(context),
      detection_(*context.experiment, context.ground ? &*context.ground : nullptr, 0., {}) {
  std::size_t bodies = 0;
  for (const simulation::RobotSpec& robot : context.experiment->robots) {
    first_bodies_.push_back(bodies);
    bodies += simulation::body_count(robot);
  }
}

std::span<const TouchingShapes::Place> TouchingShapes::look(const simulation::WorldState& world,
                                                            const simulation::WorldInputs& inputs) {
  const auto body_of = [&](const ShapeObject& object) {
    return first_bodies_[object.index] + object.body;
  };
  const auto motion = [&](const ShapeObject& object) {
    return simulation::motion_of(world.bodies[body_of(object)]);
  };
  const auto is_ours = [&](const ShapeObject& object) {
    return object.kind == ShapeObject::Kind::body &&
           object.index == static_cast<std::size_t>(context_.robot);
  };
  places_.clear();
  for (const simulation::ShapeContact& contact : detection_.detect(inputs, motion)) {
    const auto a = static_cast<std::size_t>(contact.key.a);
    const auto b = static_cast<std::size_t>(contact.key.b);
    const ShapeObject &one = detection_.objects()[a], &other = detection_.objects()[b];
    // Bodies are no ground.
    if (!(contact.depth > 0.) || is_ours(one) == is_ours(other)) continue;
    const bool ours_is_a = is_ours(one);
    const ShapeObject &ours = ours_is_a ? one : other, &theirs = ours_is_a ? other : one;
    if (theirs.kind == ShapeObject::Kind::body) continue;
    Place place;
    place.body = body_of(ours);
    const auto feature = static_cast<std::size_t>(contact.key.feature);  // balls are numbered first
    if (ours_is_a && feature < ours.balls.size()) place.point = ours.balls[feature].boundary_point;
    place.position = contact.place;
    place.normal = ours_is_a ? contact.normal : -contact.normal;
    const simulation::ObjectMotion& beneath = detection_.motions()[ours_is_a ? b : a];
    place.velocity = beneath.velocity_at(contact.place) + tangential(beneath.belt, contact.normal);
    place.depth = contact.depth;
    places_.push_back(place);
  }
  return places_;
}

}  // namespace hookpoint::studies
