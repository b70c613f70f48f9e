#include <ode/ode.h>

#include "tests/support/native_contacts/native_contact.h"

namespace hookpoint::native {
namespace {

class OdeContact final : public Contact {
 public:
  OdeContact(const Ball& ball, const dSurfaceParameters& surface) : ball_(ball), surface_(surface) {
    static const int once = dInitODE2(0);
    (void)once;
    world_ = dWorldCreate();
    joints_ = dJointGroupCreate(0);
    body_ = dBodyCreate(world_);
    dMass mass;
    dMassSetParameters(&mass, ball.mass, 0, 0, 0, great_inertia, great_inertia, great_inertia, 0, 0,
                       0);
    dBodySetMass(body_, &mass);
    sphere_ = dCreateSphere(nullptr, ball.radius);
    dGeomSetBody(sphere_, body_);
    plane_ = dCreatePlane(nullptr, 0, 0, 1, 0);
  }
  ~OdeContact() override {
    dGeomDestroy(sphere_);
    dGeomDestroy(plane_);
    dJointGroupDestroy(joints_);
    dWorldDestroy(world_);
  }
  OdeContact(const OdeContact&) = delete;
  OdeContact& operator=(const OdeContact&) = delete;

  void start(double depth, double approach, std::array<double, 3> gravity) override {
    dWorldSetGravity(world_, gravity[0], gravity[1], gravity[2]);
    dBodySetPosition(body_, 0, 0, ball_.radius - depth);
    dBodySetLinearVel(body_, 0, 0, -approach);
    dBodySetAngularVel(body_, 0, 0, 0);
  }
  void step() override {
    dContact contact;
    contact.surface = surface_;
    if (dCollide(sphere_, plane_, 1, &contact.geom, sizeof(dContactGeom)) > 0)
      dJointAttach(dJointCreateContact(world_, joints_, &contact), body_, nullptr);
    dWorldStep(world_, ball_.deltat);
    dJointGroupEmpty(joints_);
  }
  std::array<double, 3> position() const override {
    const dReal* p = dBodyGetPosition(body_);
    return {p[0], p[1], p[2]};
  }
  std::array<double, 3> velocity() const override {
    const dReal* v = dBodyGetLinearVel(body_);
    return {v[0], v[1], v[2]};
  }

 private:
  Ball ball_;
  dSurfaceParameters surface_;
  dWorldID world_;
  dJointGroupID joints_;
  dBodyID body_;
  dGeomID sphere_, plane_;
};

}  // namespace

std::unique_ptr<Contact> ode_contact(const Ball& ball, double mu, double soft_erp, double soft_cfm,
                                     double slip) {
  dSurfaceParameters surface{};
  surface.mode =
      dContactApprox1 | dContactSoftERP | dContactSoftCFM | dContactSlip1 | dContactSlip2;
  surface.mu = mu;
  surface.soft_erp = soft_erp;
  surface.soft_cfm = soft_cfm;
  surface.slip1 = surface.slip2 = slip;
  return std::make_unique<OdeContact>(ball, surface);
}

}  // namespace hookpoint::native
