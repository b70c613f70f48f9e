#include "dts/jacobian.h"

#include "dts/configuration.h"

namespace hookpoint::dts {
namespace {

/// Column `column` of rows `row`, `row + 1`, `row + 2`.
void set_column(std::vector<double>& J, std::size_t columns, std::size_t row, std::size_t column,
                const Vector3d& v) {
  J[row * columns + column] = v.x;
  J[(row + 1) * columns + column] = v.y;
  J[(row + 2) * columns + column] = v.z;
}

Vector3d unit(std::size_t axis) {
  return {axis == 0 ? 1. : 0., axis == 1 ? 1. : 0., axis == 2 ? 1. : 0.};
}

}  // namespace

std::vector<double> body_jacobian(const Model<double>& model, const CompositeBodies& composite,
                                  const Vector3d& O, std::size_t body, const Vector3d& point) {
  const std::size_t n = velocity_count(model);
  const std::size_t first = model.mobile() ? 6 : 0;
  const Vector3d r = point - O;
  std::vector<double> J(6 * n);
  const auto add = [&](std::size_t column, const Motion<double>& S) {
    set_column(J, n, 0, column, S.angular);
    set_column(J, n, 3, column, S.linear + cross(S.angular, r));
  };
  for (std::size_t k = 0; k < first; ++k)
    add(k, k < 3 ? Motion<double>{unit(k), {}} : Motion<double>{{}, unit(k - 3)});
  for (; body > 0; body = model.carrier_of(body))
    add(first + body - 1, composite.freedoms[body - 1]);
  return J;
}

CenterOfMass center_of_mass(const Model<double>& model, const CompositeBodies& composite,
                            const Vector3d& O) {
  const std::size_t n = velocity_count(model);
  const std::size_t first = model.mobile() ? 6 : 0;
  const RigidInertia<double>& whole = composite.carried[0];
  CenterOfMass center{whole.mass, O, std::vector<double>(3 * n)};
  if (whole.mass == 0.) return center;
  center.position += (1. / whole.mass) * whole.mass_moment;
  // m_j (S at the carried centre) = m_j v_O + w x h_j.
  const auto add = [&](std::size_t column, const RigidInertia<double>& carried,
                       const Motion<double>& S) {
    set_column(
        center.jacobian, n, 0, column,
        (1. / whole.mass) * (carried.mass * S.linear + cross(S.angular, carried.mass_moment)));
  };
  for (std::size_t k = 0; k < first; ++k)
    add(k, whole, k < 3 ? Motion<double>{unit(k), {}} : Motion<double>{{}, unit(k - 3)});
  for (std::size_t body = 1; body < model.body_count(); ++body)
    add(first + body - 1, composite.carried[body], composite.freedoms[body - 1]);
  return center;
}

std::vector<double> gravity_forces(const CenterOfMass& center, const Vector3d& gravity_W) {
  const std::size_t n = center.jacobian.size() / 3;
  std::vector<double> h(n);
  const std::vector<double>& J = center.jacobian;
  for (std::size_t i = 0; i < n; ++i)
    h[i] =
        -center.mass * (J[i] * gravity_W.x + J[n + i] * gravity_W.y + J[2 * n + i] * gravity_W.z);
  return h;
}

}  // namespace hookpoint::dts
