// Programs that are started: words stay words, and what they say and how they end comes back.
#include <gtest/gtest.h>

#include <csignal>

#include "output/child.h"

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

}  // namespace
}  // namespace hookpoint::output
