#include "reference/dart/contact.h"

#include <algorithm>
#include <condition_variable>
#include <dart/collision/CollisionObject.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/constraint/DantzigBoxedLcpSolver.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <mutex>
#include <utility>

namespace hookpoint::reference {
namespace {

std::mutex constants_mutex;
std::condition_variable constants_turned;
int constants_users = 0;

/// A solver of DART's behind rows with a mixing of their own, as ODE has them: DART's is a part of
/// each row's own diagonal, the same for normal and friction rows. The rows are impulses, so a
/// mixing in m/(N s) enters divided by the step. All rows are contacts': joints have no
/// constraints.
class MixedRows final : public dart::constraint::BoxedLcpSolver {
 public:
  MixedRows(dart::constraint::BoxedLcpSolverPtr solver, const ConstraintConstants& constants,
            double deltat)
      : solver_(std::move(solver)),
        normal_(constants.normal_mixing / deltat),
        tangential_(constants.tangential_mixing / deltat) {}

  const std::string& getType() const override { return solver_->getType(); }
  bool solve(int n, double* A, double* x, double* b, int nub, double* lo, double* hi, int* findex,
             bool earlyTermination) override {
    const int stride = n > 1 ? (n + 3) / 4 * 4 : n;  // dPAD of odelcpsolver/common.h
    for (int i = 0; i < n; ++i) A[i * stride + i] += findex[i] < 0 ? normal_ : tangential_;
    return solver_->solve(n, A, x, b, nub, lo, hi, findex, earlyTermination);
  }
  bool canSolve(int n, const double* A) override { return solver_->canSolve(n, A); }

 private:
  dart::constraint::BoxedLcpSolverPtr solver_;
  double normal_, tangential_;
};

}  // namespace

DartConstantsTurn::DartConstantsTurn(const DartSettings& settings) {
  using Contact = dart::constraint::ContactConstraint;
  const auto is_set = [&settings] {
    return Contact::getErrorAllowance() == settings.constraint.surface_layer &&
           Contact::getErrorReductionParameter() == settings.constraint.normal_error_reduction &&
           Contact::getMaxErrorReductionVelocity() == settings.correction_speed &&
           Contact::getConstraintForceMixing() == settings.constraint.relative_mixing;
  };
  std::unique_lock lock(constants_mutex);
  constants_turned.wait(lock, [&is_set] { return constants_users == 0 || is_set(); });
  if (constants_users++ > 0) return;
  Contact::setErrorAllowance(settings.constraint.surface_layer);
  Contact::setErrorReductionParameter(settings.constraint.normal_error_reduction);
  Contact::setMaxErrorReductionVelocity(settings.correction_speed);
  Contact::setConstraintForceMixing(settings.constraint.relative_mixing);
}

DartConstantsTurn::~DartConstantsTurn() {
  const std::lock_guard lock(constants_mutex);
  if (--constants_users == 0) constants_turned.notify_all();
}

dart::constraint::UniqueConstraintSolverPtr make_dart_solver(const DartSettings& settings,
                                                             double deltat) {
  using namespace dart::constraint;
  BoxedLcpSolverPtr first = std::make_shared<DantzigBoxedLcpSolver>();
  BoxedLcpSolverPtr second = std::make_shared<PgsBoxedLcpSolver>();
  if (settings.own_mixing) {
    first = std::make_shared<MixedRows>(first, settings.constraint, deltat);
    second = std::make_shared<MixedRows>(second, settings.constraint, deltat);
  }
  return std::make_unique<BoxedLcpConstraintSolver>(first, second);
}

simulation::BodyState pose_of(const Eigen::Isometry3d& X_WB) {
  const Eigen::Quaterniond q(X_WB.linear());
  simulation::BodyState state;
  state.position = vector(X_WB.translation());
  state.orientation = {q.w(), q.x(), q.y(), q.z()};
  return state;
}

bool DartShapesFilter::ignoresCollision(const dart::collision::CollisionObject* a,
                                        const dart::collision::CollisionObject* b) const {
  return !(meets(a->getShapeFrame(), b->getShapeFrame()) ||
           meets(b->getShapeFrame(), a->getShapeFrame()));
}

bool DartShapesFilter::meets(const dart::dynamics::ShapeFrame* shape,
                             const dart::dynamics::ShapeFrame* other) const {
  const auto among = [](const auto& frames, const auto* frame) {
    return std::ranges::find(frames, frame) != frames.end();
  };
  if (among(shapes, shape)) return other == ground || among(solids, other);
  return among(balls, shape) && among(solids, other);
}

dart::collision::CollisionObject* DartGroundDetector::object_of(const DartStanding& standing,
                                                                int foot, int material) {
  return claimCollisionObject(standing.surfaces.at({foot, material})).get();
}

void DartGroundDetector::name_surface(dart::collision::Contact& contact) {
  const auto foot = [&](const dart::collision::CollisionObject* object) {
    return foot_materials.find(object->getShapeFrame());
  };
  const bool robot_is_first = foot(contact.collisionObject1) != foot_materials.end();
  const int material =
      foot(robot_is_first ? contact.collisionObject1 : contact.collisionObject2)->second;
  auto*& other = robot_is_first ? contact.collisionObject2 : contact.collisionObject1;
  const auto at = std::ranges::find_if(
      standing, [&](const DartStanding& one) { return one.shape == other->getShapeFrame(); });
  other = object_of(*at, material,
                    at->material ? *at->material : terrain->query(vector(contact.point)).material);
}

bool DartGroundDetector::collide(dart::collision::CollisionGroup* group,
                                 const dart::collision::CollisionOption& option,
                                 dart::collision::CollisionResult* result) {
  // A corner laid on the plane is a rounding error off it.
  constexpr double rounding = 1e-9;
  FCLCollisionDetector::collide(group, option, result);
  shape_contacts = result->getNumContacts();
  for (std::size_t i = 0; i < result->getNumContacts(); ++i) name_surface(result->getContact(i));
  for (const DartBall& ball : balls) {
    const Eigen::Isometry3d& X_WB = ball.node->getBodyNodePtr()->getWorldTransform();
    const Meeting meeting = meet(*terrain, ball.place, pose_of(X_WB));
    if (!(meeting.depth >= -rounding)) continue;
    dart::collision::Contact contact;
    contact.collisionObject1 = claimCollisionObject(ball.node).get();
    contact.collisionObject2 = object_of(standing.front(), ball.place.material, meeting.material);
    contact.point = eigen(meeting.position);
    contact.normal = eigen(meeting.normal);
    contact.penetrationDepth = meeting.depth;
    result->addContact(contact);
  }
  return result->isCollision();
}

}  // namespace hookpoint::reference
