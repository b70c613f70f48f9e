// study --view: the page is told every row as it finishes, the results are the same bytes as
// without, and the program stays until it is told to go.
// ctest: long, clock
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include "tests/support/child_process.h"
#include "tests/support/chromium.h"
#include "tests/support/command.h"
#include "tests/support/window_client.h"
#include "text/json_reader.h"

namespace hookpoint {
namespace {

using testing::ChildProcess;
using testing::WindowClient;
using testing::Workplace;
using Leaves = std::map<std::string, std::string>;

constexpr const char* study = R"(
Study watched {
  scene = "scenes/sloped_block.hook";
  title = "Watched";
  duration = 0.2 s;
  settle = 0.1 s;
  Sweep slope { values = 10 deg, 20 deg; }
  Measure creep_speed;
  Measure step_time;
  Subject hook { engine = dts; contact = hookpoint; }
  Subject impulse { engine = dts; contact = impulse; }
  Truth creep_speed { below = 1 m/s; }
  Plot by_slope { x = slope; y = creep_speed; }
}
)";

/// One that is sooner done: two rows, and nothing is timed.
std::string small_study() {
  std::string text = study;
  for (const auto& [from, to] : std::map<std::string, std::string>{
           {"  Measure step_time;\n", ""},
           {"  Subject impulse { engine = dts; contact = impulse; }\n", ""}})
    text.replace(text.find(from), from.size(), to);
  return text;
}

// Which is still running when the test has said what it has to.
std::string long_study() {
  std::string text = small_study();
  const std::string duration = "duration = 0.2 s";
  text.replace(text.find(duration), duration.size(), "duration = 500 s");
  return text;
}

/// The whole first line of standard output: none before it is there.
std::string first_line(const std::string& out) {
  const std::size_t end = out.find('\n');
  return end == std::string::npos ? "" : out.substr(0, end);
}

/// What a page has been told of the only study of a file, from description on.
struct Told {
  Leaves description;
  std::set<std::string> finished;  ///< rows
  Leaves figure;                   ///< the latest
  std::string done, total, report;
};

/// Listens until the study is done.
Told listen(WindowClient& client) {
  Told told;
  while (told.report.empty()) {
    const auto message = client.hear();
    if (!message) return told;
    const auto leaves = text::json_leaves(*message);
    EXPECT_TRUE(leaves) << *message;
    if (!leaves) return told;
    Leaves read(leaves->begin(), leaves->end());
    const std::string kind = read["tell"];
    if (kind == "row" && !read["outcome"].empty()) told.finished.insert(read["row"]);
    if (kind == "progress") told.done = read["done"], told.total = read["total"];
    if (kind == "state") told.report = read["report"];
    if (kind == "figure") told.figure = read;
    if (kind != "description") continue;
    for (int row = 0; row < 4; ++row) {
      const std::string start = "studies[0].rows[" + std::to_string(row) + "].outcome";
      if (!read[start].empty()) told.finished.insert(std::to_string(row));
    }
    told.done = read["studies[0].progress.done"];
    told.total = read["studies[0].progress.total"];
    told.report = read["studies[0].report"];
    told.description = std::move(read);
  }
  return told;
}

class StudyView : public ::testing::Test {
 protected:
  /// No picture is drawn unless a test is about it.
  StudyView() { setenv("HOOKPOINT_BROWSER", "/nowhere", 1); }
  ~StudyView() override { unsetenv("HOOKPOINT_BROWSER"); }

  /// The words of `hookpoint study --view` into `out`.
  static std::vector<std::string> words(const std::string& out) {
    return {"study", "watched.hook", "--jobs", "2", "--out", out, "--view", "--no-open"};
  }
  static std::string wait_for_url(ChildProcess& process) {
    process.wait_until([&] { return !first_line(process.out()).empty(); });
    return first_line(process.out());
  }

  Workplace work_;
};

TEST_F(StudyView, APageHearsOfEveryRowAndTheBytesAreThoseOfAStudyUnseen) {
  work_.file("watched.hook", study);
  ASSERT_EQ(work_.hookpoint("study watched.hook --jobs 2 --out unseen").status, 0);
  ChildProcess process(work_.folder(), words("seen"));
  const std::string url = wait_for_url(process);
  WindowClient client(url);
  ASSERT_TRUE(client.connected()) << url << process.err();
  const Told told = listen(client);
  EXPECT_EQ(told.finished, (std::set<std::string>{"0", "1", "2", "3"}));
  EXPECT_EQ(told.report, "seen/report.html");
  // Four rows, and each again alone for its timing.
  EXPECT_EQ(told.done + " of " + told.total, "8 of 8");
  EXPECT_EQ(told.description.at("kind"), "study");
  EXPECT_EQ(told.description.at("title"), "watched.hook");
  EXPECT_EQ(told.description.at("studies[0].title"), "Watched");
  EXPECT_EQ(told.description.at("studies[0].columns[1].unit"), "m/s");
  EXPECT_EQ(told.description.at("studies[0].rows[3].varied[0]"), "20");

  // Who joins later is told the same.
  WindowClient late(url);
  ASSERT_TRUE(late.connected());
  const Told again = listen(late);
  EXPECT_EQ(again.finished, told.finished);
  EXPECT_EQ(again.description.at("studies[0].rows[0].cells[0][2]"), "true");
  EXPECT_NE(again.description.at("studies[0].rows[0].cells[1][0]"), "null");
  const std::string figure = "studies[0].figures[0].";
  EXPECT_EQ(again.description.at(figure + "panels[0].series[0].label"), "hook");
  EXPECT_EQ(again.description.at(figure + "panels[0].series[1].measured.x[1]"), "20");

  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(), 0) << process.err();
  EXPECT_EQ(process.out(), url + "\n");
  EXPECT_FALSE(work_.read("seen/results.csv").empty());
  EXPECT_EQ(work_.read("seen/results.csv"), work_.read("unseen/results.csv"));
  EXPECT_EQ(work_.read("seen/by_slope.csv"), work_.read("unseen/by_slope.csv"));
}

TEST_F(StudyView, TheExitStatusIsTheStudysAndQuitEndsIt) {
  std::string failing = small_study();
  failing.replace(failing.find("below = 1 m/s"), 13, "above = 1 m/s");
  work_.file("watched.hook", failing);
  auto given = words("out");
  given.insert(given.end(), {"--token", "known_before_it_began"});
  ChildProcess process(work_.folder(), given);
  const std::string url = wait_for_url(process);
  EXPECT_TRUE(url.ends_with("?token=known_before_it_began")) << url;
  WindowClient client(url);
  ASSERT_TRUE(client.connected()) << process.err();
  EXPECT_EQ(listen(client).report, "out/report.html");
  client.say(R"({"id": 5, "do": "quit"})");
  EXPECT_EQ(process.wait(), 1) << process.err();
}

// Both rows are of one scene, whose runs would have one folder.
TEST_F(StudyView, ARowsWindowHasAFolderOfItsOwn) {
  work_.file("watched.hook", small_study());
  ChildProcess process(work_.folder(), words("out"));
  WindowClient client(wait_for_url(process));
  ASSERT_TRUE(client.connected()) << process.err();
  listen(client);
  for (const char* row : {"0", "1"}) {
    const auto answer =
        text::json_leaves(client.ask("open", std::string(R"("study": 0, "row": )") + row));
    ASSERT_TRUE(answer);
    const Leaves opened(answer->begin(), answer->end());
    ASSERT_TRUE(opened.contains("url")) << process.err();
    WindowClient window(opened.at("url"));
    const std::string set = window.ask("set", R"("values": {"Simulator.pull.body": 0})");
    EXPECT_NE(set.find("\"ok\""), std::string::npos) << set;
    const std::string folder = std::string("out/windows/0000") + row + "/";
    EXPECT_NE(work_.read(folder + "experiment.hook").find("World"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(work_.folder() / folder / ".lock"));
  }
  EXPECT_FALSE(std::filesystem::exists(work_.folder() / "runs"));
}

TEST_F(StudyView, TheReportLinksToAPictureOfItsScene) {
  NEEDS_CHROMIUM;
  unsetenv("HOOKPOINT_BROWSER");
  work_.file("watched.hook", small_study());
  ChildProcess process(work_.folder(), words("out"));
  const std::string link = "pictures/scene.png";
  const auto is_linked = [&] {
    return work_.read("out/report.html").find(link) != std::string::npos;
  };
  process.wait_until(
      [&] { return is_linked() || process.err().find("has no picture") != std::string::npos; });
  EXPECT_TRUE(is_linked()) << process.err();
  EXPECT_TRUE(work_.read("out/" + link).starts_with("\x89PNG\r\n\x1a\n"));
  EXPECT_EQ(work_.read("out/files.json").find(link), std::string::npos);
}

TEST_F(StudyView, WhatIsNoRequestIsAnsweredByItsReason) {
  work_.file("watched.hook", small_study());
  ChildProcess process(work_.folder(), words("out"));
  WindowClient client(wait_for_url(process));
  ASSERT_TRUE(client.connected()) << process.err();
  listen(client);
  for (const auto& [request, reason] : std::map<std::string, std::string>{
           {"{", "not JSON"},
           {R"({"id": 1, "do": "pause"})", "`open`"},
           {R"({"id": 2, "do": "open", "study": 0, "row": 8})", "`row`"}}) {
    client.say(request);
    const std::string answer = client.wait_for("\"error\"");
    EXPECT_NE(answer.find(reason), std::string::npos) << request << '\n' << answer;
  }
}

TEST_F(StudyView, QuitInTheMidstIsAnInterruptThatMayBeResumed) {
  work_.file("watched.hook", long_study());
  ChildProcess process(work_.folder(), words("out"));
  WindowClient client(wait_for_url(process));
  ASSERT_TRUE(client.connected()) << process.err();
  ASSERT_TRUE(client.hear());
  client.say(R"({"id": 5, "do": "quit"})");
  EXPECT_EQ(process.wait(), 130) << process.err();
  EXPECT_NE(process.err().find("interrupted"), std::string::npos) << process.err();
}

TEST_F(StudyView, APortThatIsTakenIsToldWithWhatToDo) {
  work_.file("watched.hook", long_study());  // The port is taken as long as the study runs.
  ChildProcess first(work_.folder(), words("first"));
  const std::string url = wait_for_url(first);
  const std::string port = url.substr(17, url.find('/', 17) - 17);
  const auto second =
      work_.hookpoint("study watched.hook --view --no-open --out second --port " + port);
  EXPECT_EQ(second.status, 2);
  EXPECT_EQ(second.out, "");
  EXPECT_NE(second.err.find("--port 0"), std::string::npos) << second.err;
}

}  // namespace
}  // namespace hookpoint
