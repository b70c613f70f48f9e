#include "output/records/foxglove.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "text/json.h"
#include "text/number.h"

namespace hookpoint::output::foxglove {
namespace {

// Schemas. Each function writes the schema of a property, `title` being Foxglove's name of a type.

struct Property {
  std::string_view name;
  std::string schema;
};

std::string of_type(std::string_view type) { return R"({"type":")" + std::string(type) + "\"}"; }

std::string object_of(std::string_view title, std::initializer_list<Property> properties) {
  std::string schema = R"({"type":"object","title":")" + std::string(title) + R"(","properties":{)";
  std::string required;
  for (const Property& property : properties) {
    if (!required.empty()) {
      schema += ',';
      required += ',';
    }
    schema.append("\"").append(property.name).append("\":").append(property.schema);
    required.append("\"").append(property.name).append("\"");
  }
  return schema + R"(},"required":[)" + required + "]}";
}

std::string list_of(const std::string& items) {
  return R"({"type":"array","items":)" + items + "}";
}

/// Of a list that is always empty: what would be in it is not told.
std::string empty_list() { return list_of(R"({"type":"object","properties":{}})"); }

std::string time_schema(std::string_view title) {
  return object_of(title, {{"sec", of_type("integer")}, {"nsec", of_type("integer")}});
}

std::string numbers_schema(std::string_view title, std::string_view letters) {
  const std::string number = of_type("number");
  if (letters == "xyz") return object_of(title, {{"x", number}, {"y", number}, {"z", number}});
  return object_of(title, {{letters.substr(0, 1), number},
                           {letters.substr(1, 1), number},
                           {letters.substr(2, 1), number},
                           {letters.substr(3, 1), number}});
}

std::string vector_schema() { return numbers_schema("foxglove.Vector3", "xyz"); }
std::string quaternion_schema() { return numbers_schema("foxglove.Quaternion", "xyzw"); }
std::string color_schema() { return numbers_schema("foxglove.Color", "rgba"); }
std::string pose_schema() {
  return object_of("foxglove.Pose",
                   {{"position", vector_schema()}, {"orientation", quaternion_schema()}});
}

std::string entity_schema() {
  const std::string metadata = object_of(
      "foxglove.KeyValuePair", {{"key", of_type("string")}, {"value", of_type("string")}});
  const std::string cube =
      object_of("foxglove.CubePrimitive",
                {{"pose", pose_schema()}, {"size", vector_schema()}, {"color", color_schema()}});
  const std::string sphere =
      object_of("foxglove.SpherePrimitive",
                {{"pose", pose_schema()}, {"size", vector_schema()}, {"color", color_schema()}});
  const std::string cylinder =
      object_of("foxglove.CylinderPrimitive", {{"pose", pose_schema()},
                                               {"size", vector_schema()},
                                               {"bottom_scale", of_type("number")},
                                               {"top_scale", of_type("number")},
                                               {"color", color_schema()}});
  const std::string triangles =
      object_of("foxglove.TriangleListPrimitive",
                {{"pose", pose_schema()},
                 {"points", list_of(numbers_schema("foxglove.Point3", "xyz"))},
                 {"color", color_schema()},
                 {"colors", list_of(color_schema())},
                 {"indices", list_of(of_type("integer"))}});
  return object_of("foxglove.SceneEntity", {{"timestamp", time_schema("time")},
                                            {"frame_id", of_type("string")},
                                            {"id", of_type("string")},
                                            {"lifetime", time_schema("duration")},
                                            {"frame_locked", of_type("boolean")},
                                            {"metadata", list_of(metadata)},
                                            {"arrows", empty_list()},
                                            {"cubes", list_of(cube)},
                                            {"spheres", list_of(sphere)},
                                            {"cylinders", list_of(cylinder)},
                                            {"lines", empty_list()},
                                            {"triangles", list_of(triangles)},
                                            {"texts", empty_list()},
                                            {"models", empty_list()}});
}

// Messages.

template <class Integer>
void append_whole(std::string& text, Integer value) {
  std::array<char, 24> digits;
  text.append(digits.data(),
              std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

void append_time(std::string& text, std::uint64_t time) {
  text += R"({"timestamp":{"sec":)";
  append_whole(text, time / 1'000'000'000U);
  text += R"(,"nsec":)";
  append_whole(text, time % 1'000'000'000U);
  text += '}';
}

/// Bytes of what append_time writes, and of a number, at most.
constexpr std::size_t longest_time = 64, longest_number = 24;

void append_members(std::string& text,
                    std::initializer_list<std::pair<std::string_view, double>> members) {
  char before = '{';
  for (const auto& [name, value] : members) {
    text.append(1, before).append("\"").append(name).append("\":");
    text::append_shortest(text, value);
    before = ',';
  }
  text += '}';
}
void append_vector(std::string& text, const Vector3d& a) {
  append_members(text, {{"x", a.x}, {"y", a.y}, {"z", a.z}});
}
void append_quaternion(std::string& text, const Quaterniond& q) {
  append_members(text, {{"x", q.x}, {"y", q.y}, {"z", q.z}, {"w", q.w}});
}

struct Color {
  double red = 0., green = 0., blue = 0.;
};
/// Of bodies in turn, so that the links of a chain stand out from one another: two blues of Okabe
/// and Ito's palette.
constexpr std::array<Color, 2> body_colors{{{0., 0.447, 0.698}, {0.337, 0.706, 0.914}}};
/// Of materials in turn: quiet, and of unlike lightness.
constexpr std::array<Color, 6> ground_colors{{{0.78, 0.75, 0.69},
                                              {0.56, 0.63, 0.56},
                                              {0.69, 0.57, 0.53},
                                              {0.60, 0.66, 0.74},
                                              {0.86, 0.82, 0.62},
                                              {0.47, 0.46, 0.49}}};

void append_color(std::string& text, const Color& color) {
  text += R"(,"color":)";
  append_members(text, {{"r", color.red}, {"g", color.green}, {"b", color.blue}, {"a", 1.}});
}

void append_pose(std::string& text, const Vector3d& position, const Quaterniond& orientation) {
  text += R"({"pose":{"position":)";
  append_vector(text, position);
  text += R"(,"orientation":)";
  append_quaternion(text, orientation);
  text += '}';
}

/// Vertices, colour and triangles of a triangle list whose pose stands already.
template <class Mesh>
void append_triangles(std::string& list, const Mesh& mesh, const Color& color) {
  list += R"(,"points":[)";
  for (const Vector3d& vertex : mesh.vertices) {
    if (list.back() != '[') list += ',';
    append_vector(list, vertex);
  }
  list += ']';
  append_color(list, color);
  list += R"(,"colors":[],"indices":[)";
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      if (list.back() != '[') list += ',';
      append_whole(list, vertex);
    }
  }
  list += "]}";
}

/// The lists of an entity that has something in them, each with commas between its items.
struct Primitives {
  std::string cubes, spheres, cylinders, triangles;
};

void append_shape(Primitives& primitives, const SceneShape& shape, const Color& color) {
  const auto begin = [&](std::string& list, const Vector3d& size) -> std::string& {
    if (!list.empty()) list += ',';
    append_pose(list, shape.location, shape.orientation);
    list += R"(,"size":)";
    append_vector(list, size);
    return list;
  };
  if (const auto* box = std::get_if<SceneBox>(&shape.geometry)) {
    std::string& list = begin(primitives.cubes, box->dimensions);
    append_color(list, color);
    list += '}';
  } else if (const auto* sphere = std::get_if<SceneSphere>(&shape.geometry)) {
    const double diameter = 2. * sphere->radius;
    std::string& list = begin(primitives.spheres, {diameter, diameter, diameter});
    append_color(list, color);
    list += '}';
  } else if (const auto* mesh = std::get_if<SceneMesh>(&shape.geometry)) {
    std::string& list = primitives.triangles;
    if (!list.empty()) list += ',';
    append_pose(list, shape.location, shape.orientation);
    append_triangles(list, *mesh, color);
  } else {
    const auto& cone = std::get<SceneCone>(shape.geometry);
    const double radius = std::max(cone.bottom_radius, cone.top_radius);
    const auto scale = [radius](double end) { return radius > 0. ? end / radius : 1.; };
    std::string& list = begin(primitives.cylinders, {2. * radius, 2. * radius, cone.length});
    list += R"(,"bottom_scale":)";
    text::append_shortest(list, scale(cone.bottom_radius));
    list += R"(,"top_scale":)";
    text::append_shortest(list, scale(cone.top_radius));
    append_color(list, color);
    list += '}';
  }
}

void append_surface(Primitives& primitives, const SceneSurface& surface, const Color& color) {
  std::string& list = primitives.triangles;
  append_pose(list, {}, {});
  append_triangles(list, surface, color);
}

/// An entity after its timestamp. It stays until another takes its id, and moves with its frame.
std::string entity(std::string_view frame, const std::string& id, const std::string& metadata,
                   const Primitives& primitives) {
  return R"(,"frame_id":)" + text::json_string(frame) + R"(,"id":)" + text::json_string(id) +
         R"(,"lifetime":{"sec":0,"nsec":0},"frame_locked":true,"metadata":[)" + metadata +
         R"(],"arrows":[],"cubes":[)" + primitives.cubes + R"(],"spheres":[)" + primitives.spheres +
         R"(],"cylinders":[)" + primitives.cylinders + R"(],"lines":[],"triangles":[)" +
         primitives.triangles + R"(],"texts":[],"models":[]})";
}

}  // namespace

std::string frame_transforms_schema() {
  const std::string transform =
      object_of("foxglove.FrameTransform", {{"timestamp", time_schema("time")},
                                            {"parent_frame_id", of_type("string")},
                                            {"child_frame_id", of_type("string")},
                                            {"translation", vector_schema()},
                                            {"rotation", quaternion_schema()}});
  return object_of("foxglove.FrameTransforms", {{"transforms", list_of(transform)}});
}

std::string scene_update_schema() {
  return object_of("foxglove.SceneUpdate",
                   {{"deletions", empty_list()}, {"entities", list_of(entity_schema())}});
}

FrameTransforms::FrameTransforms(std::span<const SceneBody> bodies) {
  longest_ = 32;
  for (const SceneBody& body : bodies) {
    frames_.push_back(R"(,"parent_frame_id":)" + text::json_string(world_frame) +
                      R"(,"child_frame_id":)" + text::json_string(body.name));
    longest_ += longest_time + frames_.back().size() + numbers_of_pose * longest_number + 80;
  }
}

void FrameTransforms::append(std::string& text, std::uint64_t time,
                             std::span<const double> poses) const {
  text += R"({"transforms":[)";
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const std::span<const double> pose = poses.subspan(i * numbers_of_pose, numbers_of_pose);
    if (!std::ranges::all_of(pose, [](double number) { return std::isfinite(number); })) continue;
    if (text.back() != '[') text += ',';
    append_time(text, time);
    text += frames_[i];
    text += R"(,"translation":)";
    append_vector(text, {pose[0], pose[1], pose[2]});
    text += R"(,"rotation":)";
    append_quaternion(text, {pose[3], pose[4], pose[5], pose[6]});
    text += '}';
  }
  text += "]}";
}

SceneUpdate::SceneUpdate(const Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    if (body.shapes.empty()) continue;
    Primitives primitives;
    for (const SceneShape& shape : body.shapes)
      append_shape(primitives, shape, body_colors[i % body_colors.size()]);
    entities_.push_back(entity(body.name, body.name, "", primitives));
  }
  for (std::size_t i = 0; i < scene.ground.size(); ++i) {
    const SceneSurface& surface = scene.ground[i];
    Primitives primitives;
    append_surface(primitives, surface, ground_colors[i % ground_colors.size()]);
    entities_.push_back(entity(
        surface.frame.empty() ? world_frame : surface.frame,
        surface.name + "[" + std::to_string(i) + "]",
        R"({"key":"material","value":)" + text::json_string(surface.material) + "}", primitives));
  }
  longest_ = 64;
  for (const std::string& entity : entities_) longest_ += longest_time + entity.size() + 1;
}

void SceneUpdate::append(std::string& text, std::uint64_t time) const {
  text += R"({"deletions":[],"entities":[)";
  for (const std::string& entity : entities_) {
    if (text.back() != '[') text += ',';
    append_time(text, time);
    text += entity;
  }
  text += "]}";
}

}  // namespace hookpoint::output::foxglove
