// What is published of a robot's contacts after a step: copies of its boundary points as the law
// left them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "simulation/dts_engine/contact_set.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::simulation {

/// Mean force over the last step, of `dt` [s], and number of carrying points of each body.
void publish_contact_forces(const ContactSet& contacts, double dt, std::span<BodyState> bodies);

/// Sums the contacts of a body, a boundary point or a surface.
class ContactSum {
 public:
  /// A contact at `place` that pushes it by `force` and turns it by `moment`; `normal` points to it.
  void add(const Vector3d& place, const Vector3d& normal, const Vector3d& force,
           const Vector3d& moment);
  /// About a place of it, the origin of its frame.
  BodyContact about(const Vector3d& origin) const;
  const Vector3d& force() const { return force_; }
  /// Contacts that press.
  int count() const { return count_; }

 private:
  Vector3d force_, moment_, weighted_, tangential_;  ///< moment about the world's origin
  double load_ = 0.;
  int count_ = 0;
};

/// What the contacts of each body come to.
void publish_body_contacts(const ContactSet& contacts, const dts::Workspace<double>& workspace,
                           std::span<BodyContact> bodies);

/// Adds what the contacts do to the ground.
void add_ground_contacts(const ContactSet& contacts, ContactSum& ground);

/// One boundary point.
PointState point_state(const ContactPoint& point);

/// Adds the forces at the boundary points; the robot's first body is `first_body`.
void add_ground_forces(const ContactSet& contacts, const dts::Workspace<double>& workspace,
                       std::size_t first_body, std::vector<GroundForce>& forces);

/// Adds the boundary points that touch; the robot's first body is `first_body`.
void add_contacts(const ContactSet& contacts, std::size_t first_body,
                  std::vector<ContactView>& views);

/// What the springs of the contacts hold at the evaluated state [J].
double stored_energy(const ContactSet& contacts, const dts::Workspace<double>& workspace);

}  // namespace hookpoint::simulation
