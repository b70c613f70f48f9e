// The layout is the architecture: no folder includes one that it must not see (ARCHITECTURE: four
// floors, no arrow up), and inside a folder arrows between its rooms run one way.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace {

using Names = std::set<std::string>;

const std::map<std::string, Names> may_include{
    {"math", {}},
    {"unicode", {}},
    {"formats", {}},
    {"dts", {"math"}},
    {"contact", {"math"}},
    {"integrators", {"math"}},
    {"language", {"math", "unicode", "formats"}},
    {"control", {"math", "formats"}},
    {"output", {"math", "unicode"}},
    {"simulation",
     {"math", "formats", "dts", "contact", "integrators", "language", "control", "output"}},
    {"reference", {"math", "contact", "simulation"}},
    {"studies", {"math", "unicode", "formats", "contact", "language", "output", "simulation"}},
    {"view", {"math", "unicode", "language", "output", "simulation"}},
    {"examples", {"control"}},
    {"application",
     {"math", "unicode", "formats", "dts", "contact", "integrators", "language", "control",
      "output", "simulation", "reference", "studies", "view"}},
    {"cli",
     {"math", "unicode", "formats", "dts", "contact", "integrators", "language", "control",
      "output", "simulation", "reference", "studies", "view", "application"}},
    {"python", {"language", "output", "simulation", "studies", "application"}},
};

/// Folders of reference/, an engine or two each.
const Names peers{"ode/", "bullet/", "mujoco/", "dart/", "simbody/"};

/// The rooms of a folder, lowest first: what stands in one includes nothing of a later one. A room
/// is a sub-folder ("laws/", with those in it), or files of the folder itself.
using Rooms = std::vector<Names>;

const std::map<std::string, Rooms> rooms{
    {"contact",
     {{"vocabulary", "predictions", "bisect", "law_interface", "bristle_step"},
      {"laws/"},
      {"terrain/"},
      {"impulse/"},
      {"force_law"}}},
    {"control",
     {{"linear_feedback", "component", "registry", "random", "first_order", "leg_kinematics"},
      {"core/"},
      {"data/"},
      {"components/"},
      {"plugin/"}}},
    {"unicode", {{"utf8"}, {"display"}}},
    {"language",
     {{"source", "diagnostics", "report", "names", "dimension", "units", "search", "wording"},
      {"schema/"},
      {"syntax/"},
      {"files"},
      {"values/"},
      {"tree/"},
      {"textmate", "document", "plugin_search", "library"}}},
    {"output",
     {{"bytes", "file", "child"},
      {"text/"},
      {"progress", "result_folder"},
      {"records/"},
      {"movies/"},
      {"figures/"}}},
    {"simulation",
     {{"joint_type", "experiment", "robot_tree", "resumable", "engine", "names", "kinematics",
       "ground", "ground_mesh", "creep_velocity", "material_fields", "joint_properties", "rotors",
       "effort_watch", "identity"},
      {"wiring/"},
      {"engine/"},
      {"analysis/"},
      {"run/"},
      {"scene/"}}},
    {"studies",
     {{"regime", "result", "metric", "summary", "selection", "pivot", "seed_means", "claims",
       "body_on_plane", "engine_table", "workers", "measured_body", "matched_grounds",
       "assignment"},
      {"schema"},
      {"predictions/"},
      {"measurements/"},
      {"metrics/"},
      {"plan/"},
      {"run/"},
      {"cluster/"},
      {"report/"},
      {"compare/"},
      {"tune/"},
      {"calibrate/"}}},
    {"reference",
     {{"experiment_checks", "extremes", "ground", "library_abort", "peer", "peer_engine",
       "principal_axes", "resting_body", "robot_tree", "settings", "static_depth", "steady_creep",
       "touching_points", "external_forces", "restitution_gap"},
      peers,
      {"engines"}}},
    {"view",
     {{"admission", "websocket", "commands", "snapshot", "traces", "pace", "file_watch", "meter",
       "study_board", "film", "shown", "widget_fields"},
      {"server", "schema"},
      {"panel", "scene", "ghosts", "file_fields"},
      {"audience", "history"},
      {"subjects", "reel", "keep_picture"},
      {"description", "movie_traces"},
      {"live_session", "movie_session", "film_session"}}},
};

std::string included_path(const std::string& line) {
  const std::string opening = "#include \"";
  if (line.rfind(opening, 0) != 0) return "";
  return line.substr(opening.size(), line.find('"', opening.size()) - opening.size());
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.find('/');
  return slash == std::string::npos ? "(none)" : path.substr(0, slash);
}

/// Of a path in the folder: "laws/nominal.h" is in "laws/", "force_law.h" in "force_law" or
/// "force_law.h".
bool stands_in(const std::string& path, const Names& room) {
  const std::size_t slash = path.find('/');
  if (slash != std::string::npos) return room.contains(path.substr(0, slash + 1));
  return room.contains(path) || room.contains(path.substr(0, path.find('.')));
}

std::ptrdiff_t room_of(const std::string& path, const Rooms& of_folder) {
  const auto found =
      std::ranges::find_if(of_folder, [&](const Names& room) { return stands_in(path, room); });
  return found == of_folder.end() ? -1 : found - of_folder.begin();
}

using Visit = std::function<void(const std::string& file, const std::string& included)>;

/// Calls `visit` for every include of the folder's sources; paths from the project's root.
void for_each_include(const std::string& folder, const Visit& visit) {
  const std::filesystem::path root = HOOKPOINT_SOURCE_DIR;
  if (!std::filesystem::exists(root / folder)) return;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      const std::string included = included_path(line);
      if (!included.empty()) visit(entry.path().lexically_relative(root), included);
    }
  }
}

TEST(Layering, EveryIncludeGoesDown) {
  int includes = 0;
  for (const auto& [folder, allowed] : may_include) {
    for_each_include(folder, [&](const std::string& file, const std::string& included) {
      const std::string other = folder_of(included);
      if (other == folder) return;
      ++includes;
      EXPECT_TRUE(allowed.contains(other)) << file << " includes " << included;
    });
  }
  EXPECT_GT(includes, 50);
}

TEST(Layering, ArrowsBetweenTheRoomsOfAFolderRunOneWay) {
  int includes = 0;
  for (const auto& [folder, of_folder] : rooms) {
    const std::size_t inside = folder.size() + 1;
    for_each_include(folder, [&](const std::string& file, const std::string& included) {
      const std::ptrdiff_t from = room_of(file.substr(inside), of_folder);
      EXPECT_GE(from, 0) << file << " stands in no room: give it one in this test";
      if (folder_of(included) != folder) return;
      ++includes;
      const std::ptrdiff_t to = room_of(included.substr(inside), of_folder);
      EXPECT_LE(to, from) << file << " includes " << included;
    });
  }
  EXPECT_GT(includes, 50);
}

// What may not depend on each other in one room either: laws are compared by their files alone, and
// one engine's library must not be needed by another.
TEST(Layering, PeersDoNotSeeEachOther) {
  for (const std::string& peer : peers) {
    for_each_include(
        "reference/" + peer, [&](const std::string& file, const std::string& included) {
          if (folder_of(included) != "reference") return;
          const std::string other =
              folder_of(included.substr(std::string_view("reference/").size())) + "/";
          EXPECT_TRUE(other == peer || !peers.contains(other)) << file << " includes " << included;
        });
  }
}

}  // namespace
