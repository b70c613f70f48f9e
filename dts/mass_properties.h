// Mass, centre of mass and inertia of uniform solids and of bodies composed of them. Each solid is
// given in its own frame; `placed` carries it into a body's.
#pragma once

#include <span>

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

double box_volume(const Vector3d& dimensions);
double sphere_volume(double radius);
double cylinder_volume(double radius, double length);
double legcone_volume(double length, double proximal_radius, double distal_radius);

/// `part`, given in frame S, as seen from frame B: p_BS = `location`, R_BS = `orientation`.
MassProperties<double> placed(const MassProperties<double>& part, const Vector3d& location,
                              const Quaterniond& orientation);

/// Parts of one rigid body, all in its frame, taken together (parallel axes). No mass at all gives
/// zeros.
MassProperties<double> combined(std::span<const MassProperties<double>> parts);

}  // namespace hookpoint::dts
