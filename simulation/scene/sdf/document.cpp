#include "simulation/scene/sdf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "language/names.h"
#include "math/rotation.h"
#include "simulation/scene/urdf/mesh_path.h"

namespace hookpoint::simulation {
namespace {

namespace fs = std::filesystem;

/// Includes and models in models.
constexpr std::size_t most_models = 10000;

constexpr int oldest = 1002, newest = 1012;
/// 1007 of "1.7"; 0 of what is no version that is read.
int version_in(const std::string& text) {
  int major = 0, minor = 0;
  const char* const end = text.data() + text.size();
  const auto [dot, wrong] = std::from_chars(text.data(), end, major);
  if (wrong == std::errc() && dot != end && *dot == '.') std::from_chars(dot + 1, end, minor);
  const int version = 1000 * major + minor;
  return version < oldest || version > newest ? 0 : version;
}

/// "a::b::c" as "a" and "b::c", unless something is called so altogether.
std::pair<std::string_view, std::string_view> split_name(const SdfModel& scope,
                                                         std::string_view name) {
  const std::size_t colons = name.find("::");
  if (colons == std::string_view::npos || scope.frames.contains(std::string(name)))
    return {name, ""};
  return {name.substr(0, colons), name.substr(colons + 2)};
}

/// Whether a text is `word`, in letters of any size.
bool is_word(std::string_view text, std::string_view word) {
  return std::ranges::equal(text, word, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

}  // namespace

SdfDocument::SdfDocument(const language::SourceFile& file, language::FileStore& files,
                         language::Report& report)
    : file_(file), files_(files), report_(report) {}

XmlElement SdfDocument::child(const XmlElement& parent, const char* name) {
  return {parent.node.child(name), parent.file};
}

std::string SdfDocument::text_of(const XmlElement& parent, const char* name) {
  return UrdfXml::text_in(parent.node.child(name));
}

bool SdfDocument::flag(const XmlElement& parent, const char* name, bool otherwise) {
  const std::string text = text_of(parent, name);
  if (text.empty()) return otherwise;
  const bool yes = is_word(text, "true") || text == "1";
  if (!yes && !is_word(text, "false") && text != "0")
    parent.file->fail(child(parent, name).place(), fmt::format("<{}> is true or false", name));
  return yes;
}

bool SdfDocument::flag_attribute(const XmlElement& of, const char* name) {
  const std::string text = of.text(name);
  return is_word(text, "true") || text == "1";
}

bool SdfDocument::good() const {
  return std::ranges::all_of(open_files_, [](const auto& file) { return file->good(); });
}

const fs::path& SdfDocument::path_of(const XmlElement& element) const {
  return paths_.at(element.file);
}

bool SdfDocument::open() {
  auto& xml = open_files_.emplace_back(std::make_unique<UrdfXml>(file_, report_));
  paths_[xml.get()] = file_.path;
  std::error_code ignored;
  including_.push_back(fs::weakly_canonical(file_.path, ignored).string());
  root_ = {xml->open({"sdf", "gazebo"}, "SDF"), xml.get()};
  if (!root_.node) return false;
  const int version = version_of(root_);
  XmlElement holder = root_;
  if (const XmlElement world = child(root_, "world"); world.node) {
    if (const pugi::xml_node second = world.node.next_sibling("world"))
      xml->fail(xml->place(second), "a second <world>: one at a time is read");
    holder = world;
  }
  world_.element = holder;
  world_.version = version;
  read_contents(world_, 0);
  return good();
}

int SdfDocument::version_of(const XmlElement& root) {
  const int version = version_in(root.text("version"));
  if (version == 0)
    root.file->fail(root.place("version"),
                    fmt::format("SDFormat 1.{} to 1.{} is read, not version \"{}\"", oldest - 1000,
                                newest - 1000, root.text("version")));
  return version;
}

void SdfDocument::read_contents(SdfModel& model, std::size_t depth) {
  if (depth > deepest) {
    model.element.file->fail(model.element.place(),
                             fmt::format("models stand in each other {} deep", depth));
    return;
  }
  for (const pugi::xml_node& node : model.element.node.children()) {
    if (report_.full()) return;
    const XmlElement element{node, model.element.file};
    const std::string_view tag = element.tag();
    if (tag == "model") {
      add_model(model, element, element, model.version, depth);
    } else if (tag == "include") {
      add_included(model, element, depth);
    } else if (tag == "link" || tag == "joint" || tag == "frame") {
      if (&model == &world_ && tag == "joint")
        element.file->fail(element.place(),
                           "a joint of the world is not read: write it in a model");
      if (&model == &world_ && tag != "frame") continue;
      const std::string name = element.file->name_of(node);
      if (tag == "link") model.links.push_back(name);
      add_frame(model, name, {element, nullptr, {}, false});
    }
  }
}

void SdfDocument::add_frame(SdfModel& model, const std::string& name, SdfFrame frame) {
  const XmlElement element = frame.element;
  if (name == "world" || name.starts_with("__")) {
    element.file->fail(element.place(), fmt::format("the name `{}` is SDFormat's own", name));
    return;
  }
  const bool is_joint = element.tag() == "joint";
  if (name.empty() || model.frames.emplace(name, std::move(frame)).second) return;
  // Before 1.7 nothing could refer to a joint's frame, and a joint was often called like its link.
  constexpr int names_are_unique = 1007;
  if (model.version < names_are_unique && is_joint && model.joints.insert(name).second) return;
  element.file->fail(element.place("name"), fmt::format("a second `{}` in this model", name));
  const XmlElement& first = model.frames.at(name).element;
  element.file->note(first.place(), "the first is here");
}

void SdfDocument::add_model(SdfModel& outer, const XmlElement& element, const XmlElement& placed_by,
                            int version, std::size_t depth) {
  if (++included_ > most_models) {
    element.file->fail(element.place(), fmt::format("more than {} models", most_models));
    return;
  }
  std::string name = text_of(placed_by, "name");
  if (placed_by.tag() != "include" || name.empty()) name = element.file->name_of(element.node);
  auto model = std::make_unique<SdfModel>();
  model->own_name = name;
  model->name = outer.name.empty() ? name : outer.name + "::" + name;
  model->element = element;
  model->placed_by = child(placed_by, "pose").node ? placed_by : element;
  model->outer = &outer;
  model->version = version;
  model->is_static = outer.is_static || flag(element, "static", false);
  model->placement_frame = element.text("placement_frame");
  if (placed_by.tag() == "include") {
    model->is_static = outer.is_static || flag(placed_by, "static", model->is_static);
    if (const std::string frame = text_of(placed_by, "placement_frame"); !frame.empty())
      model->placement_frame = frame;
  }
  add_frame(outer, name, {placed_by, model.get(), {}, false});
  SdfModel& added = *outer.models.emplace_back(std::move(model));
  read_contents(added, depth + 1);
}

std::filesystem::path SdfDocument::find_model(const std::string& uri, const XmlElement& at) {
  const auto find = [&](const std::string& name) {
    return first_file(model_places(name, path_of(at), files_.search_path()));
  };
  const std::string folder = uri.ends_with('/') ? uri.substr(0, uri.size() - 1) : uri;
  if (const fs::path manifest = find(folder + "/model.config"); !manifest.empty()) {
    // It lists a file for each version of the format: the newest one that is read.
    pugi::xml_document config;
    config.load_file(manifest.c_str());
    std::string name;
    int version = 0;
    for (const pugi::xml_node& sdf : config.child("model").children("sdf")) {
      const std::string written = sdf.attribute("version").value();
      const int listed = written.empty() ? oldest : version_in(written);
      if (listed <= version) continue;
      version = listed;
      name = UrdfXml::text_in(sdf);
    }
    const fs::path file = name.empty() ? fs::path() : first_file({manifest.parent_path() / name});
    if (!file.empty()) return file;
  }
  const fs::path in_folder = find(folder + "/model.sdf");
  return in_folder.empty() ? find(uri) : in_folder;
}

const SdfDocument::Opened& SdfDocument::open_file(const fs::path& path) {
  const auto [found, is_new] = opened_.try_emplace(path.string());
  Opened& opened = found->second;
  if (!is_new) return opened;
  const language::SourceFile& source = files_.load(path).source;
  auto& xml = open_files_.emplace_back(std::make_unique<UrdfXml>(source, report_));
  paths_[xml.get()] = path;
  const XmlElement root{xml->open({"sdf", "gazebo"}, "SDF"), xml.get()};
  if (!root.node) return opened;
  opened.version = version_of(root);
  opened.model = child(root, "model");
  opened.is_light = !opened.model.node && (child(root, "light").node || child(root, "actor").node);
  if (!opened.model.node && !opened.is_light)
    xml->fail(root.place(), "a file that is included holds a <model>");
  return opened;
}

void SdfDocument::add_included(SdfModel& outer, const XmlElement& include, std::size_t depth) {
  const XmlElement uri = child(include, "uri");
  const std::string name = text_of(include, "uri");
  const auto fail = [&](const std::string& message) {
    include.file->fail(uri.node ? uri.place() : include.place(), message);
  };
  if (name.empty()) return fail("<include> lacks <uri>");
  if (flag_attribute(include, "merge"))
    return fail("<include merge=\"true\"> is not read: write the model's links in this one");
  if (child(include, "experimental:params").node)
    return fail("<experimental:params> is not read: change the model in a file of its own");
  if (name.starts_with("http://") || name.starts_with("https://"))
    return fail(fmt::format("`{}` lies on a server: fetch it, and name its folder here",
                            name.substr(0, 100)));
  const fs::path path = find_model(name, include);
  if (path.empty())
    return fail(
        fmt::format("there is no model `{}` beside this file, in a folder above it or in "
                    "HOOKPOINT_PATH",
                    name.substr(0, 100)));
  std::error_code ignored;
  const std::string canonical = fs::weakly_canonical(path, ignored).string();
  if (std::ranges::count(including_, canonical) > 0)
    return fail(fmt::format("`{}` includes itself", name));
  including_.push_back(canonical);
  report_.enter_include(files_.load(path).source, include.place());
  const Opened& opened = open_file(path);
  if (opened.model.node) add_model(outer, opened.model, include, opened.version, depth);
  if (opened.is_light) ++lights_;
  report_.leave_include();
  including_.pop_back();
}

// ------------------------------------------------------------------------------------ frames

Pose SdfDocument::written_pose(const XmlElement& pose) {
  const bool quaternion = pose.text("rotation_format") == "quat_xyzw";
  const std::size_t count = quaternion ? 7 : 6;
  const std::size_t before = pose.file->errors();
  const std::vector<double> x = pose.file->content_numbers(pose.node, count);
  if (x.empty() || pose.file->errors() != before) return {};
  if (x.size() != count) {
    pose.file->fail(pose.place(), quaternion ? "<pose> takes seven numbers: x y z, qx qy qz qw"
                                             : "<pose> takes six numbers: x y z, roll pitch yaw");
    return {};
  }
  const Vector3d position{x[0], x[1], x[2]};
  if (quaternion) {
    const Quaterniond q{x[6], x[3], x[4], x[5]};
    if (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z > 0.) return {position, normalized(q)};
    pose.file->fail(pose.place(), "a quaternion of length 0 is no orientation");
    return {};
  }
  constexpr double degree = 0.017453292519943295;
  const double unit = flag_attribute(pose, "degrees") ? degree : 1.;
  return {position, from_roll_pitch_yaw(unit * x[3], unit * x[4], unit * x[5])};
}

Pose SdfDocument::pose_of_element(SdfModel& scope, const XmlElement& element,
                                  const std::string& otherwise, std::size_t depth) {
  const XmlElement pose = child(element, "pose");
  if (!pose.node) return pose_of(scope, otherwise, element, depth);
  // Up to 1.6 the attribute was called `frame`.
  std::string relative_to = pose.text("relative_to");
  if (relative_to.empty()) relative_to = pose.text("frame");
  if (relative_to.empty()) relative_to = otherwise;
  return pose_of(scope, relative_to, pose, depth) * written_pose(pose);
}

Pose SdfDocument::pose_in_link(SdfModel& scope, const std::string& link,
                               const XmlElement& element) {
  const Pose X = pose_of_element(scope, element, "");
  const XmlElement pose = child(element, "pose");
  if (pose.text("relative_to").empty() && pose.text("frame").empty()) return X;
  return inverse(pose_of(scope, link, element)) * X;
}

SdfFrame* SdfDocument::find_frame(SdfModel& scope, std::string_view name, const XmlElement& from) {
  const auto found = scope.frames.find(std::string(name));
  if (found != scope.frames.end()) return &found->second;
  std::vector<std::string> names;
  constexpr std::size_t most_names = 1000;
  for (const auto& [known, frame] : scope.frames) {
    if (names.size() < most_names) names.push_back(known);
  }
  std::ranges::sort(names);
  const std::string nearest = language::nearest_name(std::string(name), names);
  from.file->fail(
      from.place(),
      fmt::format("there is no link, joint, frame or model `{}` here{}", name.substr(0, 100),
                  nearest.empty() ? "" : "; did you mean `" + nearest + "`?"));
  return nullptr;
}

Pose SdfDocument::pose_of(SdfModel& scope, std::string_view name, const XmlElement& from,
                          std::size_t depth) {
  if (name.empty() || name == "__model__") return {};
  if (&scope == &world_ && (name == "__root__" || name == "world")) return {};
  const auto [first, rest] = split_name(scope, name);
  SdfFrame* const frame = find_frame(scope, first, from);
  if (frame == nullptr) return {};
  const Pose X_SF = frame_pose(scope, std::string(first), *frame, depth + 1);
  if (rest.empty()) return X_SF;
  if (frame->model != nullptr) return X_SF * pose_of(*frame->model, rest, from, depth + 1);
  from.file->fail(from.place(), fmt::format("`{}` is no model", first));
  return {};
}

Pose SdfDocument::frame_pose(SdfModel& scope, const std::string& name, SdfFrame& frame,
                             std::size_t depth) {
  if (frame.known) return *frame.known;
  const XmlElement& element = frame.element;
  constexpr std::size_t longest = 1000;
  if (frame.visiting || depth > longest) {
    element.file->fail(element.place(),
                       frame.visiting ? fmt::format("the pose of `{}` is relative to itself", name)
                                      : fmt::format("`{}` stands on frames {} deep", name, depth));
    frame.known = Pose{};
    return {};
  }
  frame.visiting = true;
  Pose X_SF;
  if (frame.model != nullptr) {
    SdfModel& model = *frame.model;
    // Whether the <include> or the model gives it, the pose is relative to frames here.
    X_SF = pose_of_element(scope, model.placed_by, "", depth);
    if (!model.placement_frame.empty())
      X_SF = X_SF * inverse(pose_of(model, model.placement_frame, element, depth));
  } else if (element.tag() == "joint") {
    X_SF = pose_of_element(scope, element, text_of(element, "child"), depth);
  } else if (element.tag() == "frame") {
    X_SF = pose_of_element(scope, element, element.text("attached_to"), depth);
  } else {
    X_SF = pose_of_element(scope, element, "", depth);
  }
  frame.visiting = false;
  frame.known = X_SF;
  return X_SF;
}

SdfDocument::LinkName SdfDocument::link_of(SdfModel& scope, std::string_view name,
                                           const XmlElement& from, std::size_t depth) {
  constexpr std::size_t longest = 1000;
  if (depth > longest) {
    from.file->fail(from.place(), "frames are attached to each other in a circle");
    return {};
  }
  if (name == "world") return {&world_, "world"};
  if (name.empty() || name == "__model__") {
    // The model's canonical link: the one that it names, or its first.
    if (&scope == &world_) return {&world_, "world"};
    const std::string canonical = scope.element.text("canonical_link");
    if (!canonical.empty()) return link_of(scope, canonical, scope.element, depth + 1);
    if (!scope.links.empty()) return {&scope, scope.links.front()};
    if (!scope.models.empty()) return link_of(*scope.models.front(), "", from, depth + 1);
    from.file->fail(from.place(), "this model has no link");
    return {};
  }
  const auto [first, rest] = split_name(scope, name);
  SdfFrame* const frame = find_frame(scope, first, from);
  if (frame == nullptr) return {};
  if (frame->model != nullptr) return link_of(*frame->model, rest, from, depth + 1);
  if (!rest.empty()) {
    from.file->fail(from.place(), fmt::format("`{}` is no model", first));
    return {};
  }
  const XmlElement& element = frame->element;
  if (element.tag() == "link") return {&scope, std::string(first)};
  if (element.tag() == "joint")
    return link_of(scope, text_of(element, "child"), element, depth + 1);
  return link_of(scope, element.text("attached_to"), element, depth + 1);
}

}  // namespace hookpoint::simulation
