#include "dts/bias_forces.h"

#include "dts/configuration.h"
#include "dts/external_forces.h"
#include "dts/inverse_dynamics.h"

namespace hookpoint::dts {

std::vector<double> bias_forces(const Model<double>& model, const Vector3d& gravity_W,
                                Workspace<double>& workspace) {
  clear_external_forces(workspace);
  std::vector<double> h(velocity_count(model));
  const std::vector<double> still(model.link_count());
  const std::span<double> joints = std::span(h).last(model.link_count());
  const auto [moment, force] =
      inverse_dynamics(model, gravity_W, {{}, {}, still}, joints, workspace);
  if (model.mobile()) write_base_velocity(moment, force, std::span(h));
  return h;
}

}  // namespace hookpoint::dts
