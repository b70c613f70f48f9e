// hookpoint fixture: scenes with closed forms for any engine, and the script that judges without us.
// ctest: long, released
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/command.h"
#include "tests/support/folders.h"
#include "text/json_reader.h"

namespace hookpoint {
namespace {

namespace fs = std::filesystem;
using testing::CommandResult;
using testing::config;
using testing::has;
using testing::Workplace;

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(csv);
  for (std::string line; std::getline(text, line);) {
    std::istringstream cells(line);
    std::vector<std::string>& row = rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

std::size_t column(const std::vector<std::string>& head, const std::string& name) {
  const auto found = std::ranges::find(head, name);
  EXPECT_NE(found, head.end()) << name;
  return static_cast<std::size_t>(found - head.begin());
}

/// Names of the phenomena that were exported.
std::vector<std::string> phenomena(const fs::path& fixture) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fixture))
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

/// A run's trace.csv as check.py takes it.
std::string poses(const std::string& trace) {
  std::string text = trace;
  const std::vector<std::pair<std::string, std::string>> names{
      {"position.", ""}, {"orientation.", "q"}, {"contact.force.", "f"}};
  std::string head = text.substr(0, text.find('\n')), shown;
  const auto cells = rows_of(head);
  for (const std::string& cell : cells.front()) {
    std::string name = cell.substr(0, cell.find(" ["));
    for (const auto& [port, short_name] : names)
      if (const auto at = name.find(port); at != std::string::npos)
        name = short_name + name.substr(at + port.size());
    shown += (shown.empty() ? "" : ",") + name;
  }
  return shown + text.substr(head.size());
}

// Two codes judge the same runs: ours, and the script that everybody else has.
TEST(FixtureCommand, TheScriptJudgesAsTheCommandDoes) {
  const Workplace place;
  ASSERT_EQ(place.hookpoint("fixture export fixture").status, 0);
  const CommandResult run = place.hookpoint("fixture run hookpoint --out card");
  ASSERT_EQ(run.status, 0) << run.err << run.out;
  const auto scores = rows_of(place.read("card/scores.csv"));
  std::map<std::string, double> ours;
  for (std::size_t i = 1; i < scores.size(); ++i)
    ours[scores[i][column(scores[0], "scene")]] =
        std::stod(scores[i][column(scores[0], "measured")]);
  const auto names = phenomena(place.folder() / "fixture");
  EXPECT_GE(names.size(), 14u);
  EXPECT_EQ(names.size(), ours.size());
  fs::create_directory(place.folder() / "results");
  for (const std::string& name : names) {
    const std::string robot =
        has(place.read("fixture/" + name + "/scene.json"), "\"block\"") ? "block" : "*";
    const CommandResult trace = place.hookpoint(
        "run " + config("fixture/" + name + ".hook") + " --out " + name + " --record world." +
        robot + ".position,world." + robot + ".orientation,world." + robot + ".contact.force");
    ASSERT_LE(trace.status, 1) << name << trace.err;
    place.file("results/" + name + ".csv", poses(place.read(name + "/trace.csv")));
  }
  const CommandResult judged = place.run("python3 fixture/check.py results --json");
  ASSERT_EQ(judged.status, 0) << judged.err;
  EXPECT_EQ(judged.err, "");
  const auto card = text::read_json(judged.out);
  ASSERT_TRUE(card) << judged.out;
  ASSERT_EQ(card->items().size(), names.size());
  for (const text::JsonValue& entry : card->items()) {
    const std::string name = entry.member("phenomenon")->text();
    const double theirs = entry.member("measured")->number().value();
    EXPECT_NEAR(theirs, ours.at(name), 1e-9 * std::max(1., std::abs(ours.at(name)))) << name;
  }
}

TEST(FixtureCommand, EachFolderHasTheSceneInEveryFormat) {
  const Workplace place;
  ASSERT_EQ(place.hookpoint("fixture export fixture").status, 0);
  for (const std::string& name : phenomena(place.folder() / "fixture"))
    for (const char* file :
         {"scene.json", "scene.xml", "scene.urdf", "scene.sdf", "expected.json", "README.md"})
      EXPECT_FALSE(place.read("fixture/" + name + "/" + file).empty()) << name << file;
  const CommandResult again = place.hookpoint("fixture export fixture");
  EXPECT_EQ(again.status, 0) << "its own folder: " << again.err;
  fs::create_directory(place.folder() / "taken");
  place.file("taken/README.md", "mine\n");
  const CommandResult taken = place.hookpoint("fixture export taken");
  EXPECT_EQ(taken.status, 2);
  EXPECT_EQ(place.read("taken/README.md"), "mine\n");
}

TEST(FixtureCommand, LeavesACardAndSaysWhereOursLose) {
  const Workplace place;
  const CommandResult run = place.hookpoint("fixture run hunt_crossley ode:recommended --out card");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.out, "ode_recommended comes nearer")) << run.out;
  const std::string page = place.read("card/report.html");
  EXPECT_TRUE(has(page, "Where our laws lose"));
  EXPECT_TRUE(has(page, "<svg"));
  EXPECT_TRUE(has(page, "hookpoint fixture run hunt_crossley ode:recommended")) << "the command";
  EXPECT_TRUE(has(place.read("card/score_card.svg"), "Newton"));
}

TEST(FixtureCommand, WrongInputIsSaidAndEndsWithStatus2) {
  const Workplace place;
  const CommandResult unknown = place.hookpoint("fixture run mujocoo:recommended");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_TRUE(has(unknown.err, "subject `mujocoo`")) << unknown.err;
  EXPECT_EQ(place.hookpoint("fixture").status, 2);
  EXPECT_EQ(place.hookpoint("fixture run --engines nowhere.hook").status, 2);
}

// What is wrong with a file is said, and the other files are judged all the same.
TEST(FixtureCommand, TheScriptSaysWhatItCannotJudge) {
  const Workplace place;
  ASSERT_EQ(place.hookpoint("fixture export fixture").status, 0);
  EXPECT_NE(place.run("python3 fixture/check.py nowhere").status, 0);
  fs::create_directory(place.folder() / "results");
  EXPECT_NE(place.run("python3 fixture/check.py results").status, 0) << "judged nothing";
  place.file("results/creep.csv", "time,x\n0,0\n1,0\n");
  place.file("results/slide_to_roll.csv", "time,y\n0,0\n");
  std::string rest = "time,x,y,z\n";
  for (int step = 0; step <= 2000; ++step) rest += std::to_string(1e-3 * step) + ",0.,0.,0.01\n";
  place.file("results/static_depth.csv", rest);
  const CommandResult judged = place.run("python3 fixture/check.py results");
  EXPECT_EQ(judged.status, 0) << judged.err;
  EXPECT_TRUE(has(judged.out, "static_depth")) << judged.out;
  EXPECT_TRUE(has(judged.err, "it ends at 1 s, before 2 s")) << judged.err;
  EXPECT_TRUE(has(judged.err, "there is no column x")) << judged.err;
}

}  // namespace
}  // namespace hookpoint
