// The mass properties of a body: given, or those of its shapes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dts/mass_properties.h"
#include "simulation/scene/body.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {

using language::FieldSchema;
using language::list_field;
using language::number_field;
using language::vector_field;

namespace {

double volume(const Box& box) { return dts::box_volume(box.dimensions); }
double volume(const Sphere& sphere) { return dts::sphere_volume(sphere.radius); }
double volume(const Cylinder& c) { return dts::cylinder_volume(c.radius, c.length); }
double volume(const Legcone& cone) {
  return dts::legcone_volume(cone.length, cone.proximal_radius, cone.distal_radius);
}
double volume(const Capsule& c) { return dts::capsule_volume(c.radius, c.length); }
double volume(const Hull& hull) { return dts::polyhedron_volume(hull.vertices, hull.faces); }

/// Of a disc, which has no volume [m^2].
double disc_area(const ShapeGeometry& geometry) {
  const auto* disc = std::get_if<Cylinder>(&geometry);
  return disc != nullptr && disc->length == 0. ? std::numbers::pi * disc->radius * disc->radius
                                               : 0.;
}

dts::MassProperties<double> solid(double mass, const Box& box) {
  return dts::box_mass(mass, box.dimensions);
}
dts::MassProperties<double> solid(double mass, const Sphere& sphere) {
  return dts::sphere_mass(mass, sphere.radius);
}
dts::MassProperties<double> solid(double mass, const Cylinder& c) {
  return dts::cylinder_mass(mass, c.radius, c.length);
}
dts::MassProperties<double> solid(double mass, const Legcone& cone) {
  return dts::legcone_mass(mass, cone.length, cone.proximal_radius, cone.distal_radius);
}
dts::MassProperties<double> solid(double mass, const Capsule& c) {
  return dts::capsule_mass(mass, c.radius, c.length);
}
dts::MassProperties<double> solid(double mass, const Hull& hull) {
  return dts::polyhedron_mass(mass, hull.vertices, hull.faces);
}

using ShapeObjects = std::vector<const language::Object*>;

/// The mass of each shape: its own, or its share of what the body's mass leaves, by volume; of discs
/// alone by area.
std::vector<double> share_mass(const language::Object& object, const std::vector<ShapeSpec>& shapes,
                               const ShapeObjects& shape_objects, Loading& loading) {
  std::vector<double> masses(shapes.size(), 0.), volumes(shapes.size(), 0.);
  double own = 0., shared_volume = 0.;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (shape_objects[i]->given(mass_field::mass)) {
      own += masses[i] = shape_objects[i]->number(mass_field::mass);
    } else {
      volumes[i] =
          std::visit([](const auto& geometry) { return volume(geometry); }, shapes[i].geometry);
      shared_volume += volumes[i];
    }
  }
  if (!object.given(mass_field::mass)) return masses;
  if (shared_volume == 0.) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (shape_objects[i]->given(mass_field::mass)) continue;
      shared_volume += volumes[i] = disc_area(shapes[i].geometry);
    }
  }
  const double mass = object.number(mass_field::mass);
  const double left = mass - own;
  const double rounding = 1e-12 * std::max(mass, own);
  if (left < -rounding || (left > rounding && shared_volume == 0. && !shapes.empty())) {
    loading.error(
        place_of(object, mass_field::mass),
        fmt::format(
            "mass is {:g} kg but the shapes' own masses add up to {:g} kg; leave one of them out",
            mass, own));
  }
  for (std::size_t i = 0; i < shapes.size() && shared_volume > 0.; ++i) {
    masses[i] += std::max(left, 0.) * volumes[i] / shared_volume;
  }
  return masses;
}

/// Whether the symmetric matrix has no negative principal minor beyond rounding, `scale` being the
/// size of its elements.
bool positive_semidefinite(const Symmetric3d& m, double scale) {
  const double rounding = 1e-9 * scale;
  const bool diagonal = m.xx >= -rounding && m.yy >= -rounding && m.zz >= -rounding;
  const double second = -rounding * scale;
  const bool minors = m.xx * m.yy - m.xy * m.xy >= second && m.xx * m.zz - m.xz * m.xz >= second &&
                      m.yy * m.zz - m.yz * m.yz >= second;
  return diagonal && minors && determinant(general(m)) >= second * scale;
}

/// Sylvester's criterion, relative to `scale`: an inertia with a principal moment near 0 cannot
/// turn freely.
bool positive_definite(const Symmetric3d& m, double scale) {
  const double least = 1e-12 * scale;
  return m.xx > least && m.xx * m.yy - m.xy * m.xy > least * scale &&
         determinant(general(m)) > least * scale * scale;
}

/// An inertia I belongs to some distribution of mass iff tr(I)/2 1 - I has no negative eigenvalue:
/// that is the triangle inequality of the principal moments.
bool triangle_inequality(const Symmetric3d& inertia) {
  const double half_trace = 0.5 * (inertia.xx + inertia.yy + inertia.zz);
  const Symmetric3d second_moments{half_trace - inertia.xx,
                                   half_trace - inertia.yy,
                                   half_trace - inertia.zz,
                                   -inertia.xy,
                                   -inertia.xz,
                                   -inertia.yz};
  return positive_semidefinite(second_moments, std::abs(half_trace));
}

}  // namespace

std::string inertia_problem(const Symmetric3d& inertia) {
  if (!positive_semidefinite(inertia, std::abs(inertia.xx + inertia.yy + inertia.zz)))
    return "has a negative principal moment";
  if (!triangle_inequality(inertia))
    return "breaks the triangle inequality: no principal moment may exceed the sum of the other two";
  return "";
}

namespace {

void check_inertia(const language::Object& object, const MassSpec& mass, bool must_have_inertia,
                   Loading& loading) {
  const Symmetric3d& inertia = mass.inertia;
  const double trace = inertia.xx + inertia.yy + inertia.zz;
  const language::Position& place = place_of(object, mass_field::inertia);
  const std::string problem =
      object.given(mass_field::inertia) ? inertia_problem(inertia) : std::string();
  if (!problem.empty())
    return loading.error(place, "inertia " + problem +
                                    "; the order is Ixx,Iyy,Izz,Ixy,Ixz,Iyz about the centre of "
                                    "mass");
  if (must_have_inertia && !positive_definite(inertia, trace)) {
    loading.error(place,
                  "a free body needs an inertia about every axis; give `inertia`, or a shape from "
                  "which it follows");
  }
}

/// Whether the object gives mass properties that nothing says a mass for.
bool lacks_mass(const language::Object& object, double mass) {
  return !(mass > 0.) &&
         (object.given(mass_field::inertia) || object.given(mass_field::center_of_mass));
}

}  // namespace

std::vector<FieldSchema> mass_fields(const std::string& axes) {
  return {
      not_negative(
          number_field(mass_field::mass, "kg", "",
                       "of the body; shared over shapes without a mass of their own, by volume")),
      vector_field(mass_field::center_of_mass, "m", "",
                   axes + " axes; if not given, that of the shapes, or the origin"),
      list_field(mass_field::inertia, "kg.m^2", 6, 6, "",
                 "matrix elements Ixx,Iyy,Izz,Ixy,Ixz,Iyz about the centre of mass, " + axes +
                     " axes; if not given, that of the shapes"),
  };
}

MassSpec load_mass(const language::Object& object, const std::vector<ShapeSpec>& shapes,
                   const ShapeObjects& shape_objects, bool must_have_inertia, Loading& loading) {
  const std::vector<double> masses = share_mass(object, shapes, shape_objects, loading);
  std::vector<dts::MassProperties<double>> parts;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto part = std::visit([&](const auto& geometry) { return solid(masses[i], geometry); },
                                 shapes[i].geometry);
    parts.push_back(dts::placed(part, shapes[i].location, shapes[i].orientation));
  }
  const dts::MassProperties<double> whole = dts::combined(parts);
  MassSpec mass{whole.mass, whole.center_of_mass, whole.inertia};
  if (object.given(mass_field::mass)) mass.mass = object.number(mass_field::mass);
  if (object.given(mass_field::center_of_mass))
    mass.center_of_mass = vector_of(object, mass_field::center_of_mass);
  if (object.given(mass_field::inertia)) {
    const std::vector<double>& i = object.numbers(mass_field::inertia);
    mass.inertia = {i[0], i[1], i[2], i[3], i[4], i[5]};
  }
  if ((must_have_inertia && !(mass.mass > 0.)) || lacks_mass(object, mass.mass)) {
    loading.error(place_of(object, mass_field::mass),
                  must_have_inertia
                      ? "a free body needs a mass above 0; give `mass`, here or in its shapes"
                      : "inertia and center_of_mass mean nothing without a mass; give `mass`");
    return mass;
  }
  check_inertia(object, mass, must_have_inertia, loading);
  return mass;
}

}  // namespace hookpoint::simulation
