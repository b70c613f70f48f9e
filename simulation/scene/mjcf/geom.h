// A <geom>: its form, where it stands, what it weighs.
#pragma once

#include <optional>

#include "dts/model.h"
#include "simulation/scene/mjcf/document.h"

namespace hookpoint::simulation {

enum class MjcfForm { sphere, capsule, cylinder, box, ellipsoid, plane, mesh, heights };

struct MjcfGeom {
  MjcfForm form = MjcfForm::sphere;
  Vector3d size;                ///< MJCF's: radius, half lengths
  Pose pose;                    ///< in the frame that it stands in
  bool touches = true;          ///< the ground, as a geom of contype and conaffinity 1
  bool touches_others = false;  ///< not the ground, but what else has bits of its masks
};

/// Nothing after an error.
std::optional<MjcfGeom> read_geom(const MjcfAttributes& given, MjcfDocument& document);

/// By its `mass`, or its volume and `density`, in the frame that it stands in; nothing of a mesh, of
/// which the volume is not known.
std::optional<dts::MassProperties<double>> mass_of_geom(const MjcfGeom& geom,
                                                        const MjcfAttributes& given);

/// The mass and inertia that <inertial> gives, in the frame that it stands in.
dts::MassProperties<double> read_inertial(const MjcfAttributes& given, MjcfDocument& document);

/// `boundmass`, `boundinertia` and `balanceinertia` of the compiler.
void bound_mass(const MjcfCompiler& compiler, dts::MassProperties<double>& mass);

}  // namespace hookpoint::simulation
