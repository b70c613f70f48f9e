#include "simulation/scene/urdf/surface_material.h"

#include <fmt/format.h>

#include <algorithm>

namespace hookpoint::simulation {

std::string add_material(SurfaceMaterial material, std::vector<SurfaceMaterial>& known) {
  std::string& name = material.name;
  name.clear();
  const auto add = [&](const char* what, const std::optional<double>& value) {
    if (value) name += fmt::format("{}{}_{:g}", name.empty() ? "" : "_", what, *value);
  };
  add("friction", material.friction);
  add("k", material.stiffness);
  add("c", material.damping);
  add("e", material.restitution);
  add("rolling", material.rolling);
  add("spinning", material.spinning);
  std::ranges::replace_if(
      name, [](char c) { return c == '.' || c == '-' || c == '+'; }, '_');
  std::string found = name;
  if (std::ranges::count(known, name, &SurfaceMaterial::name) == 0)
    known.push_back(std::move(material));
  return found;
}

}  // namespace hookpoint::simulation
