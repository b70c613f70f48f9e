#include "reference/bullet/points.h"

#include <algorithm>

#include "reference/experiment_checks.h"

namespace hookpoint::reference {
namespace {

/// Bullet has a contact before there is one, and its solver then lets the gap close but not more.
/// The distance is what the library gives to a ball of 10 mm, a foot: 0.02 of its radius [m].
constexpr double contact_breaking = 2e-4;

}  // namespace

void set_bullet_material(btManifoldPoint& contact,
                         const contact::MaterialConstants<double>& material,
                         const BulletSettings& settings) {
  contact.m_combinedFriction = single_friction(material);
  contact.m_combinedRestitution = settings.restitution ? material.restitution : 0.;
  if (!settings.contact_stiffness) return;
  contact.m_contactPointFlags |= BT_CONTACT_FLAG_CONTACT_STIFFNESS_DAMPING;
  contact.m_combinedContactStiffness1 = material.normal_stiffness;
  contact.m_combinedContactDamping1 = material.normal_damping;
}

BulletPoints::BulletPoints(const simulation::Experiment& experiment, const RobotTree& tree,
                           const BulletSettings& settings, btDispatcher& dispatcher,
                           const btRigidBody& ground)
    : settings_(settings),
      materials_(experiment),
      terrain_(*experiment.terrain),
      points_(touching_points(experiment, tree)),
      dispatcher_(dispatcher),
      ground_(ground) {}

BulletPoints::~BulletPoints() {
  for (btPersistentManifold* manifold : manifolds_) dispatcher_.releaseManifold(manifold);
}

void BulletPoints::attach(const std::vector<const btCollisionObject*>& objects) {
  for (const TouchingPoint& point : points_) {
    manifolds_.push_back(dispatcher_.getNewManifold(objects[point.body], &ground_));
    manifolds_.back()->setContactBreakingThreshold(contact_breaking);
  }
}

void BulletPoints::collide(std::span<const simulation::BodyState> bodies) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    btPersistentManifold& manifold = *manifolds_[i];
    const Meeting meeting = meet(terrain_, points_[i], bodies[points_[i].body]);
    if (!(meeting.depth > -contact_breaking)) {
      manifold.clearManifold();
      continue;
    }
    const btVector3 position = bullet(meeting.position), normal = bullet(meeting.normal);
    btManifoldPoint contact({}, {}, normal, -meeting.depth);
    contact.m_positionWorldOnA = position;
    contact.m_positionWorldOnB = position + meeting.depth * normal;
    set_bullet_material(contact, materials_.of(points_[i].material, meeting.material), settings_);
    // An anchor under a ball that rolls is a drag line; a point does not roll.
    if (settings_.friction_anchor && points_[i].radius == 0.)
      contact.m_contactPointFlags |= BT_CONTACT_FLAG_FRICTION_ANCHOR;
    if (manifold.getNumContacts() == 0) {
      manifold.addManifoldPoint(contact);
      continue;
    }
    // Keeps the impulses to start from and, of an anchored contact that sticks, the whole contact.
    manifold.replaceContactPoint(contact, 0);
    manifold.getContactPoint(0).m_positionWorldOnA = position;
    manifold.getContactPoint(0).m_distance1 = -meeting.depth;
  }
}

Vector3d BulletPoints::force(std::size_t point, double deltat) const {
  const btPersistentManifold& manifold = *manifolds_[point];
  if (manifold.getNumContacts() == 0) return {};
  return (1. / deltat) * vector(bullet_impulse(manifold.getContactPoint(0)));
}

void BulletPoints::read(double deltat, std::span<simulation::BodyState> bodies) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vector3d pushed = force(i, deltat);
    simulation::BodyState& body = bodies[points_[i].body];
    body.contact_force += pushed;
    if (manifolds_[i]->getNumContacts() > 0 &&
        manifolds_[i]->getContactPoint(0).m_appliedImpulse > 0.)
      ++body.contacts;
  }
}

bool BulletPoints::has(const btPersistentManifold& manifold) const {
  return std::ranges::find(manifolds_, &manifold) != manifolds_.end();
}

void BulletPoints::read_forces(double deltat, std::span<Vector3d> forces) const {
  for (std::size_t i = 0; i < points_.size(); ++i) forces[i] = force(i, deltat);
}

}  // namespace hookpoint::reference
