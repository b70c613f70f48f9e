// The box that stands for a body of which only the mass is known.
#include <algorithm>
#include <cmath>

#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {
namespace {

/// Half the edge along an axis of a uniform box with the second moment J = int x^2 dm is sqrt(3
/// J/m); the J are I's, tr(I)/2 - I_ii.
ShapeSpec inertia_box(const MassSpec& body) {
  const Symmetric3d& I = body.inertia;
  const double half_trace = 0.5 * (I.xx + I.yy + I.zz);
  constexpr double thinnest = 1e-6;  // [m], of a plate
  const auto edge = [&](double moment) {
    const double squared = 3. * (half_trace - moment) / body.mass;
    return std::max(thinnest, 2. * std::sqrt(std::max(0., squared)));
  };
  return {Box{{edge(I.xx), edge(I.yy), edge(I.zz)}}, body.center_of_mass, {}};
}

void take_inertia_box(UrdfBody& body) {
  body.shapes.clear();
  body.points.clear();
  const auto& [mass, center, I] = body.mass;
  if (!(mass > 0.) || !(I.xx + I.yy + I.zz > 0.)) return;
  body.shapes.push_back({inertia_box(body.mass), body.inertial_place, true, ""});
}

void take_inertia_boxes(UrdfChain& chain) {
  for (UrdfBody& body : chain.bodies) take_inertia_box(body);
  for (UrdfChain& carried : chain.carried) take_inertia_boxes(carried);
}

}  // namespace

void take_inertia_boxes(UrdfTree& tree) {
  take_inertia_box(tree.base);
  for (UrdfChain& chain : tree.chains) take_inertia_boxes(chain);
}

}  // namespace hookpoint::simulation
