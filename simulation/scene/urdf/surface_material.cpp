#include "simulation/scene/urdf/surface_material.h"

#include <fmt/format.h>

#include <algorithm>

namespace hookpoint::simulation {

namespace {

bool same_surface(const SurfaceMaterial& a, const SurfaceMaterial& b) {
  return a.friction == b.friction && a.stiffness == b.stiffness && a.damping == b.damping &&
         a.restitution == b.restitution && a.rolling == b.rolling && a.spinning == b.spinning &&
         a.mujoco == b.mujoco;
}

/// The values to six digits, in letters that a name may have.
std::string name_of_values(const SurfaceMaterial& material) {
  std::string name;
  const auto add = [&](const char* what, const std::optional<double>& value) {
    if (value) name += fmt::format("{}{}_{:g}", name.empty() ? "" : "_", what, *value);
  };
  add("friction", material.friction);
  add("k", material.stiffness);
  add("c", material.damping);
  add("e", material.restitution);
  add("rolling", material.rolling);
  add("spinning", material.spinning);
  if (material.mujoco) {
    add("solref", material.mujoco->row.reference[0]);
    add("ratio", material.mujoco->row.reference[1]);
  }
  std::ranges::replace(name, '-', 'm');
  std::ranges::replace_if(
      name, [](char c) { return c == '.' || c == '+'; }, '_');
  return name;
}

}  // namespace

std::size_t restate(const SurfaceMaterial& later, SurfaceMaterial& stated) {
  std::size_t changed = 0;
  const auto take = [&](const auto& from, auto& to) {
    if (!from) return;
    if (to && *to != *from) ++changed;
    to = from;
  };
  take(later.friction, stated.friction);
  take(later.stiffness, stated.stiffness);
  take(later.damping, stated.damping);
  take(later.restitution, stated.restitution);
  take(later.rolling, stated.rolling);
  take(later.spinning, stated.spinning);
  take(later.mujoco, stated.mujoco);
  stated.place = later.place;
  return changed;
}

std::string add_material(SurfaceMaterial material, std::vector<SurfaceMaterial>& known) {
  const auto same = std::ranges::find_if(
      known, [&](const SurfaceMaterial& other) { return same_surface(material, other); });
  if (same != known.end()) return same->name;
  const std::string name = name_of_values(material);
  material.name = name;
  for (std::size_t number = 2; std::ranges::count(known, material.name, &SurfaceMaterial::name) > 0;
       ++number)
    material.name = fmt::format("{}_{}", name, number);
  known.push_back(material);
  return material.name;
}

}  // namespace hookpoint::simulation
