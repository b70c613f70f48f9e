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
  std::string_view known;        ///< read, or without effect on motion
  std::string_view unread = {};  ///< with an effect on motion that is left aside
  bool has_pose = false;
};

/// What places an element in what it stands in.
constexpr std::string_view pose_attributes = "pos quat axisangle xyaxes zaxis euler";
constexpr std::string_view actuator_known =
    "name class group joint ctrllimited forcelimited actlimited ctrlrange forcerange actrange gear "
    "user inheritrange lengthrange nsample interp";
constexpr std::string_view actuator_unread =
    "cranklength jointinparent tendon slidersite cranksite site refsite body dyntype dynprm actdim "
    "actearly dampratio timeconst delay damping armature";

constexpr std::array rows{
    Row{"compiler",
        "autolimits boundmass boundinertia settotalmass balanceinertia strippath coordinate angle "
        "fitaabb eulerseq meshdir texturedir assetdir discardvisual convexhull usethread fusestatic "
        "inertiafromgeom inertiagrouprange exactmeshinertia saveinertial alignfree conflict "
        "optimize",
        ""},
    Row{"body", "name childclass mocap user sleep", "gravcomp", true},
    Row{"frame", "name childclass class", "", true},
    Row{"inertial", "mass diaginertia fullinertia", "", true},
    Row{"joint",
        "name class type group pos axis limited stiffness range ref springref armature damping "
        "frictionloss user actuatorfrclimited actuatorfrcrange",
        "springdamper solreflimit solimplimit solreffriction solimpfriction margin "
        "actuatorgravcomp"},
    Row{"freejoint", "name group align", ""},
    Row{"geom",
        "name class type contype conaffinity group size material friction mass density mesh fromto "
        "rgba user hfield fitscale",
        "condim priority shellinertia solmix solref solimp margin gap fluidshape fluidcoef", true},
    Row{"mesh",
        "name class file vertex normal texcoord face scale smoothnormal content_type maxhullvert "
        "material",
        "refpos refquat inertia builtin params octree_maxdepth"},
    Row{"general", "gainprm biasprm gaintype biastype", ""},
    Row{"motor", "", ""},
    Row{"position", "kp kv", ""},
    Row{"velocity", "kv", ""},
    Row{"key", "name time qpos qvel act mpos mquat ctrl", ""},
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

std::vector<std::string> unread_of(const Row& row) {
  std::vector<std::string> words = words_of(row.unread);
  if (is_mjcf_actuator(row.tag))
    std::ranges::copy(words_of(actuator_unread), std::back_inserter(words));
  return words;
}

}  // namespace

bool is_mjcf_actuator(std::string_view tag) {
  return tag == "general" || tag == "motor" || tag == "position" || tag == "velocity";
}

void check_mjcf_attributes(const XmlElement& element) {
  const Row* row = row_of(element.tag());
  if (row == nullptr) return;
  std::vector<std::string> known = words_of(row->known);
  std::ranges::copy(unread_of(*row), std::back_inserter(known));
  if (row->has_pose) std::ranges::copy(words_of(pose_attributes), std::back_inserter(known));
  if (is_mjcf_actuator(row->tag))
    std::ranges::copy(words_of(actuator_known), std::back_inserter(known));
  for (const pugi::xml_attribute& attribute : element.node.attributes()) {
    const std::string name = attribute.name();
    if (std::ranges::count(known, name) > 0) continue;
    const std::string nearest = language::nearest_name(name, known);
    element.file->fail(element.place(name),
                       fmt::format("<{}> has no attribute `{}`{}", element.tag(), name,
                                   nearest.empty() ? "" : "; did you mean `" + nearest + "`?"));
  }
}

std::vector<std::string> unread_mjcf_attributes(const XmlElement& element) {
  const Row* row = row_of(element.tag());
  if (row == nullptr) return {};
  std::vector<std::string> found;
  for (const std::string& name : unread_of(*row)) {
    if (element.node.attribute(name.c_str())) found.push_back(name);
  }
  return found;
}

}  // namespace hookpoint::simulation
