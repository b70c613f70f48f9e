// Programs that are started: words stay words, and what they say and how they end comes back.
// ctest: clock
#include "output/files/child.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

namespace hookpoint::output {
namespace {

TEST(Child, TakesItsWordsAsTheyAre) {
  const std::string word = "a b;'\"$(touch stolen)`x`\n\\";
  const auto result = run_program("printf", {"%s|", word, ""}, "/");
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->status, 0);
  EXPECT_EQ(result->output, word + "||");
}

TEST(Child, RunsInItsFolderWithNothingToReadAndTheUsualSignals) {
  std::signal(SIGPIPE, SIG_IGN);
  const auto result = run_program("sh", {"-c", "pwd; cat; echo $LC_ALL; kill -PIPE $$"}, "/usr");
  std::signal(SIGPIPE, SIG_DFL);
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->output, "/usr\nC\n");
  EXPECT_EQ(result->status, 128 + SIGPIPE);
}

TEST(Child, BothStreamsAndTheStatusComeBack) {
  const auto result = run_program("sh", {"-c", "echo out; echo err >&2; exit 7"}, "/");
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->output, "out\nerr\n");
  EXPECT_EQ(result->status, 7);
  EXPECT_FALSE(run_program("no-such-program-anywhere", {}, "/").has_value());
}

TEST(Child, ItsStreamsComeApartWhereAsked) {
  const auto result =
      run_program("sh", {"-c", "echo out; echo err >&2; exit 3"}, "/", {.errors_apart = true});
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result->output, "out\n");
  EXPECT_EQ(result->errors, "err\n");
  EXPECT_EQ(result->status, 3);
  EXPECT_FALSE(result->stopped);
}

TEST(Child, IsStoppedWhereItsCallerIsInterrupted) {
  using namespace std::chrono;
  std::atomic<bool> stop{false};
  const auto start = steady_clock::now();
  std::thread interrupts([&] {
    std::this_thread::sleep_for(100ms);
    stop = true;
  });
  const auto result = run_program("sleep", {"60"}, "/", {.stop = &stop});
  interrupts.join();
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(result->stopped);
  EXPECT_LT(steady_clock::now() - start, 30s);
  stop = false;
  const auto whole = run_program("sh", {"-c", "sleep 0.5; echo out"}, "/", {.stop = &stop});
  EXPECT_EQ(whole->output, "out\n");
  EXPECT_FALSE(whole->stopped);
}

/// Alive or not, with its streams open or closed, and with a program of its own that waits.
TEST(Child, IsStoppedWithAllThatItStartedBeyondItsLimits) {
  using namespace std::chrono;
  for (const char* script : {"sleep 60", "exec >&- 2>&-; sleep 60", "sleep 60 & wait"}) {
    const auto start = steady_clock::now();
    const auto result = run_program("sh", {"-c", script}, "/", {.most_seconds = 0.2});
    ASSERT_TRUE(result.has_value());
    EXPECT_TRUE(result->stopped) << script;
    EXPECT_EQ(result->status, 128 + SIGKILL) << script;
    EXPECT_LT(steady_clock::now() - start, 30s);
  }
  const auto talker = run_program("sh", {"-c", "while :; do echo words; done"}, "/",
                                  {.most_seconds = 60., .most_bytes = 1000});
  ASSERT_TRUE(talker.has_value());
  EXPECT_TRUE(talker->stopped);
  const auto quick = run_program("true", {}, "/", {.most_seconds = 60.});
  ASSERT_TRUE(quick.has_value());
  EXPECT_FALSE(quick->stopped);
  EXPECT_EQ(quick->status, 0);
}

}  // namespace
}  // namespace hookpoint::output
