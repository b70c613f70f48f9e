#include "dts/configuration.h"

#include <algorithm>

namespace hookpoint::dts {
namespace {

template <class Real>
std::size_t first_joint(const Model<Real>& model) {
  return velocity_count(model) - model.link_count();
}

}  // namespace

template <class Real>
void get_velocity(const Model<Real>& model, const State<Real>& state, std::span<Real> velocity) {
  if (model.mobile()) {
    write_base_velocity(state.base_angular_velocity, state.base_velocity, velocity);
  }
  std::ranges::copy(state.joint_rates, velocity.begin() + first_joint(model));
}

template <class Real>
void set_velocity(const Model<Real>& model, std::span<const std::type_identity_t<Real>> velocity,
                  State<Real>& state) {
  if (model.mobile()) {
    state.base_angular_velocity = {velocity[0], velocity[1], velocity[2]};
    state.base_velocity = {velocity[3], velocity[4], velocity[5]};
  }
  std::ranges::copy(velocity.subspan(first_joint(model)), state.joint_rates.begin());
}

template <class Real>
void get_acceleration(const Model<Real>& model, const Workspace<Real>& workspace,
                      std::span<Real> acceleration) {
  if (model.mobile()) {
    write_base_velocity(workspace.base_angular_acceleration, workspace.base_acceleration,
                        acceleration);
  }
  std::ranges::copy(workspace.joint_accelerations, acceleration.begin() + first_joint(model));
}

template <class Real>
void retract(const Model<Real>& model, const State<Real>& from,
             std::span<const std::type_identity_t<Real>> tangent, const Real& dt, State<Real>& to) {
  if (model.mobile()) {
    const Vector3<Real> w{tangent[0], tangent[1], tangent[2]};
    const Vector3<Real> v{tangent[3], tangent[4], tangent[5]};
    to.base_orientation = normalized(exponential(dt * w) * from.base_orientation);
    to.base_position = from.base_position + dt * v;
  } else {
    to.base_orientation = from.base_orientation;
    to.base_position = from.base_position;
  }
  const std::size_t offset = first_joint(model);
  for (std::size_t l = 0; l < model.link_count(); ++l) {
    to.joint_positions[l] = from.joint_positions[l] + dt * tangent[offset + l];
  }
}

template void get_velocity(const Model<double>&, const State<double>&, std::span<double>);
template void set_velocity(const Model<double>&, std::span<const double>, State<double>&);
template void get_acceleration(const Model<double>&, const Workspace<double>&, std::span<double>);
template void retract(const Model<double>&, const State<double>&, std::span<const double>,
                      const double&, State<double>&);

}  // namespace hookpoint::dts
