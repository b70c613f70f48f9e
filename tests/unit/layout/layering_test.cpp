// The layout is the architecture: no folder includes one that it must not see (ARCHITECTURE: four
// floors, no arrow up), and inside a folder arrows between its rooms run one way.
// ctest: released
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/folders.h"

namespace {

using Names = std::set<std::string>;

const std::map<std::string, Names> may_include{
    {"math", {}},
    {"text", {}},
    {"dts", {"math"}},
    {"contact", {"math"}},
    {"integrators", {"math"}},
    {"language", {"math", "text"}},
    {"control", {"math", "text"}},
    {"output", {"math", "text"}},
    {"simulation",
     {"math", "text", "dts", "contact", "integrators", "language", "control", "output"}},
    {"reference", {"math", "text", "contact", "output", "simulation"}},
    {"translation", {"math", "text", "contact", "simulation", "reference"}},
    {"studies", {"math", "text", "contact", "language", "output", "simulation"}},
    {"examples", {"control"}},
    {"apps/view", {"math", "text", "language", "output", "simulation"}},
    {"apps/shared",
     {"math", "text", "dts", "contact", "integrators", "language", "control", "output",
      "simulation", "reference", "translation", "studies", "apps/view"}},
    {"apps/cli",
     {"math", "text", "dts", "contact", "integrators", "language", "control", "output",
      "simulation", "reference", "translation", "studies", "apps/view", "apps/shared"}},
    {"apps/python",
     {"text", "language", "output", "simulation", "translation", "studies", "apps/shared"}},
};

/// Folders of reference/, an engine or two each.
const Names peers{"ode", "bullet", "mujoco", "dart", "simbody", "process"};

/// Rooms of a folder, lowest first: a file includes nothing of a later room. A room is one or more
/// sub-folders. Files of the folder itself are the lowest room, or the highest if they are listed
/// in `joins_its_rooms`.
using Rooms = std::vector<Names>;

const std::map<std::string, Rooms> rooms{
    {"contact", {{"laws"}, {"terrain"}, {"geometry"}, {"impulse"}}},
    {"control", {{"core"}, {"data"}, {"components"}, {"plugin"}}},
    {"language", {{"schema"}, {"syntax"}, {"values"}, {"tree"}, {"document"}}},
    {"output", {{"files"}, {"records"}, {"movies"}, {"figures"}, {"latex"}}},
    {"simulation",
     {{"experiment"},
      {"engine_interface"},
      {"wiring"},
      {"dts_engine"},
      {"analysis"},
      {"run"},
      {"scene"}}},
    {"studies",
     {{"measure"},
      {"results"},
      {"predictions"},
      {"measurements"},
      {"metrics"},
      {"blocks"},
      {"plan"},
      {"run"},
      {"cluster"},
      {"report"},
      {"compare"},
      {"search"},
      {"calibrate"},
      {"tune"},
      {"task"}}},
    {"reference", {peers}},
    {"apps/view", {{"wire"}, {"widgets"}, {"session"}}},
};

/// Files of a folder that put its rooms together.
const std::map<std::string, std::string> joins_its_rooms{{"contact", "force_law"},
                                                         {"reference", "engines"}};

std::string included_path(const std::string& line) {
  const std::string opening = "#include \"";
  if (line.rfind(opening, 0) != 0) return "";
  return line.substr(opening.size(), line.find('"', opening.size()) - opening.size());
}

/// "contact" of "contact/laws/nominal.h"; an application is a folder of its own, "apps/view".
std::string folder_of(const std::string& path) {
  std::size_t slash = path.find('/');
  if (path.rfind("apps/", 0) == 0) slash = path.find('/', slash + 1);
  return slash == std::string::npos ? "(none)" : path.substr(0, slash);
}

/// Place of `path`, which is inside `folder`, among the rooms; -1 without one.
std::ptrdiff_t room_of(const std::string& folder, const std::string& path) {
  const Rooms& of_folder = rooms.at(folder);
  const std::size_t slash = path.find('/');
  if (slash == std::string::npos) {
    const auto joins = joins_its_rooms.find(folder);
    const bool highest =
        joins != joins_its_rooms.end() && path.substr(0, path.find('.')) == joins->second;
    return highest ? std::ssize(of_folder) + 1 : 0;
  }
  const auto found = std::ranges::find_if(
      of_folder, [&](const Names& room) { return room.contains(path.substr(0, slash)); });
  return found == of_folder.end() ? -1 : found - of_folder.begin() + 1;
}

using Visit = std::function<void(const std::string& file, const std::string& text)>;

/// Calls `visit` for every line of the folder's sources; paths from the project's root.
void for_each_line(const std::string& folder, const Visit& visit) {
  const std::filesystem::path root = hookpoint::testing::source_folder();
  if (!std::filesystem::exists(root / folder)) return;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);)
      visit(entry.path().lexically_relative(root), line);
  }
}

/// Calls `visit` for every include of the folder's sources.
void for_each_include(const std::string& folder, const Visit& visit) {
  for_each_line(folder, [&](const std::string& file, const std::string& line) {
    const std::string included = included_path(line);
    if (!included.empty()) visit(file, included);
  });
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

/// Whether `line` has the name `space::` outside of a comment.
bool uses_namespace(std::string_view line, std::string_view space) {
  line = line.substr(0, line.find("//"));
  const std::string name = std::string(space) + "::";
  for (std::size_t at = line.find(name); at != std::string::npos; at = line.find(name, at + 1)) {
    const char before = at == 0 ? ' ' : line[at - 1];
    if (std::isalnum(static_cast<unsigned char>(before)) == 0 && before != '_') return true;
  }
  return false;
}

// A name that another header brings along is as much of a dependence as an include: a peer that
// computed with `dts::` would share the code that it checks.
TEST(Layering, NamesAreOfFoldersThatMayBeIncluded) {
  int lines = 0;
  for (const auto& [folder, allowed] : may_include) {
    for_each_line(folder, [&](const std::string& file, const std::string& line) {
      ++lines;
      for (const auto& [other, others] : may_include) {
        const std::string space = other.substr(other.find('/') + 1);
        if (other == folder || allowed.contains(other)) continue;
        EXPECT_FALSE(uses_namespace(line, space)) << file << " has " << line;
      }
    });
  }
  EXPECT_GT(lines, 10000);
  EXPECT_TRUE(uses_namespace("  hookpoint::dts::Model<double> model;", "dts"));
  EXPECT_FALSE(uses_namespace("  widths::x;  // as dts::State", "dts"));
}

TEST(Layering, APeerDoesNotIncludeOurEngine) {
  for_each_include("reference", [](const std::string& file, const std::string& included) {
    EXPECT_FALSE(included.starts_with("simulation/dts_engine/"))
        << file << " includes " << included;
  });
}

TEST(Layering, ArrowsBetweenTheRoomsOfAFolderRunOneWay) {
  int includes = 0;
  for (const auto& [folder, of_folder] : rooms) {
    const std::size_t inside = folder.size() + 1;
    for_each_include(folder, [&](const std::string& file, const std::string& included) {
      const std::ptrdiff_t from = room_of(folder, file.substr(inside));
      EXPECT_GE(from, 0) << file << " stands in no room: give it one in this test";
      if (folder_of(included) != folder) return;
      ++includes;
      const std::ptrdiff_t to = room_of(folder, included.substr(inside));
      EXPECT_LE(to, from) << file << " includes " << included;
    });
  }
  EXPECT_GT(includes, 50);
}

// What may not depend on each other in one room either: laws are compared by their files alone, and
// one engine's library must not be needed by another.
TEST(Layering, PeersDoNotSeeEachOther) {
  for (const std::string& peer : peers) {
    for_each_include("reference/" + peer, [&](const std::string& file,
                                              const std::string& included) {
      if (folder_of(included) != "reference") return;
      const std::string other = folder_of(included.substr(std::string_view("reference/").size()));
      EXPECT_TRUE(other == peer || !peers.contains(other)) << file << " includes " << included;
    });
  }
}

}  // namespace
