#include "simulation/dts_engine/publish_contacts.h"

#include "contact/laws/surface_forces.h"

namespace hookpoint::simulation {

void publish_contact_forces(const ContactSet& contacts, double dt, std::span<BodyState> bodies) {
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    bodies[body].contact_force = (1. / dt) * contacts.impulses()[body];
    bodies[body].contacts = 0;
    for (const ContactPoint& point : contacts.near_points_of(body)) {
      if (dot(point.force, point.normal) > 0.) ++bodies[body].contacts;
    }
  }
}

void ContactSum::add(const Vector3d& place, const Vector3d& normal, const Vector3d& force,
                     const Vector3d& moment) {
  const double load = dot(force, normal);
  force_ += force;
  moment_ += cross(place, force) + moment;
  weighted_ += load * place;
  tangential_ += force - load * normal;
  load_ += load;
  if (load > 0.) ++count_;
}

BodyContact ContactSum::about(const Vector3d& origin) const {
  return {moment_ - cross(origin, force_), load_ != 0. ? (1. / load_) * weighted_ : origin, load_,
          norm(tangential_)};
}

void publish_body_contacts(const ContactSet& contacts, const dts::Workspace<double>& workspace,
                           std::span<BodyContact> bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    ContactSum sum;
    for (const ContactPoint& point : contacts.near_points_of(i)) {
      if (point.pending.attached) sum.add(point.position, point.normal, point.force, point.moment);
    }
    bodies[i] = sum.about(workspace.bodies[i].p_WB);
  }
}

void add_ground_contacts(const ContactSet& contacts, ContactSum& ground) {
  for (std::size_t i = 0; i < contacts.body_count(); ++i) {
    for (const ContactPoint& point : contacts.near_points_of(i)) {
      if (point.pending.attached)
        ground.add(point.position, -point.normal, -point.force, -point.moment);
    }
  }
}

PointState point_state(const ContactPoint& point) {
  const contact::Memory<double>& memory = point.pending;
  const double load = dot(point.force, point.normal);
  return {point.position,
          point.force,
          memory.attached ? memory.hook : point.position,
          point.depth,
          memory.sliding ? 1. : 0.,
          load,
          norm(point.force - load * point.normal)};
}

void add_ground_forces(const ContactSet& contacts, const dts::Workspace<double>& workspace,
                       std::size_t first_body, std::vector<GroundForce>& forces) {
  for (std::size_t i = 0; i < contacts.body_count(); ++i) {
    const dts::BodyMotion<double>& body = workspace.bodies[i];
    for (const ContactPoint& point : contacts.near_points_of(i)) {
      if (dot(point.force, point.force) == 0.) continue;
      forces.push_back(
          {first_body + i, transpose_times(body.R_WB, point.position - body.p_WB), point.force});
    }
  }
}

void add_contacts(const ContactSet& contacts, std::size_t first_body,
                  std::vector<ContactView>& views) {
  for (std::size_t i = 0; i < contacts.body_count(); ++i) {
    for (const ContactPoint& point : contacts.near_points_of(i)) {
      if (!(point.depth > 0. || dot(point.force, point.force) > 0.)) continue;
      const PointState shown = point_state(point);
      views.push_back(
          {first_body + i, shown.position, shown.force, shown.hook, shown.depth, shown.sliding});
    }
  }
}

double stored_energy(const ContactSet& contacts, const dts::Workspace<double>& workspace) {
  double sum = 0.;
  for (const ContactPoint& point : contacts.points()) {
    if (!point.pending.attached) continue;
    sum += contact::surface_energy(
        point.depth, point.pending.stretch, {x_axis(workspace.bodies[point.body]), {}, 0.},
        point.normal, contacts.constants(point, point.material), contacts.law()->stored_energy);
  }
  return sum;
}

}  // namespace hookpoint::simulation
