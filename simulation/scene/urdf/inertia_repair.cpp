// With principal moments a <= b <= c: a negative one becomes 0, one below a thousandth of the greatest
// that much; then the nearest that meets c <= a + b, by moving each a third of what is missing,
// (a + e/3, b + e/3, c - e/3) with e = c - a - b, which is the orthogonal projection. All 0: those of a
// ball of water.
#include "simulation/scene/urdf/inertia_repair.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/scene/body.h"

namespace hookpoint::simulation {
namespace {

struct Repaired {
  Symmetric3d inertia;
  double change = 0.;  ///< of a principal moment, by the greatest of them
};

Repaired nearest_to(const Symmetric3d& I, double mass) {
  Eigen::Matrix3d matrix;
  matrix << I.xx, I.xy, I.xz, I.xy, I.yy, I.yz, I.xz, I.yz, I.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  const Eigen::Vector3d& before = solver.eigenvalues();
  Eigen::Vector3d moments = before.cwiseMax(0.);
  const double compact = compact_inertia(mass);
  constexpr double nothing = 1e-9, thinnest = 1e-3;
  if (moments[2] < nothing * compact) moments.setConstant(compact);
  moments = moments.cwiseMax(thinnest * moments[2]);
  if (const double missing = moments[2] - moments[0] - moments[1]; missing > 0.) {
    moments[0] += missing / 3.;
    moments[1] += missing / 3.;
    moments[2] -= missing / 3.;
  }
  const Eigen::Matrix3d& V = solver.eigenvectors();
  const Eigen::Matrix3d R = V * moments.asDiagonal() * V.transpose();
  return {{R(0, 0), R(1, 1), R(2, 2), R(0, 1), R(0, 2), R(1, 2)},
          (moments - before).cwiseAbs().maxCoeff() / moments.maxCoeff()};
}

}  // namespace

double compact_inertia(double mass) {
  constexpr double water = 1000.;  // [kg/m^3]
  const double radius = std::cbrt(3. * mass / (4. * std::numbers::pi * water));
  return 0.4 * mass * radius * radius;
}

std::string settle_inertia(UrdfInertia choice, UrdfLink& link, std::vector<std::string>& repaired) {
  MassSpec& mass = link.mass;
  const bool is_zero = mass.inertia == Symmetric3d{};
  if (mass.mass == 0.) {
    if (is_zero) return "";
    if (choice == UrdfInertia::repair) {
      mass = {};
      link.has_inertial = false;
      repaired.push_back(fmt::format("`{}` (without mass: none)", link.name));
      return "";
    }
    return fmt::format(
        "link `{}` has an inertia and no mass: the argument inertia = repair leaves both out",
        link.name);
  }
  const std::string problem = inertia_problem(mass.inertia);
  if (problem.empty() && !is_zero) return "";
  const Repaired nearest = nearest_to(mass.inertia, mass.mass);
  const std::string change = fmt::format("{:.2g} % of its greatest moment", 100. * nearest.change);
  if (choice == UrdfInertia::repair) {
    mass.inertia = nearest.inertia;
    repaired.push_back(is_zero ? fmt::format("`{}` (0: that of a ball of water)", link.name)
                               : fmt::format("`{}` (by {})", link.name, change));
  } else if (!problem.empty()) {
    return fmt::format(
        "the inertia of link `{}` {}: the argument inertia = repair takes the nearest that a body "
        "can have, {} away",
        link.name, problem, change);
  }
  return "";
}

}  // namespace hookpoint::simulation
