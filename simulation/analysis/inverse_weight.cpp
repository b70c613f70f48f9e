#include "simulation/analysis/inverse_weight.h"

#include "dts/impulse_response.h"
#include "simulation/dts_engine/robot_system.h"
#include "simulation/experiment/robot_tree.h"

namespace hookpoint::simulation {

double inverse_weight(const Experiment& experiment, std::size_t robot, std::size_t body) {
  Experiment at_zero = experiment;
  for (ChainSpec& chain : at_zero.robots[robot].chains)
    for (LinkSpec& link : chain.links) link.angle = 0.;
  RobotSystem system(at_zero, robot, nullptr, initial_inputs(at_zero));
  dts::articulated_inertias(system.model(), system.workspace());
  const dts::BodyMotion<double>& here = system.workspace().bodies[body];
  const Vector3d center =
      here.p_WB + here.R_WB * bodies_of(at_zero.robots[robot])[body]->mass.center_of_mass;
  const Matrix3d K = dts::collision_matrix(system.model(), system.workspace(), {body, center});
  return (K.xx + K.yy + K.zz) / 3.;
}

}  // namespace hookpoint::simulation
