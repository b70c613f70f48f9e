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

std::string without_blanks(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
}

/// "a::b::c" as "a" and "b::c".
std::pair<std::string_view, std::string_view> split_name(std::string_view name) {
  const std::size_t colons = name.find("::");
  if (colons == std::string_view::npos) return {name, ""};
  return {name.substr(0, colons), name.substr(colons + 2)};
}

}  // namespace

SdfDocument::SdfDocument(const language::SourceFile& file, language::FileStore& files,
                         language::Report& report)
    : file_(file), files_(files), report_(report) {}

XmlElement SdfDocument::child(const XmlElement& parent, const char* name) {
  return {parent.node.child(name), parent.file};
}

std::string SdfDocument::text_of(const XmlElement& parent, const char* name) {
  return without_blanks(parent.node.child(name).text().get());
}

bool SdfDocument::flag(const XmlElement& parent, const char* name, bool otherwise) {
  const std::string text = text_of(parent, name);
  return text == "true" || text == "1" || (text.empty() && otherwise);
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
  const std::string text = root.text("version");
  int major = 0, minor = 0;
  const char* const end = text.data() + text.size();
  const auto [dot, wrong] = std::from_chars(text.data(), end, major);
  if (wrong == std::errc() && dot != end && *dot == '.') std::from_chars(dot + 1, end, minor);
  constexpr int oldest = 2, newest = 12;
  if (major != 1 || minor < oldest || minor > newest)
    root.file->fail(
        root.place("version"),
        fmt::format("SDFormat 1.{} to 1.{} is read, not version \"{}\"", oldest, newest, text));
  return 1000 * major + minor;
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
      // A file may hold a model alone, which stands in the world that holds nothing else.
      if (&model == &world_ && tag != "frame") continue;
      const std::string name = element.file->name_of(node);
      if (tag == "link") model.links.push_back(name);
      add_frame(model, name, {element, nullptr, {}, false});
    }
  }
}

void SdfDocument::add_frame(SdfModel& model, const std::string& name, SdfFrame frame) {
  const XmlElement element = frame.element;
  if (name.empty() || model.frames.emplace(name, std::move(frame)).second) return;
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
    const std::vector<fs::path> places = mesh_places(name, path_of(at), files_.search_path());
    std::error_code ignored;
    const auto found = std::ranges::find_if(
        places, [&](const fs::path& path) { return fs::is_regular_file(path, ignored); });
    return found == places.end() ? fs::path() : found->lexically_normal();
  };
  const std::string folder = uri.ends_with('/') ? uri.substr(0, uri.size() - 1) : uri;
  if (const fs::path manifest = find(folder + "/model.config"); !manifest.empty()) {
    // It lists a file for each version of the format, the newest last.
    pugi::xml_document config;
    config.load_file(manifest.c_str());
    std::string name;
    for (const pugi::xml_node& sdf : config.child("model").children("sdf"))
      name = without_blanks(sdf.text().get());
    const fs::path file = manifest.parent_path() / name;
    std::error_code ignored;
    if (!name.empty() && fs::is_regular_file(file, ignored)) return file;
  }
  const fs::path in_folder = find(folder + "/model.sdf");
  return in_folder.empty() ? find(uri) : in_folder;
}

XmlElement SdfDocument::open_file(const fs::path& path, const XmlElement& from, int& version) {
  const language::SourceFile& source = files_.load(path).source;
  auto& xml = open_files_.emplace_back(std::make_unique<UrdfXml>(source, report_));
  paths_[xml.get()] = path;
  report_.enter_include(source, from.place());
  const XmlElement root{xml->open({"sdf", "gazebo"}, "SDF"), xml.get()};
  XmlElement model;
  if (root.node) {
    version = version_of(root);
    model = child(root, "model");
    if (!model.node) xml->fail(root.place(), "a file that is included holds a <model>");
  }
  report_.leave_include();
  return model;
}

void SdfDocument::add_included(SdfModel& outer, const XmlElement& include, std::size_t depth) {
  const XmlElement uri = child(include, "uri");
  const std::string name = text_of(include, "uri");
  const auto fail = [&](const std::string& message) {
    include.file->fail(uri.node ? uri.place() : include.place(), message);
  };
  if (name.empty()) return fail("<include> lacks <uri>");
  if (include.text("merge") == "true" || include.text("merge") == "1")
    return fail("<include merge=\"true\"> is not read: write the model's links in this one");
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
  if (++included_ > most_models) return fail(fmt::format("more than {} models", most_models));
  including_.push_back(canonical);
  int version = 0;
  if (const XmlElement model = open_file(path, include, version); model.node)
    add_model(outer, model, include, version, depth);
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
  const std::string degrees = pose.text("degrees");
  const double unit = degrees == "true" || degrees == "1" ? degree : 1.;
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
  if (name.empty() || name == "__model__" || name == "__root__" || name == "world") return {};
  const auto [first, rest] = split_name(name);
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
    // A pose of the <include> is relative to frames here, the model's own to those of its file.
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
  const auto [first, rest] = split_name(name);
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
