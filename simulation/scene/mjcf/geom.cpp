#include "simulation/scene/mjcf/geom.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <eigen3/Eigen/Eigenvalues>
#include <numbers>

#include "dts/mass_properties.h"
#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {
namespace {

struct FormRow {
  std::string_view name;
  MjcfForm form;
  std::size_t sizes;  ///< how many numbers of `size` it takes
};
constexpr std::array form_rows{
    FormRow{"sphere", MjcfForm::sphere, 1},       FormRow{"capsule", MjcfForm::capsule, 2},
    FormRow{"cylinder", MjcfForm::cylinder, 2},   FormRow{"box", MjcfForm::box, 3},
    FormRow{"ellipsoid", MjcfForm::ellipsoid, 3}, FormRow{"plane", MjcfForm::plane, 0},
    FormRow{"mesh", MjcfForm::mesh, 0},           FormRow{"hfield", MjcfForm::heights, 0},
};

/// Placed between two points, its z from the second to the first.
void place_between(const MjcfAttributes& given, MjcfGeom& geom) {
  const auto ends = given.numbers("fromto", {0., 0., 0., 0., 0., 0.});
  const Vector3d from{ends[0], ends[1], ends[2]}, to{ends[3], ends[4], ends[5]};
  const double length = norm(from - to);
  if (geom.form != MjcfForm::capsule && geom.form != MjcfForm::cylinder &&
      geom.form != MjcfForm::box && geom.form != MjcfForm::ellipsoid) {
    given.fail("fromto", "fromto is of a capsule, cylinder, box or ellipsoid");
    return;
  }
  if (!(length > 0.)) {
    given.fail("fromto", "the ends of fromto are one point");
    return;
  }
  geom.pose = {0.5 * (from + to), from_z_to((1. / length) * (from - to))};
  if (geom.form == MjcfForm::box || geom.form == MjcfForm::ellipsoid) {
    geom.size.y = geom.size.x;
    geom.size.z = 0.5 * length;
  } else {
    geom.size.y = 0.5 * length;
  }
}

/// Two geoms touch where a bit of the one's contype is in the other's conaffinity.
void read_contact_masks(const MjcfAttributes& given, MjcfGeom& geom) {
  constexpr long long ground = 1;
  const auto type = static_cast<long long>(given.number("contype", 1.));
  const auto affinity = static_cast<long long>(given.number("conaffinity", 1.));
  geom.touches = (type & ground) != 0 || (affinity & ground) != 0;
  geom.touches_others = !geom.touches && (type != 0 || affinity != 0);
}

double volume_of(const MjcfGeom& geom) {
  const Vector3d& size = geom.size;
  switch (geom.form) {
    case MjcfForm::sphere:
      return dts::sphere_volume(size.x);
    case MjcfForm::capsule:
      return dts::capsule_volume(size.x, 2. * size.y);
    case MjcfForm::cylinder:
      return dts::cylinder_volume(size.x, 2. * size.y);
    case MjcfForm::box:
      return dts::box_volume(2. * size);
    case MjcfForm::ellipsoid:
      return 4. / 3. * std::numbers::pi * size.x * size.y * size.z;
    case MjcfForm::plane:
    case MjcfForm::mesh:
    case MjcfForm::heights:
      break;
  }
  return 0.;
}

dts::MassProperties<double> uniform(const MjcfGeom& geom, double mass) {
  const Vector3d& size = geom.size;
  switch (geom.form) {
    case MjcfForm::sphere:
      return dts::sphere_mass(mass, size.x);
    case MjcfForm::capsule:
      return dts::capsule_mass(mass, size.x, 2. * size.y);
    case MjcfForm::cylinder:
      return dts::cylinder_mass(mass, size.x, 2. * size.y);
    case MjcfForm::box:
      return dts::box_mass(mass, 2. * size);
    case MjcfForm::ellipsoid: {
      const double xx = size.x * size.x, yy = size.y * size.y, zz = size.z * size.z;
      return {mass, {}, (mass / 5.) * Symmetric3d{yy + zz, xx + zz, xx + yy, 0., 0., 0.}};
    }
    case MjcfForm::plane:
    case MjcfForm::mesh:
    case MjcfForm::heights:
      break;
  }
  return {};
}

}  // namespace

std::optional<MjcfGeom> read_geom(const MjcfAttributes& given, MjcfDocument& document) {
  MjcfGeom geom;
  std::string type = given.word("type");
  // A mesh that gives a primitive its size is a mesh to us.
  if (given.has("mesh")) type = "mesh";
  if (type.empty()) type = "sphere";
  const auto* const row = std::ranges::find(form_rows, std::string_view(type), &FormRow::name);
  if (row == form_rows.end()) {
    given.fail("type", fmt::format("`{}` is no type of geom that is read", type));
    return std::nullopt;
  }
  geom.form = row->form;
  geom.pose = document.pose(given);
  geom.size = given.vector("size", {});
  if (given.has("fromto")) place_between(given, geom);
  const std::array sizes{geom.size.x, geom.size.y, geom.size.z};
  for (std::size_t i = 0; i < row->sizes; ++i) {
    if (sizes[i] > 0.) continue;
    given.fail("size", fmt::format("size of a {} has {} number{} greater than 0", type, row->sizes,
                                   row->sizes == 1 ? "" : "s"));
    return std::nullopt;
  }
  read_contact_masks(given, geom);
  return geom;
}

std::optional<dts::MassProperties<double>> mass_of_geom(const MjcfGeom& geom,
                                                        const MjcfAttributes& given) {
  constexpr double water = 1000.;  // MJCF's default [kg/m^3]
  const double density = given.number("density", water);
  double mass = given.number("mass", 0.);
  if (mass < 0. || density < 0.) {
    given.fail(mass < 0. ? "mass" : "density", "a mass or density is not negative");
    return dts::MassProperties<double>{};
  }
  const bool solid = geom.form != MjcfForm::plane && geom.form != MjcfForm::heights;
  const bool weightless = given.has("mass") ? mass == 0. : density == 0.;
  if (!solid || weightless) return dts::MassProperties<double>{};
  if (geom.form == MjcfForm::mesh) return std::nullopt;
  if (!given.has("mass")) mass = density * volume_of(geom);
  return dts::placed(uniform(geom, mass), geom.pose.position, geom.pose.orientation);
}

dts::MassProperties<double> read_inertial(const MjcfAttributes& given, MjcfDocument& document) {
  for (const char* needed : {"pos", "mass"}) {
    if (!given.has(needed)) given.fail(needed, fmt::format("<inertial> lacks {}=\"...\"", needed));
  }
  const double mass = given.number("mass", 0.);
  if (mass < 0.) given.fail("mass", "a mass is not negative");
  Symmetric3d inertia;
  if (given.has("fullinertia")) {
    const auto I = given.numbers("fullinertia", {0., 0., 0., 0., 0., 0.});
    inertia = {I[0], I[1], I[2], I[3], I[4], I[5]};
  } else if (given.has("diaginertia")) {
    const Vector3d I = given.vector("diaginertia", {});
    inertia = {I.x, I.y, I.z, 0., 0., 0.};
  }
  const Pose X_BC = document.pose(given);
  return dts::placed({mass, {}, inertia}, X_BC.position, X_BC.orientation);
}

void bound_mass(const MjcfCompiler& compiler, dts::MassProperties<double>& of) {
  of.mass = std::max(of.mass, compiler.least_mass);
  Symmetric3d& I = of.inertia;
  if (compiler.least_inertia <= 0. && !compiler.balance_inertia) return;
  const Eigen::Matrix3d full{{I.xx, I.xy, I.xz}, {I.xy, I.yy, I.yz}, {I.xz, I.yz, I.zz}};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> found(full);
  Eigen::Vector3d principal = found.eigenvalues();
  bool changed = principal[0] < compiler.least_inertia;
  principal = principal.cwiseMax(compiler.least_inertia);
  // In ascending order: the greatest may not exceed the others together.
  if (compiler.balance_inertia && principal[0] + principal[1] < principal[2]) {
    principal.setConstant(principal.mean());
    changed = true;
  }
  if (!changed) return;
  const Eigen::Matrix3d& V = found.eigenvectors();
  const Eigen::Matrix3d bounded = V * principal.asDiagonal() * V.transpose();
  I = {bounded(0, 0), bounded(1, 1), bounded(2, 2), bounded(0, 1), bounded(0, 2), bounded(1, 2)};
}

}  // namespace hookpoint::simulation
