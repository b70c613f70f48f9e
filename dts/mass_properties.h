// Mass, centre of mass and inertia of uniform solids and of bodies composed of them. Each solid is
// given in its own frame; `placed` carries it into a body's.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dts/model.h"

namespace hookpoint::dts {

/// Box with edges `dimensions` [m] along x, y, z, centred.
MassProperties<double> box_mass(double mass, const Vector3d& dimensions);
MassProperties<double> sphere_mass(double mass, double radius);
/// Cylinder about z, centred.
MassProperties<double> cylinder_mass(double mass, double radius, double length);
/// Solid truncated cone along +x, its proximal face at the origin.
MassProperties<double> legcone_mass(double mass, double length, double proximal_radius,
                                    double distal_radius);
/// Capsule about z, centred; `length` is that of its cylindrical part.
MassProperties<double> capsule_mass(double mass, double radius, double length);
/// Polyhedron that the `faces` of vertices close, each counter-clockwise as seen from outside.
MassProperties<double> polyhedron_mass(double mass, std::span<const Vector3d> vertices,
                                       std::span<const std::vector<std::size_t>> faces);

double box_volume(const Vector3d& dimensions);
double sphere_volume(double radius);
double cylinder_volume(double radius, double length);
double legcone_volume(double length, double proximal_radius, double distal_radius);
double capsule_volume(double radius, double length);
double polyhedron_volume(std::span<const Vector3d> vertices,
                         std::span<const std::vector<std::size_t>> faces);

/// `part`, given in frame S, as seen from frame B: p_BS = `location`, R_BS = `orientation`.
MassProperties<double> placed(const MassProperties<double>& part, const Vector3d& location,
                              const Quaterniond& orientation);

/// Parts of one rigid body, all in its frame, taken together (parallel axes). No mass at all gives
/// zeros.
MassProperties<double> combined(std::span<const MassProperties<double>> parts);

}  // namespace hookpoint::dts
