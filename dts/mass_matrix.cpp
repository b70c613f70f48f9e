#include "dts/mass_matrix.h"

#include "dts/configuration.h"
#include "dts/rigid_body.h"

namespace hookpoint::dts {

std::vector<double> mass_matrix(const Model<double>& model, const CompositeBodies& composite) {
  const std::size_t n = velocity_count(model);
  const std::size_t first = model.mobile() ? 6 : 0;
  std::vector<double> M(n * n);
  const auto set = [&](std::size_t i, std::size_t j, double value) {
    M[i * n + j] = value;
    M[j * n + i] = value;
  };
  // The column of one coordinate: what its unit acceleration takes, seen by all that carry it.
  const auto add_base_rows = [&](std::size_t column, const Wrench<double>& f) {
    const std::array<double, 6> rows{f.moment.x, f.moment.y, f.moment.z,
                                     f.force.x,  f.force.y,  f.force.z};
    for (std::size_t k = 0; k < first; ++k) set(k, column, rows[k]);
  };
  for (std::size_t k = 0; k < first; ++k) {
    Motion<double> unit;
    Vector3d& part = k < 3 ? unit.angular : unit.linear;
    part = {k % 3 == 0 ? 1. : 0., k % 3 == 1 ? 1. : 0., k % 3 == 2 ? 1. : 0.};
    add_base_rows(k, composite.carried[0] * unit);
  }
  for (std::size_t body = 1; body < model.body_count(); ++body) {
    const std::size_t column = first + body - 1;
    const Wrench<double> f = composite.carried[body] * composite.freedoms[body - 1];
    add_base_rows(column, f);
    for (std::size_t inner = body; inner > 0; inner = model.carrier_of(inner))
      set(first + inner - 1, column, dot(f, composite.freedoms[inner - 1]));
    M[column * n + column] += composite.rotor_inertias[body - 1];
  }
  return M;
}

}  // namespace hookpoint::dts
