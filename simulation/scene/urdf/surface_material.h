// The surface that a robot's file states for a shape: a Material.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/mujoco_contact.h"
#include "language/source.h"

namespace hookpoint::simulation {

/// The surface of shapes as a file states it: a Material.
struct SurfaceMaterial {
  std::string name;
  language::Position place;
  std::optional<double> friction;            ///< static and kinetic
  std::optional<double> stiffness, damping;  ///< along the normal [N/m, N s/m]
  std::optional<double> restitution;
  std::optional<double> rolling, spinning;  ///< resistances [m]
  std::optional<contact::MujocoContact> mujoco;

  bool says_nothing() const {
    return !friction && !stiffness && !damping && !restitution && !rolling && !spinning && !mujoco;
  }
};
/// What of a surface counts: nothing, its friction, or all that the file states.
enum class StatedContact { ground, friction, file };

/// Adds what `later` states to `stated`, in whose place it comes where both state a constant. Result:
/// how many constants have another value then.
std::size_t restate(const SurfaceMaterial& later, SurfaceMaterial& stated);

/// The name of `material` among `known`, which it joins if none of the same values is there; the name
/// says them.
std::string add_material(SurfaceMaterial material, std::vector<SurfaceMaterial>& known);

}  // namespace hookpoint::simulation
