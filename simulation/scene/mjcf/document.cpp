#include "simulation/scene/mjcf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>

#include "math/rotation.h"
#include "simulation/scene/mjcf/vocabulary.h"
#include "simulation/scene/urdf/urdf.h"

namespace hookpoint::simulation {
namespace {

/// Turns by `angle` about the axis x, y or z.
Quaterniond turn_about(char axis, double angle) {
  return exponential(
      Vector3d{axis == 'x' ? angle : 0., axis == 'y' ? angle : 0., axis == 'z' ? angle : 0.});
}

/// The number of a word, infinite if it is beyond all that a file may have; nothing for no number.
std::optional<double> bounding_number(std::string_view word) {
  constexpr double largest = 1e12;
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  if (!whole || std::isnan(value)) return std::nullopt;
  const double endless = std::copysign(std::numeric_limits<double>::infinity(), value);
  return std::abs(value) > largest ? endless : value;
}

/// The numbers of a range as the element has them, none after an error.
std::vector<double> range_numbers(const XmlElement& element, const char* attribute) {
  constexpr std::size_t most = 2;
  std::istringstream words(element.text(attribute));
  std::vector<double> found;
  for (std::string word; words >> word;) {
    const std::optional<double> number = bounding_number(word);
    if (!number) break;
    found.push_back(*number);
  }
  const bool open = std::ranges::any_of(found, [](double x) { return std::isinf(x); });
  // What is wrong with them is found where numbers are read.
  if (!open || !words.eof() || found.size() > most)
    return element.file->numbers(element.node, attribute, most);
  return found;
}

/// The notation of an element's own orientation, "" without one.
std::string own_orientation(const XmlElement& element) {
  constexpr std::array notations{"quat", "axisangle", "xyaxes", "zaxis", "euler"};
  std::string found;
  for (const char* notation : notations) {
    if (!element.node.attribute(notation)) continue;
    if (!found.empty())
      element.file->fail(
          element.place(notation),
          fmt::format("<{}> has an orientation already, {}: one is allowed", element.tag(), found));
    found = notation;
  }
  return found;
}

}  // namespace

// ---------------------------------------------------------------------------------- attributes

std::vector<XmlElement> MjcfAttributes::levels() const {
  std::vector<XmlElement> all(defaults_.rbegin(), defaults_.rend());
  all.push_back(own_);
  return all;
}

std::array<double, 2> MjcfAttributes::ends(const char* attribute) const {
  std::array<double, 2> found{0., 0.};
  for (const XmlElement& level : levels())
    std::ranges::copy(range_numbers(level, attribute), found.begin());
  return found;
}

std::string MjcfAttributes::orientation() const {
  const std::string own = own_orientation(own_);
  if (!own.empty() && own != "quat") return own;
  for (const XmlElement& level : defaults_) {
    const std::string other = own_orientation(level);
    if (!other.empty() && other != "quat") return other;
  }
  return has("quat") ? "quat" : "";
}

const XmlElement* MjcfAttributes::find(const char* attribute) const {
  if (own_.node.attribute(attribute)) return &own_;
  const auto found = std::ranges::find_if(defaults_, [&](const XmlElement& element) {
    return static_cast<bool>(element.node.attribute(attribute));
  });
  return found == defaults_.end() ? nullptr : &*found;
}

std::string MjcfAttributes::word(const char* attribute) const {
  const XmlElement* element = find(attribute);
  return element == nullptr ? "" : element->text(attribute);
}

std::vector<double> MjcfAttributes::numbers(const char* attribute,
                                            std::vector<double> otherwise) const {
  for (const XmlElement& level : levels())
    std::ranges::copy(level.file->numbers(level.node, attribute, otherwise.size()),
                      otherwise.begin());
  return otherwise;
}

double MjcfAttributes::number(const char* attribute, double otherwise) const {
  return numbers(attribute, {otherwise})[0];
}

Vector3d MjcfAttributes::vector(const char* attribute, const Vector3d& otherwise) const {
  const auto found = numbers(attribute, {otherwise.x, otherwise.y, otherwise.z});
  return {found[0], found[1], found[2]};
}

bool MjcfAttributes::boolean(const char* attribute, bool otherwise) const {
  const std::string given = word(attribute);
  return given == "true" || (given != "false" && otherwise);
}

language::Position MjcfAttributes::place(const char* attribute) const {
  const XmlElement* element = find(attribute);
  return element == nullptr ? own_.place() : element->place(attribute);
}

bool MjcfAttributes::fail(const char* attribute, const std::string& message) const {
  return own_.file->fail(place(attribute), message);
}

// ------------------------------------------------------------------------------------ document

MjcfDocument::MjcfDocument(const language::SourceFile& file, language::FileStore& files,
                           language::Report& report)
    : file_(file), files_(files), report_(report) {}

bool MjcfDocument::open() {
  auto& xml = open_files_.emplace_back(std::make_unique<UrdfXml>(file_, report_));
  sources_[xml.get()] = &file_;
  std::error_code ignored;
  paths_.insert(std::filesystem::weakly_canonical(file_.path, ignored).string());
  root_ = {xml->open({"mujoco", "mujocoinclude"}, "MJCF"), xml.get()};
  if (!root_.node) return false;
  for (const XmlElement& section : children(root_)) {
    if (section.tag() == "default") read_defaults(section, "", 0);
  }
  read_compiler();
  return good();
}

bool MjcfDocument::good() const {
  return std::ranges::all_of(open_files_, [](const auto& file) { return file->good(); });
}

XmlElement MjcfDocument::open_included(const XmlElement& include) {
  const auto key = std::pair(include.file, include.node.offset_debug());
  if (const auto found = included_.find(key); found != included_.end()) return found->second;
  XmlElement& element = included_[key];
  const std::string name = include.text("file");
  const language::Position at = include.place("file");
  const auto fail = [&](const std::string& message) {
    include.file->fail(at, message);
    return XmlElement{};
  };
  if (name.empty()) return fail("<include> lacks file=\"...\"");
  std::filesystem::path path = files_.find(name, file_.path);
  if (path.empty()) path = files_.find(name, sources_.at(include.file)->path);
  if (path.empty()) return fail(fmt::format("there is no file `{}`", name));
  std::error_code ignored;
  if (!paths_.insert(std::filesystem::weakly_canonical(path, ignored).string()).second)
    return fail(fmt::format("`{}` is included a second time, or includes itself", name));
  constexpr std::size_t most_files = 1000;
  if (paths_.size() > most_files) return fail(fmt::format("more than {} files", most_files));
  const language::SourceFile& source = files_.load(path).source;
  auto& xml = open_files_.emplace_back(std::make_unique<UrdfXml>(source, report_));
  sources_[xml.get()] = &source;
  report_.enter_include(source, at);
  element = {xml->open({"mujoco", "mujocoinclude"}, "MJCF"), xml.get()};
  report_.leave_include();
  return element;
}

std::vector<XmlElement> MjcfDocument::children(const XmlElement& of) {
  std::vector<XmlElement> found;
  // Innermost last; a file that is included stands in the place of its <include>.
  std::vector<XmlElement> waiting;
  const auto wait_for_children = [&](const XmlElement& element) {
    const std::size_t first = waiting.size();
    for (const pugi::xml_node& node : element.node.children()) {
      if (node.type() == pugi::node_element) waiting.push_back({node, element.file});
    }
    std::reverse(waiting.begin() + static_cast<std::ptrdiff_t>(first), waiting.end());
  };
  wait_for_children(of);
  while (!waiting.empty()) {
    const XmlElement element = waiting.back();
    waiting.pop_back();
    if (element.tag() != "include") {
      found.push_back(element);
      continue;
    }
    if (const XmlElement included = open_included(element); included.node)
      wait_for_children(included);
  }
  return found;
}

std::vector<XmlElement> MjcfDocument::in_sections(std::string_view section) {
  std::vector<XmlElement> all;
  for (const XmlElement& element : children(root_)) {
    if (element.tag() != section) continue;
    const std::vector<XmlElement> inside = children(element);
    all.insert(all.end(), inside.begin(), inside.end());
  }
  return all;
}

MjcfDocument::DefaultClass* MjcfDocument::open_class(const XmlElement& section,
                                                     const std::string& outer, std::size_t depth) {
  std::string name = section.text("class");
  if (depth == 0) {
    // The outermost class is "main", or what the file calls it; it may stand in several sections.
    if (!name.empty() && name != "main") classes_.try_emplace(name);
    return &classes_.try_emplace("").first->second;
  }
  if (name.empty()) {
    section.file->fail(section.place(), "this <default> has no class");
    return nullptr;
  }
  const std::size_t before = classes_.at(outer).elements.size();
  const auto [entry, is_new] = classes_.try_emplace(name, DefaultClass{outer, before, {}});
  if (!is_new)
    section.file->fail(section.place("class"), fmt::format("a second default class `{}`", name));
  return is_new ? &entry->second : nullptr;
}

void MjcfDocument::read_defaults(const XmlElement& section, const std::string& outer,
                                 std::size_t depth) {
  constexpr std::size_t deepest = 500;
  if (depth > deepest) {
    section.file->fail(section.place(), fmt::format("default classes stand in each other {} deep: "
                                                    "{} are the most",
                                                    depth, deepest));
    return;
  }
  DefaultClass* const of = open_class(section, outer, depth);
  if (of == nullptr) return;
  // A class has what stands in the one around it, before and after it.
  const std::vector<XmlElement> inside = children(section);
  for (const XmlElement& element : inside) {
    if (element.tag() == "default" || !check_mjcf_child(element, "default")) continue;
    check_mjcf_attributes(element);
    of->elements.push_back(element);
  }
  const std::string name = depth == 0 ? "" : section.text("class");
  for (const XmlElement& element : inside)
    if (element.tag() == "default") read_defaults(element, name, depth + 1);
}

std::vector<XmlElement> MjcfDocument::defaults_of(const XmlElement& element,
                                                  const std::string& name) const {
  const auto is_of_its_kind = [&](const XmlElement& other) {
    return other.tag() == element.tag() ||
           (is_mjcf_actuator(other.tag()) && is_mjcf_actuator(element.tag()));
  };
  std::vector<XmlElement> found;
  std::size_t count = DefaultClass::all;
  for (auto at = classes_.find(name); at != classes_.end();) {
    const auto& [outer, from_outer, elements] = at->second;
    for (std::size_t i = std::min(count, elements.size()); i-- > 0;)
      if (is_of_its_kind(elements[i])) found.push_back(elements[i]);
    count = from_outer;
    at = at->first.empty() ? classes_.end() : classes_.find(outer);
  }
  return found;
}

MjcfAttributes MjcfDocument::attributes(const XmlElement& element, const std::string& childclass) {
  check_mjcf_attributes(element);
  std::string name = element.text("class");
  if (name.empty()) name = childclass;
  if (!name.empty() && name != "main" && !classes_.contains(name)) {
    element.file->fail(element.place("class"), fmt::format("there is no default class `{}`", name));
    name = "";
  }
  return {element, defaults_of(element, name == "main" ? "" : name)};
}

void MjcfDocument::read_compiler() {
  for (const XmlElement& element : children(root_)) {
    if (element.tag() != "compiler") continue;
    check_mjcf_attributes(element);
    const MjcfAttributes given(element, {});
    const auto choice = [&](const char* attribute, std::initializer_list<std::string_view> words) {
      const std::string word = given.word(attribute);
      if (!word.empty() && std::ranges::count(words, std::string_view(word)) == 0)
        given.fail(attribute, fmt::format("{} is {}", attribute, fmt::join(words, ", ")));
      return word;
    };
    const std::string angle = choice("angle", {"degree", "radian"});
    if (!angle.empty()) compiler_.degrees = angle == "degree";
    if (choice("coordinate", {"local", "global"}) == "global")
      given.fail("coordinate", "global coordinates are not read, nor by MuJoCo since 2.3.4");
    compiler_.autolimits = given.boolean("autolimits", compiler_.autolimits);
    compiler_.balance_inertia = given.boolean("balanceinertia", compiler_.balance_inertia);
    compiler_.strip_path = given.boolean("strippath", compiler_.strip_path);
    const std::string geoms = choice("inertiafromgeom", {"false", "true", "auto"});
    using From = MjcfCompiler::FromGeoms;
    if (!geoms.empty())
      compiler_.inertia_from_geoms = geoms == "true"    ? From::always
                                     : geoms == "false" ? From::no
                                                        : From::where_missing;
    if (given.has("eulerseq")) {
      const std::string sequence = given.word("eulerseq");
      if (sequence.size() != 3 || sequence.find_first_not_of("xyzXYZ") != std::string::npos)
        given.fail("eulerseq", "eulerseq is three of x, y, z, X, Y and Z");
      else
        compiler_.euler_sequence = sequence;
    }
    if (given.has("assetdir")) compiler_.mesh_folder = given.word("assetdir");
    if (given.has("meshdir")) compiler_.mesh_folder = given.word("meshdir");
    compiler_.least_mass = given.number("boundmass", compiler_.least_mass);
    compiler_.least_inertia = given.number("boundinertia", compiler_.least_inertia);
    compiler_.total_mass = given.number("settotalmass", compiler_.total_mass);
    const auto groups =
        given.numbers("inertiagrouprange", {compiler_.first_group, compiler_.last_group});
    compiler_.first_group = groups[0];
    compiler_.last_group = groups[1];
  }
}

double MjcfDocument::angle(double written) const {
  return compiler_.degrees ? written * (std::numbers::pi / 180.) : written;
}

std::optional<std::array<double, 2>> MjcfDocument::range(const MjcfAttributes& given,
                                                         const char* range,
                                                         const char* limited) const {
  const std::array<double, 2> ends = given.ends(range);
  const std::string said = given.word(limited);
  const bool is_given = ends[0] != 0. || ends[1] != 0.;
  const bool holds = said == "true" || (said != "false" && compiler_.autolimits && is_given);
  if (!holds) return std::nullopt;
  if (ends[0] < ends[1]) return ends;
  given.fail(range, fmt::format("{:g} is not below {:g}", ends[0], ends[1]));
  return std::nullopt;
}

Pose MjcfDocument::pose(const MjcfAttributes& element) {
  return {element.vector("pos", {}), orientation(element)};
}

Quaterniond MjcfDocument::orientation(const MjcfAttributes& element) {
  const auto length_of = [&](const char* attribute, const Vector3d& v) {
    const double length = norm(v);
    if (!(length > 0.)) element.fail(attribute, "a vector of length 0 has no direction");
    return length > 0. ? length : 1.;
  };
  const std::string notation = element.orientation();
  if (notation == "axisangle") {
    const auto given = element.numbers("axisangle", {0., 0., 0., 0.});
    const Vector3d axis{given[0], given[1], given[2]};
    return exponential((angle(given[3]) / length_of("axisangle", axis)) * axis);
  }
  if (notation == "xyaxes") {
    const auto given = element.numbers("xyaxes", {0., 0., 0., 0., 0., 0.});
    Vector3d x{given[0], given[1], given[2]}, y{given[3], given[4], given[5]};
    x = (1. / length_of("xyaxes", x)) * x;
    y = y - dot(x, y) * x;
    y = (1. / length_of("xyaxes", y)) * y;
    const Vector3d z = cross(x, y);
    return quaternion_from(Matrix3d{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z});
  }
  if (notation == "zaxis") {
    const Vector3d z = element.vector("zaxis", {});
    return from_z_to((1. / length_of("zaxis", z)) * z);
  }
  if (notation == "euler") {
    const auto given = element.numbers("euler", {0., 0., 0.});
    Quaterniond q;
    // About the axes that have been turned already (x, y, z), or about fixed ones (X, Y, Z).
    for (std::size_t i = 0; i < given.size(); ++i) {
      const char axis = compiler_.euler_sequence[i];
      const bool fixed = axis < 'a';
      const Quaterniond own =
          turn_about(fixed ? static_cast<char>(axis - 'X' + 'x') : axis, angle(given[i]));
      q = fixed ? own * q : q * own;
    }
    return q;
  }
  if (notation.empty()) return {};
  const auto given = element.numbers("quat", {1., 0., 0., 0.});
  const double squared =
      given[0] * given[0] + given[1] * given[1] + given[2] * given[2] + given[3] * given[3];
  if (!(squared > 0.)) {
    element.fail("quat", "a quaternion of length 0 is no orientation");
    return {};
  }
  return normalized(Quaterniond{given[0], given[1], given[2], given[3]});
}

}  // namespace hookpoint::simulation
