// A four-bar linkage of uniform rods in the language, and its motion in closed form.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace hookpoint::test_support {

struct FourBar {
  // Crank a, coupler b, rocker c, ground d [m]; their masses [kg].
  static constexpr double a = 0.1, b = 0.3, c = 0.25, d = 0.3;
  static constexpr double m_a = 0.4, m_b = 0.9, m_c = 0.6;
  static constexpr double g = 9.81;

  /// Angles of coupler and rocker at a crank's, and their rates per rate of the crank.
  double coupler, rocker, coupler_ratio, rocker_ratio;

  explicit FourBar(double crank) {
    const double x = d - a * std::cos(crank), y = -a * std::sin(crank);
    const double e = std::hypot(x, y);
    // The triangle of coupler, rocker and the line from the crank's pin to the rocker's.
    const double at_pin = std::acos((b * b + e * e - c * c) / (2. * b * e));
    coupler = std::atan2(y, x) + at_pin;
    const double px = a * std::cos(crank) + b * std::cos(coupler) - d;
    const double py = a * std::sin(crank) + b * std::sin(coupler);
    rocker = std::atan2(py, px);
    coupler_ratio = a * std::sin(crank - rocker) / (b * std::sin(rocker - coupler));
    rocker_ratio = a * std::sin(crank - coupler) / (c * std::sin(rocker - coupler));
  }

  static double kinetic(double crank, double rate) {
    const FourBar at(crank);
    const double wb = at.coupler_ratio * rate, wc = at.rocker_ratio * rate;
    const double vx = -a * rate * std::sin(crank) - 0.5 * b * wb * std::sin(at.coupler);
    const double vy = a * rate * std::cos(crank) + 0.5 * b * wb * std::cos(at.coupler);
    return 0.5 * (m_a * a * a / 3. * rate * rate + m_b * (vx * vx + vy * vy) +
                  m_b * b * b / 12. * wb * wb + m_c * c * c / 3. * wc * wc);
  }
  static double potential(double crank) {
    const FourBar at(crank);
    return g * (m_a * 0.5 * a * std::sin(crank) +
                m_b * (a * std::sin(crank) + 0.5 * b * std::sin(at.coupler)) +
                m_c * 0.5 * c * std::sin(at.rocker));
  }
  /// The whole linkage has one degree of freedom: its speed at every angle follows from it [J].
  static double energy(double crank, double rate) {
    return kinetic(crank, rate) + potential(crank);
  }

  static std::string rod(const std::string& name, double length, double mass,
                         const std::string& more) {
    const std::string I = fmt::format("{}", mass * length * length / 12.);
    return " Link " + name + " { " + more + " mass = " + std::to_string(mass) +
           "; center_of_mass = " + std::to_string(length / 2.) + ", 0, 0; inertia = " + I + ", " +
           I + ", " + I + ", 0, 0, 0; }";
  }
  /// Robot `bar` of World `w` under gravity along -y, crank at 60 degrees and 2 rad/s; `world` and
  /// `loop` are more fields of these.
  static std::string text(const std::string& world, const std::string& loop = "") {
    return "World w { gravity = 0, -9.81, 0; " + world +
           " Robot bar { Base.fixed { } Chain left {" +
           rod("crank", a, m_a, "angle = 60 deg; rate = 2;") +
           rod("coupler", b, m_b, "dhlength = 0.1; angle = -40 deg;") +
           " } Chain right { hip_distance = 0.3, 0, 0;" +
           rod("rocker", c, m_c, "angle = 100 deg;") +
           " } Loop pin { a = left.coupler; b = right.rocker; point_a = 0.3, 0, 0; point_b = 0.25, "
           "0, 0; " +
           loop + " } } }";
  }
};

}  // namespace hookpoint::test_support
