#include "simulation/scene/mjcf/vocabulary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "language/names.h"

namespace hookpoint::simulation {
namespace {

/// Names are separated by blanks.
struct Row {
  std::string_view tag;
  std::string_view known;                ///< read, or without effect on motion
  std::string_view unread_numbers = {};  ///< with an effect on motion that is left aside
  std::string_view unread_words = {};
  bool has_pose = false;
};

/// What places an element in what it stands in.
constexpr std::string_view pose_attributes = "pos quat axisangle xyaxes zaxis euler";
constexpr std::string_view actuator_known =
    "name class group joint ctrllimited forcelimited actlimited ctrlrange forcerange actrange gear "
    "user inheritrange lengthrange nsample interp";
constexpr std::string_view actuator_unread_numbers =
    "cranklength dynprm actdim timeconst delay damping armature";
constexpr std::string_view actuator_unread_words =
    "jointinparent tendon slidersite cranksite site refsite body dyntype actearly";

constexpr std::array rows{
    Row{"compiler",
        "autolimits boundmass boundinertia settotalmass balanceinertia strippath coordinate angle "
        "fitaabb eulerseq meshdir texturedir assetdir discardvisual convexhull usethread fusestatic "
        "inertiafromgeom inertiagrouprange exactmeshinertia saveinertial alignfree conflict "
        "optimize"},
    Row{"body", "name childclass mocap user sleep", "gravcomp", "", true},
    Row{"frame", "name childclass class", "", "", true},
    Row{"inertial", "mass diaginertia fullinertia", "", "", true},
    Row{"joint",
        "name class type group pos axis limited stiffness range ref springref springdamper armature "
        "damping frictionloss user actuatorfrclimited actuatorfrcrange",
        "solreflimit solimplimit solreffriction solimpfriction margin", "actuatorgravcomp"},
    Row{"freejoint", "name group align"},
    Row{"geom",
        "name class type contype conaffinity group size material friction mass density mesh fromto "
        "rgba user hfield fitscale",
        "condim priority solmix solref solimp margin gap fluidcoef surfacevel adhesion",
        "shellinertia fluidshape", true},
    Row{"mesh",
        "name class file vertex normal texcoord face scale smoothnormal content_type maxhullvert "
        "material",
        "refpos refquat octree_maxdepth", "inertia builtin params"},
    Row{"general", "gainprm biasprm gaintype biastype"},
    Row{"motor", ""},
    Row{"position", "kp kv dampratio"},
    Row{"velocity", "kv"},
    Row{"key", "name time qpos qvel act mpos mquat ctrl"},
};

/// What may stand in an element.
struct ChildrenRow {
  std::string_view parent, children;
};
constexpr std::string_view actuator_tags =
    "general motor position velocity intvelocity damper cylinder muscle adhesion dcmotor";
constexpr std::string_view world_children =
    "body geom site camera light frame composite flexcomp replicate attach plugin";
constexpr std::array children_rows{
    ChildrenRow{"worldbody", world_children},
    ChildrenRow{"asset", "texture material mesh hfield skin model"},
    ChildrenRow{"equality", "connect weld joint tendon flex flexvert flexstrain"},
    ChildrenRow{"contact", "pair exclude"},
    ChildrenRow{"tendon", "spatial fixed"},
    ChildrenRow{"keyframe", "key"},
};

std::vector<std::string> words_of(std::string_view list) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(' ', at), list.size());
    if (end > at) words.emplace_back(list.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

const Row* row_of(std::string_view tag) {
  const auto* const row = std::ranges::find(rows, tag, &Row::tag);
  return row == rows.end() ? nullptr : row;
}

void append_words(std::string_view list, std::vector<std::string>& words) {
  std::ranges::copy(words_of(list), std::back_inserter(words));
}

std::vector<std::string> unread_numbers_of(const Row& row) {
  std::vector<std::string> words = words_of(row.unread_numbers);
  if (is_mjcf_actuator(row.tag)) append_words(actuator_unread_numbers, words);
  return words;
}

std::vector<std::string> unread_of(const Row& row) {
  std::vector<std::string> words = unread_numbers_of(row);
  append_words(row.unread_words, words);
  if (is_mjcf_actuator(row.tag)) append_words(actuator_unread_words, words);
  return words;
}

/// None: any.
std::vector<std::string> known_in(std::string_view parent) {
  std::vector<std::string> words;
  const auto* const row = std::ranges::find(children_rows, parent, &ChildrenRow::parent);
  if (row != children_rows.end()) append_words(row->children, words);
  if (parent == "actuator" || parent == "default") append_words(actuator_tags, words);
  if (parent == "actuator") append_words("plugin", words);
  if (parent == "default")
    append_words("mesh material joint geom site camera light pair equality tendon default", words);
  if (parent == "body")
    append_words(world_children, words), append_words("inertial joint freejoint", words);
  return words;
}

}  // namespace

bool is_mjcf_actuator(std::string_view tag) {
  const std::vector<std::string> words = words_of(actuator_tags);
  return std::ranges::count(words, tag) > 0;
}

bool check_mjcf_child(const XmlElement& element, std::string_view parent) {
  const std::vector<std::string> known = known_in(parent);
  if (known.empty() || std::ranges::count(known, element.tag()) > 0) return true;
  return element.file->fail(element.place(),
                            fmt::format("<{}> has no <{}>{}", parent, element.tag(),
                                        language::did_you_mean(element.tag(), known)));
}

void check_mjcf_attributes(const XmlElement& element) {
  const Row* row = row_of(element.tag());
  if (row == nullptr) return;
  constexpr std::size_t enough = 1000;
  for (const std::string& name : unread_numbers_of(*row))
    element.file->numbers(element.node, name.c_str(), enough);
  std::vector<std::string> known = words_of(row->known);
  std::ranges::copy(unread_of(*row), std::back_inserter(known));
  if (row->has_pose) append_words(pose_attributes, known);
  if (is_mjcf_actuator(row->tag)) append_words(actuator_known, known);
  for (const pugi::xml_attribute& attribute : element.node.attributes()) {
    const std::string name = attribute.name();
    if (std::ranges::count(known, name) > 0) continue;
    element.file->fail(element.place(name),
                       fmt::format("<{}> has no attribute `{}`{}", element.tag(), name,
                                   language::did_you_mean(name, known)));
  }
}

std::vector<std::string> unread_mjcf_attributes(const MjcfAttributes& given) {
  const Row* row = row_of(given.own().tag());
  if (row == nullptr) return {};
  std::vector<std::string> found;
  for (const std::string& name : unread_of(*row)) {
    if (given.has(name.c_str())) found.push_back(name);
  }
  return found;
}

}  // namespace hookpoint::simulation
