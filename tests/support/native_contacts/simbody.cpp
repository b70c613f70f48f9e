#include <Simbody.h>

#include "tests/support/native_contacts/native_contact.h"

namespace hookpoint::native {
namespace {

using namespace SimTK;

class SimbodyContact final : public Contact {
 public:
  SimbodyContact(const Ball& ball, const ContactMaterial& material, double transition_velocity)
      : ball_(ball),
        matter_(system_),
        forces_(system_),
        gravity_(forces_, matter_, Vec3(0)),
        tracker_(system_),
        contacts_(system_, tracker_) {
    contacts_.setTransitionVelocity(transition_velocity);
    // A half-space is x > 0 of its own frame.
    matter_.Ground().updBody().addContactSurface(
        Rotation(Pi / 2, YAxis), ContactSurface(ContactGeometry::HalfSpace(), material));
    Body::Rigid body(MassProperties(ball.mass, Vec3(0), Inertia(great_inertia)));
    body.addContactSurface(Vec3(0), ContactSurface(ContactGeometry::Sphere(ball.radius), material));
    body_ = MobilizedBody::Free(matter_.Ground(), Vec3(0), body, Vec3(0));
    system_.realizeTopology();
    integrator_.reset(new RungeKuttaMersonIntegrator(system_));
    integrator_->setAccuracy(1e-8);
  }

  void start(double depth, double approach, std::array<double, 3> gravity) override {
    State state = system_.getDefaultState();
    gravity_.setGravityVector(state, Vec3(gravity[0], gravity[1], gravity[2]));
    body_.setQToFitTranslation(state, Vec3(0, 0, ball_.radius - depth));
    body_.setUToFitLinearVelocity(state, Vec3(0, 0, -approach));
    integrator_->initialize(state);
  }
  void step() override { integrator_->stepTo(integrator_->getTime() + ball_.deltat); }
  std::array<double, 3> position() const override {
    const Vec3 p = body_.getBodyOriginLocation(state());
    return {p[0], p[1], p[2]};
  }
  std::array<double, 3> velocity() const override {
    const Vec3 v = body_.getBodyOriginVelocity(state());
    return {v[0], v[1], v[2]};
  }

 private:
  const State& state() const {
    const State& now = integrator_->getState();
    system_.realize(now, Stage::Velocity);
    return now;
  }

  Ball ball_;
  MultibodySystem system_;
  SimbodyMatterSubsystem matter_;
  GeneralForceSubsystem forces_;
  Force::Gravity gravity_;
  ContactTrackerSubsystem tracker_;
  CompliantContactSubsystem contacts_;
  MobilizedBody::Free body_;
  std::unique_ptr<Integrator> integrator_;
};

}  // namespace

std::unique_ptr<Contact> simbody_contact(const Ball& ball, double stiffness, double dissipation,
                                         double us, double ud, double transition_velocity) {
  return std::make_unique<SimbodyContact>(ball, ContactMaterial(stiffness, dissipation, us, ud, 0),
                                          transition_velocity);
}

}  // namespace hookpoint::native
