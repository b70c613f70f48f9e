#include "simulation/scene/sdf/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "dts/mass_properties.h"
#include "math/rotation.h"
#include "simulation/scene/terrain/png_grid.h"
#include "simulation/scene/urdf/mesh_path.h"

namespace hookpoint::simulation {
namespace {

/// [kg/m^3], SDFormat's.
constexpr double default_density = 1000.;

double positive_number(const XmlElement& parent, const char* name, double otherwise) {
  const double value = sdf_number(parent, name, otherwise);
  if (value > 0.) return value;
  const XmlElement element = SdfDocument::child(parent, name);
  parent.file->fail(element.node ? element.place() : parent.place(),
                    fmt::format("<{}> of <{}> is greater than 0", name, parent.tag()));
  return otherwise;
}

dts::MassProperties<double> uniform_solid(const ShapeGeometry& of, double density) {
  if (const auto* box = std::get_if<Box>(&of))
    return dts::box_mass(density * dts::box_volume(box->dimensions), box->dimensions);
  if (const auto* sphere = std::get_if<Sphere>(&of))
    return dts::sphere_mass(density * dts::sphere_volume(sphere->radius), sphere->radius);
  if (const auto* rod = std::get_if<Cylinder>(&of))
    return dts::cylinder_mass(density * dts::cylinder_volume(rod->radius, rod->length), rod->radius,
                              rod->length);
  const auto& capsule = std::get<Capsule>(of);
  return dts::capsule_mass(density * dts::capsule_volume(capsule.radius, capsule.length),
                           capsule.radius, capsule.length);
}

/// A grid of heights. Gazebo scales the image so that its brightest vertex stands `size.z` above black.
std::optional<SdfGround> read_heights(const XmlElement& heightmap, const Pose& X_WC,
                                      const SdfDocument& document, language::FileStore& files) {
  const XmlElement uri = SdfDocument::child(heightmap, "uri");
  const std::string name = SdfDocument::text_of(heightmap, "uri");
  const auto fail = [&](const std::string& message) {
    heightmap.file->fail(uri.node ? uri.place() : heightmap.place(), message);
    return std::nullopt;
  };
  const Vector3d size = sdf_vector(heightmap, "size", {1., 1., 1.});
  const Vector3d pos = X_WC.position + sdf_vector(heightmap, "pos", {});
  if (!(size.x > 0. && size.y > 0.)) return fail("the <size> of a heightmap is greater than 0");
  constexpr double straight = 1e-9;
  const Quaterniond& q = X_WC.orientation;
  if (std::abs(q.x) + std::abs(q.y) + std::abs(q.z) > straight)
    return fail("a heightmap that is turned is not read: turn the rest of the world");
  const std::filesystem::path found =
      first_file(mesh_places(name, document.path_of(heightmap), files.search_path()));
  if (found.empty()) return fail(fmt::format("there is no image `{}`", name));
  const std::string path = found.string();
  const PngGridResult& image =
      files.keep<PngGridResult>("heights " + path, [&] { return read_png_grid(found, 0., 1.); });
  if (!image.grid) return fail(fmt::format("`{}`: {}", name, image.message));
  const double brightest = *std::ranges::max_element(image.grid->heights);
  SdfGround ground;
  ground.file = path;
  ground.spacing = size.x / (image.grid->columns - 1);
  const double other = size.y / (image.grid->rows - 1);
  constexpr double square = 1e-6;
  if (std::abs(other - ground.spacing) > square * ground.spacing)
    return fail(
        fmt::format("the vertices of this heightmap are {:g} m apart along x and {:g} m "
                    "along y: cells are squares",
                    ground.spacing, other));
  ground.origin_x = pos.x - 0.5 * size.x;
  ground.origin_y = pos.y - 0.5 * size.y;
  ground.low = pos.z;
  ground.high = pos.z + (brightest > 0. ? size.z / brightest : 0.);
  return ground;
}

}  // namespace

double sdf_number(const XmlElement& parent, const char* name, double otherwise) {
  const XmlElement element = SdfDocument::child(parent, name);
  // What is empty says nothing.
  return SdfDocument::text_of(parent, name).empty() ? otherwise
                                                    : element.file->content(element.node);
}

Vector3d sdf_vector(const XmlElement& parent, const char* name, const Vector3d& otherwise) {
  const XmlElement element = SdfDocument::child(parent, name);
  if (!element.node) return otherwise;
  const std::size_t before = element.file->errors();
  const std::vector<double> x = element.file->content_numbers(element.node, 3);
  if (element.file->errors() != before) return otherwise;
  if (x.empty()) return otherwise;
  if (x.size() == 3) return {x[0], x[1], x[2]};
  element.file->fail(element.place(), fmt::format("<{}> takes three numbers", name));
  return otherwise;
}

dts::MassProperties<double> read_sdf_inertial(const XmlElement& inertial, SdfModel& scope,
                                              const std::string& link, SdfDocument& document) {
  const double mass = sdf_number(inertial, "mass", 1.);
  if (mass < 0.)
    inertial.file->fail(SdfDocument::child(inertial, "mass").place(), "a mass is not negative");
  const XmlElement inertia = SdfDocument::child(inertial, "inertia");
  Symmetric3d I{1., 1., 1., 0., 0., 0.};
  if (inertia.node) {
    I = {sdf_number(inertia, "ixx", 1.), sdf_number(inertia, "iyy", 1.),
         sdf_number(inertia, "izz", 1.), sdf_number(inertia, "ixy", 0.),
         sdf_number(inertia, "ixz", 0.), sdf_number(inertia, "iyz", 0.)};
  }
  const Pose X_LC = document.pose_in_link(scope, link, inertial);
  return dts::placed({mass, {}, I}, X_LC.position, X_LC.orientation);
}

dts::MassProperties<double> mass_of_collisions(const XmlElement& of_link, SdfModel& scope,
                                               const std::string& link, SdfDocument& document) {
  const double density_of_link =
      sdf_number(SdfDocument::child(of_link, "inertial"), "density", default_density);
  std::vector<dts::MassProperties<double>> parts;
  for (const pugi::xml_node& node : of_link.node.children("collision")) {
    const XmlElement collision{node, of_link.file};
    const XmlElement geometry = SdfDocument::child(collision, "geometry");
    const auto shape = read_sdf_shape(geometry);
    if (!shape) {
      collision.file->fail(collision.place(),
                           "the mass of this collision is not computed: give the link an "
                           "<inertial> with numbers");
      continue;
    }
    const double density = positive_number(collision, "density", density_of_link);
    const Pose X_LC = document.pose_in_link(scope, link, collision);
    parts.push_back(dts::placed(uniform_solid(*shape, density), X_LC.position, X_LC.orientation));
  }
  return dts::combined(parts);
}

std::optional<ShapeGeometry> read_sdf_shape(const XmlElement& geometry) {
  const auto inside = [&](const char* name) { return SdfDocument::child(geometry, name); };
  if (const XmlElement box = inside("box"); box.node) {
    const Vector3d size = sdf_vector(box, "size", {1., 1., 1.});
    if (std::min({size.x, size.y, size.z}) > 0.) return Box{size};
    box.file->fail(box.place(), "the edges of a box are greater than 0");
    return std::nullopt;
  }
  if (const XmlElement sphere = inside("sphere"); sphere.node)
    return Sphere{positive_number(sphere, "radius", 1.)};
  if (const XmlElement rod = inside("cylinder"); rod.node)
    return Cylinder{positive_number(rod, "radius", 1.), positive_number(rod, "length", 1.)};
  if (const XmlElement capsule = inside("capsule"); capsule.node)
    return Capsule{positive_number(capsule, "radius", 0.5), positive_number(capsule, "length", 1.)};
  return std::nullopt;
}

bool sdf_touches(const XmlElement& collision) {
  const XmlElement contact =
      SdfDocument::child(SdfDocument::child(collision, "surface"), "contact");
  if (SdfDocument::flag(contact, "collide_without_contact", false)) return false;
  const std::string mask = SdfDocument::text_of(contact, "collide_bitmask");
  if (mask.empty()) return true;
  char* end = nullptr;
  constexpr int any_base = 0;  // 10, or 16 after 0x
  const unsigned long bits = std::strtoul(mask.c_str(), &end, any_base);
  if (*end == '\0') return bits != 0;
  const XmlElement element = SdfDocument::child(contact, "collide_bitmask");
  return element.file->fail(element.place(),
                            fmt::format("`{}` is no bit mask", mask.substr(0, 40)));
}

std::optional<SurfaceMaterial> read_sdf_surface(const XmlElement& collision, StatedContact counts,
                                                std::map<std::string, std::size_t>& left_out) {
  const XmlElement surface = SdfDocument::child(collision, "surface");
  if (!surface.node || counts == StatedContact::ground) return std::nullopt;
  SurfaceMaterial material;
  material.place = surface.place();
  const auto not_negative = [](const XmlElement& parent,
                               const char* name) -> std::optional<double> {
    const XmlElement element = SdfDocument::child(parent, name);
    const std::string text = SdfDocument::text_of(parent, name);
    if (text.empty()) return std::nullopt;
    return element.file->surface_constant(text, fmt::format("<{}>", name), element.place());
  };
  const XmlElement friction = SdfDocument::child(surface, "friction");
  const XmlElement ode = SdfDocument::child(friction, "ode");
  material.friction = not_negative(ode, "mu");
  if (!material.friction)
    material.friction = not_negative(SdfDocument::child(friction, "bullet"), "friction");
  if (const auto mu2 = not_negative(ode, "mu2"); mu2 && mu2 != material.friction)
    ++left_out["mu2 that is not mu"];
  for (const char* slip : {"slip1", "slip2"}) {
    if (not_negative(ode, slip).value_or(0.) > 0.) ++left_out[slip];
  }
  if (SdfDocument::child(ode, "fdir1").node) ++left_out["<fdir1>"];
  if (SdfDocument::child(friction, "torsional").node) ++left_out["<torsional> friction"];
  if (counts == StatedContact::file) {
    const XmlElement contact = SdfDocument::child(surface, "contact");
    XmlElement engine = SdfDocument::child(contact, "ode");
    if (!engine.node) engine = SdfDocument::child(contact, "bullet");
    material.stiffness = not_negative(engine, "kp");
    material.damping = not_negative(engine, "kd");
    // Gazebo adds dampings, so that 0 leaves the other side's.
    for (std::optional<double>* constant : {&material.stiffness, &material.damping}) {
      if (*constant == 0.) constant->reset();
    }
    if (not_negative(engine, "min_depth").value_or(0.) > 0.) ++left_out["min_depth"];
    const XmlElement bounce = SdfDocument::child(surface, "bounce");
    material.restitution = not_negative(bounce, "restitution_coefficient");
  }
  return material.says_nothing() ? std::nullopt : std::optional(material);
}

std::optional<SdfGround> read_sdf_ground(const XmlElement& geometry, const Pose& X_WC,
                                         const SdfDocument& document, language::FileStore& files) {
  if (const XmlElement plane = SdfDocument::child(geometry, "plane"); plane.node) {
    SdfGround ground;
    ground.place = plane.place();
    const Vector3d normal = rotate(X_WC.orientation, sdf_vector(plane, "normal", {0., 0., 1.}));
    ground.point = X_WC.position;
    if (!(norm(normal) > 0.)) {
      plane.file->fail(plane.place(), "a normal of length 0 has no direction");
      return std::nullopt;
    }
    ground.normal = (1. / norm(normal)) * normal;
    return ground;
  }
  const XmlElement heightmap = SdfDocument::child(geometry, "heightmap");
  if (!heightmap.node) return std::nullopt;
  auto ground = read_heights(heightmap, X_WC, document, files);
  if (ground) ground->place = heightmap.place();
  return ground;
}

}  // namespace hookpoint::simulation
