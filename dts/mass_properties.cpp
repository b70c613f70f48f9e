#include "dts/mass_properties.h"

#include <numbers>

namespace hookpoint::dts {
namespace {

/// Calls `visit(volume, a, b, c)` for the tetrahedra between `top` and the faces' triangles, whose
/// corners it gets as seen from `top`.
template <class Visit>
void for_each_tetrahedron(const Vector3d& top, std::span<const Vector3d> vertices,
                          std::span<const std::vector<std::size_t>> faces, const Visit& visit) {
  for (const std::vector<std::size_t>& face : faces) {
    for (std::size_t i = 2; i < face.size(); ++i) {
      const Vector3d a = vertices[face[0]] - top, b = vertices[face[i - 1]] - top,
                     c = vertices[face[i]] - top;
      visit(dot(a, cross(b, c)) / 6., a, b, c);
    }
  }
}

}  // namespace

MassProperties<double> box_mass(double mass, const Vector3d& dimensions) {
  const auto [x, y, z] = dimensions;
  const double k = mass / 12.;
  return {mass, {}, {k * (y * y + z * z), k * (x * x + z * z), k * (x * x + y * y), 0., 0., 0.}};
}

MassProperties<double> sphere_mass(double mass, double radius) {
  const double moment = 0.4 * mass * radius * radius;
  return {mass, {}, {moment, moment, moment, 0., 0., 0.}};
}

MassProperties<double> cylinder_mass(double mass, double radius, double length) {
  const double across = mass * (3. * radius * radius + length * length) / 12.;
  return {mass, {}, {across, across, 0.5 * mass * radius * radius, 0., 0., 0.}};
}

// Discs of radius r(t) = p + (q - p) t, t = x / L in [0, 1]. With the integrals
//   A = int r^2 dt = (p^2 + p q + q^2)/3,  B = int r^2 t dt = (p^2 + 2 p q + 3 q^2)/12,
//   C = int r^2 t^2 dt = (p^2 + 3 p q + 6 q^2)/30,  F = int r^4 dt = (p^4 + p^3 q + p^2 q^2 + p q^3
//   + q^4)/5
// the mass is rho pi L A, the centroid L B/A, Ixx = m F/(2 A), and across, about the origin, m
// (F/(4 A) + L^2 C/A).
MassProperties<double> legcone_mass(double mass, double length, double proximal_radius,
                                    double distal_radius) {
  const double p = proximal_radius;
  const double q = distal_radius;
  const double A = (p * p + p * q + q * q) / 3.;
  const double B = (p * p + 2. * p * q + 3. * q * q) / 12.;
  const double C = (p * p + 3. * p * q + 6. * q * q) / 30.;
  const double F =
      (p * p * p * p + p * p * p * q + p * p * q * q + p * q * q * q + q * q * q * q) / 5.;
  const double centroid = length * B / A;
  const double across = mass * (F / (4. * A) + length * length * C / A - centroid * centroid);
  return {mass, {centroid, 0., 0.}, {mass * F / (2. * A), across, across, 0., 0., 0.}};
}

// The cylinder, and two half balls whose centroids are 3/8 r beyond its ends.
MassProperties<double> capsule_mass(double mass, double radius, double length) {
  const double ball = sphere_volume(radius);
  const double balls = mass * ball / (ball + cylinder_volume(radius, length));
  const MassProperties<double> middle = cylinder_mass(mass - balls, radius, length);
  const double own = 0.4 * balls * radius * radius;
  const double apart = balls * length * (0.25 * length + 0.375 * radius);
  const Symmetric3d& I = middle.inertia;
  return {mass, {}, {I.xx + own + apart, I.yy + own + apart, I.zz + own, 0., 0., 0.}};
}

// Tetrahedra with the first vertex as their common corner. Of each of volume V, with a, b, c as seen
// from there, the first moment is V (a + b + c)/4 and the second V (a a^T + b b^T + c c^T + s s^T)/20
// with s = a + b + c.
MassProperties<double> polyhedron_mass(double mass, std::span<const Vector3d> vertices,
                                       std::span<const std::vector<std::size_t>> faces) {
  double volume = 0.;
  Vector3d first;
  Symmetric3d inertia;  // of volume, about the first vertex: point_inertia() is |p|^2 1 - p p^T
  for_each_tetrahedron(vertices[0], vertices, faces,
                       [&](double part, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
                         const Vector3d sum = a + b + c;
                         volume += part;
                         first += 0.25 * part * sum;
                         for (const Vector3d& p : {a, b, c, sum})
                           inertia += point_inertia(part / 20., p);
                       });
  const Vector3d centroid = (1. / volume) * first;
  inertia += point_inertia(-volume, centroid);
  const double density = mass / volume;
  return {mass,
          vertices[0] + centroid,
          {density * inertia.xx, density * inertia.yy, density * inertia.zz, density * inertia.xy,
           density * inertia.xz, density * inertia.yz}};
}

double box_volume(const Vector3d& dimensions) { return dimensions.x * dimensions.y * dimensions.z; }

double sphere_volume(double radius) {
  return 4. / 3. * std::numbers::pi * radius * radius * radius;
}

double cylinder_volume(double radius, double length) {
  return std::numbers::pi * radius * radius * length;
}

double legcone_volume(double length, double proximal_radius, double distal_radius) {
  return std::numbers::pi / 3. * length *
         (proximal_radius * proximal_radius + proximal_radius * distal_radius +
          distal_radius * distal_radius);
}

double capsule_volume(double radius, double length) {
  return cylinder_volume(radius, length) + sphere_volume(radius);
}

double polyhedron_volume(std::span<const Vector3d> vertices,
                         std::span<const std::vector<std::size_t>> faces) {
  double volume = 0.;
  for_each_tetrahedron(
      vertices[0], vertices, faces,
      [&](double part, const Vector3d&, const Vector3d&, const Vector3d&) { volume += part; });
  return volume;
}

MassProperties<double> placed(const MassProperties<double>& part, const Vector3d& location,
                              const Quaterniond& orientation) {
  const Matrix3d R_BS = rotation_matrix(normalized(orientation));
  return {part.mass, location + R_BS * part.center_of_mass, rotate(R_BS, part.inertia)};
}

MassProperties<double> combined(std::span<const MassProperties<double>> parts) {
  MassProperties<double> whole;
  Vector3d mass_moment;
  for (const MassProperties<double>& part : parts) {
    whole.mass += part.mass;
    mass_moment += part.mass * part.center_of_mass;
  }
  if (whole.mass == 0.) return whole;
  whole.center_of_mass = (1. / whole.mass) * mass_moment;
  for (const MassProperties<double>& part : parts) {
    const Vector3d offset = part.center_of_mass - whole.center_of_mass;
    whole.inertia += part.inertia + point_inertia(part.mass, offset);
  }
  return whole;
}

}  // namespace hookpoint::dts
