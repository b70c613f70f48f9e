// A movie in the window, seen by a client that is no browser: its moments and its plots are those
// of the run that wrote it.
// ctest: clock
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <memory>
#include <sstream>

#include "tests/support/child_process.h"
#include "tests/support/command.h"
#include "tests/support/pendulum_movie.h"
#include "tests/support/window_client.h"

namespace hookpoint {
namespace {

using testing::ChildProcess;
using testing::WindowClient;
using testing::Workplace;

constexpr const char* trails =
    "world.pendulum.arm.rod.angle,world.pendulum.arm.rod.acceleration,"
    "world.pendulum.arm.rod.total_torque,pd.output,pd.current";

/// "a,b" as JSON.
std::string json_list(const std::string& list) {
  std::string text = "\"";
  for (const char letter : list) letter == ',' ? text += "\", \"" : text += letter;
  return "[" + text + "\"]";
}

class ReplayWindow : public ::testing::Test {
 protected:
  /// A run of the scene with a movie of that rate, then the movie in the window.
  void open(const std::string& rate) {
    place.file("scene.hook",
               std::string(testing::pendulum_scene) + "Movie film { rate = " + rate + "; }\n");
    const auto run = place.hookpoint("run scene.hook --out run --record " + std::string(trails));
    ASSERT_EQ(run.status, 0) << run.err;
    show("run/film.h5");
  }
  void show(const std::string& movie) {
    program = std::make_unique<ChildProcess>(
        place.folder(), std::vector<std::string>{"replay", movie, "--no-open"});
    ASSERT_TRUE(program->wait_until([&] { return program->out().ends_with('\n'); }))
        << program->err();
    client = std::make_unique<WindowClient>(program->out());
  }
  /// Values by `read`, in the order of `trails`.
  std::vector<double> values(const std::string& answer) {
    std::vector<double> all;
    const auto leaves = text::json_leaves(answer);
    if (!leaves) return all;
    for (const auto& [path, value] : *leaves)
      if (path.ends_with("].value")) all.push_back(std::stod(value));
    return all;
  }
  /// The rows of the run's record, the time first.
  std::vector<std::vector<double>> rows() {
    std::vector<std::vector<double>> all;
    std::istringstream lines(place.read("run/trace.csv"));
    for (std::string line; std::getline(lines, line);) {
      if (line.empty() || (line[0] != '-' && std::isdigit(line[0]) == 0)) continue;
      std::istringstream cells(line);
      std::vector<double> row;
      for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
      all.push_back(row);
    }
    return all;
  }

  Workplace place;
  std::unique_ptr<ChildProcess> program;
  std::unique_ptr<WindowClient> client;
};

TEST_F(ReplayWindow, EveryMomentIsThatOfTheRun) {
  for (const char* rate : {"1000 Hz", "7 Hz"}) {
    open(rate);
    const auto record = rows();
    ASSERT_EQ(record.size(), 1001U);
    // There and back again, time 0 included.
    for (const std::size_t step : {500U, 0U, 1000U, 501U, 142U, 143U, 1U, 0U, 999U}) {
      const std::string time = std::to_string(static_cast<double>(step) / 1000.);
      EXPECT_NE(client->ask("seek", "\"time\": " + time).find("\"ok\": true"), std::string::npos);
      const std::string answer = client->ask("read", "\"trails\": " + json_list(trails));
      EXPECT_EQ(values(answer), std::vector(record[step].begin() + 1, record[step].end()))
          << rate << ' ' << time << '\n'
          << answer;
    }
  }
}

TEST_F(ReplayWindow, ATraceIsTheRecordOfTheRun) {
  for (const char* rate : {"1000 Hz", "7 Hz"}) {
    open(rate);
    const auto record = rows();
    std::vector<double> numbers;
    // A movie may answer with what it has read so far: it is asked again until it has come to the
    // end.
    const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    for (double from = 0.; from < 0.9995;) {
      ASSERT_LT(std::chrono::steady_clock::now(), until) << "read up to " << from << " s";
      const auto part = client->ask_trace("\"trails\": " + json_list(trails) + ", \"from\": " +
                                          std::to_string(from) + ", \"to\": 1, \"points\": 5000");
      ASSERT_GE(part.size(), 2U);
      ASSERT_EQ(part[0], 5.);
      const auto count = static_cast<std::size_t>(part[1]);
      if (count == 0) continue;
      from = part[1 + count] + 0.0005;
      numbers = part;
      if (count != record.size()) continue;
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t column = 0; column <= 5; ++column)
          ASSERT_EQ(part[2 + column * count + i], record[i][column]) << i << ' ' << column;
    }
    EXPECT_EQ(numbers.size(), 2 + 6 * record.size()) << "the whole record in one answer";
  }
}

// The movie has no such trails: they cost no reading, and do not hold up those that it has.
TEST_F(ReplayWindow, ATraceOfWhatIsNotThereIsNoNumber) {
  open("50 Hz");
  const std::string known = "world.pendulum.arm.rod.angle";
  const std::string rest = ", \"from\": 0, \"to\": 1, \"points\": 5000";
  const auto several = client->ask_trace("\"trails\": " + json_list("no.such," + known) + rest);
  ASSERT_GE(several.size(), 2U);
  const auto count = static_cast<std::size_t>(several[1]);
  ASSERT_EQ(several.size(), 2 + 3 * count);
  ASSERT_GT(count, 0U);
  EXPECT_TRUE(std::isnan(several[2 + count]));
  EXPECT_FALSE(std::isnan(several[2 + 2 * count]));
  std::string many = known;
  for (int i = 0; i < 255; ++i) many += ",no.such" + std::to_string(i);
  EXPECT_EQ(client->ask_trace("\"trails\": " + json_list(many) + rest)[0], 256.);
  const std::string answer = client->ask("trace", "\"trails\": " + json_list(many + ",one.more"));
  EXPECT_NE(answer.find("at most 256 trails"), std::string::npos) << answer;
}

TEST_F(ReplayWindow, APictureIsPutBesideWhatIsThere) {
  open("50 Hz");
  const std::string header = "iVBORw0KGgo";  // the eight bytes of every PNG, and no more
  for (const char* name : {"view.png", "view-2.png", "view-3.png"}) {
    const std::string answer =
        client->ask("picture", "\"name\": \"view.png\", \"png\": \"" + header + "=\"");
    EXPECT_NE(answer.find(std::string("run/") + name), std::string::npos) << answer;
    EXPECT_EQ(place.read(std::string("run/") + name), "\x89PNG\r\n\x1a\n");
    place.file(std::string("run/") + name, "of a user");
  }
  EXPECT_EQ(place.read("run/view.png"), "of a user");
}

TEST_F(ReplayWindow, ItPlaysStepsAndEnds) {
  open("50 Hz");
  EXPECT_EQ(client->snapshot()[4], 0.);
  client->ask("step", "\"count\": 3");
  EXPECT_EQ(client->snapshot()[3], 3.);
  client->ask("speed", "\"factor\": 0");
  client->ask("run");
  const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  std::vector<double> snapshot = client->snapshot();
  const auto stands_at_its_end = [&] {
    return snapshot[3] == 1000. && (static_cast<int>(snapshot[5]) & 1) != 0;
  };
  while (!stands_at_its_end()) {
    ASSERT_LT(std::chrono::steady_clock::now(), until) << "at step " << snapshot[3];
    snapshot = client->snapshot();
    ASSERT_GE(snapshot.size(), 6U) << "the connection ended";
  }
  // From its end it begins again.
  client->ask("speed", "\"factor\": 0.1");
  client->ask("run");
  EXPECT_LT(client->snapshot()[4], 0.5);
  client->ask("pause");
  const double stands = client->snapshot()[4];
  EXPECT_EQ(client->snapshot()[4], stands);
  client->ask("reset");
  EXPECT_EQ(client->snapshot()[4], 0.);
}

TEST_F(ReplayWindow, NothingIsChanged) {
  open("50 Hz");
  const std::string refused = "a movie is not changed: `hookpoint run --resume";
  EXPECT_NE(client->ask("set", "\"values\": {\"pd.goal\": 1}").find(refused), std::string::npos);
  EXPECT_NE(client->ask("edit", "\"trail\": \"pd.pconstant\", \"value\": \"5\"").find(refused),
            std::string::npos);
  EXPECT_NE(client->ask("patch").find(refused), std::string::npos);
  EXPECT_NE(client->ask("fields").find("\"fields\": []"), std::string::npos);
  EXPECT_EQ(client->ask("trails", "\"pattern\": \"pd.*\"").find("\"writable\": true"),
            std::string::npos);
}

TEST_F(ReplayWindow, TheUrlIsAllThatItPrintsAndASignalEndsIt) {
  open("50 Hz");
  EXPECT_EQ(program->out().find("http://127.0.0.1:"), 0U);
  EXPECT_EQ(program->out().find('\n'), program->out().size() - 1);
  WindowClient other(program->out());
  const std::string description = other.wait_for("\"tell\": \"description\"");
  for (const char* has : {"\"kind\": \"movie\"", "\"look.eye\"", "\"look.way\"", "\"Window\""})
    EXPECT_NE(description.find(has), std::string::npos) << has;
  program->signal(SIGINT);
  EXPECT_EQ(program->wait(), 0);
}

}  // namespace
}  // namespace hookpoint
