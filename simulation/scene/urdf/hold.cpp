// Springs and dampers by which a robot holds its pose. The joint whose outer bodies reach l [m]
// carries at most the weight M g at their end, a moment M g l. With
//   k = M g l/sag     c = 2 sqrt(k I)
// it gives way by no more than `sag` at rest, and its outer bodies, of moment of inertia I about
// its axis with the rotor's, come to rest without overshoot while they swing free.
#include <algorithm>
#include <cmath>

#include "dts/mass_properties.h"
#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {
namespace {

constexpr double standard_gravity = 9.80665;  // [m/s^2]

double total_mass(const UrdfTree& tree) {
  double mass = tree.base.mass.mass;
  for (const std::vector<UrdfBody>& chain : tree.chains) {
    for (const UrdfBody& body : chain) mass += body.mass.mass;
  }
  return mass;
}

}  // namespace

UrdfHold hold_joint(const UrdfTree& tree, std::size_t chain, std::size_t link, bool mobile,
                    double sag) {
  const std::vector<UrdfBody>& bodies = tree.chains[chain];
  double reach = 0., carried = 0., inertia = 0.;
  Pose X_JB;  // of an outer body in the joint's frame, all joints between them at 0
  for (std::size_t i = link; i < bodies.size(); ++i) {
    const UrdfBody& body = bodies[i];
    if (i > link) X_JB = X_JB * body.joint_pose;
    const MassSpec& mass = body.mass;
    const dts::MassProperties<double> in_joint = dts::placed(
        {mass.mass, mass.center_of_mass, mass.inertia}, X_JB.position, X_JB.orientation);
    const Vector3d& c = in_joint.center_of_mass;
    carried += mass.mass;
    inertia += in_joint.inertia.zz + mass.mass * (c.x * c.x + c.y * c.y);
    reach = std::max({reach, norm(c), norm(X_JB.position)});
    for (const ShapeSpec& shape : body.shapes)
      reach = std::max(reach, norm((X_JB * Pose{shape.location, shape.orientation}).position));
    for (const Vector3d& point : body.points)
      reach = std::max(reach, norm((X_JB * Pose{point, {}}).position));
  }
  const UrdfJoint& joint = *bodies[link].joint;
  const bool slides = joint.type == UrdfJointType::prismatic;
  const double moved = (slides ? carried : inertia) + joint.rotor_inertia;
  const double weight = standard_gravity * (mobile ? total_mass(tree) : carried);
  // A joint that slides gives way by as much as the end of one that turns.
  const double stiffness = slides ? weight / (sag * reach) : weight * reach / sag;
  return {stiffness, 2. * std::sqrt(stiffness * moved)};
}

}  // namespace hookpoint::simulation
