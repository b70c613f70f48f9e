#include "output/files/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

namespace hookpoint::output {
namespace {

TEST(Progress, TimeLeftIsInProportion) {
  // A quarter in 30 s leaves three quarters, 90 s.
  EXPECT_EQ(progress_line("creep", 25, 100, 30.),
            "creep  [#######-----------------------]  25 %  25/100  1 min 30 s left");
  EXPECT_EQ(progress_line("creep", 0, 100, 0.),
            "creep  [------------------------------]   0 %  0/100");
  EXPECT_EQ(progress_line("creep", 100, 100, 61.),
            "creep  [##############################] 100 %  100/100  in 1 min 01 s");
}

TEST(Progress, ResumedPiecesSayNothingAboutSpeed) {
  // 50 of 100 were there; 10 more took 5 s, so 40 take 20 s.
  EXPECT_NE(progress_line("creep", 60, 100, 5., 50).find("20 s left"), std::string::npos);
}

TEST(Progress, OfARunIsItsSimulatedTime) {
  // A quarter of the way from 2 s to 10 s is 4 s; the rest takes three times as long.
  EXPECT_EQ(time_progress_line("w", 4., 2., 10., 30.),
            "w  [#######-----------------------]  25 %  4/10 s  1 min 30 s left");
  EXPECT_EQ(time_progress_line("w", 2., 2., 10., 5.),
            "w  [------------------------------]   0 %  2/10 s");
  EXPECT_EQ(time_progress_line("w", 0.01, 0., 0.01, 61.),
            "w  [##############################] 100 %  0.01/0.01 s  in 1 min 01 s");
}

TEST(Progress, DurationsReadWell) {
  EXPECT_EQ(duration_text(0.2), "1 s");
  EXPECT_EQ(duration_text(200.), "3 min 20 s");
  EXPECT_EQ(duration_text(7500.), "2 h 05 min");
}

std::string written_by(int threads, int pieces_each) {
  std::FILE* file = std::tmpfile();
  {
    Progress progress("creep", static_cast<std::size_t>(threads * pieces_each), 0, file);
    std::vector<std::jthread> workers;
    for (int i = 0; i < threads; ++i)
      workers.emplace_back([&] {
        for (int k = 0; k < pieces_each; ++k) progress.advance();
      });
  }
  std::string text(static_cast<std::size_t>(std::ftell(file)), ' ');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

TEST(Progress, OffATerminalALineEveryTenth) {
  const std::string text = written_by(4, 250);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(text.find('\033'), std::string::npos);
  EXPECT_NE(text.find("1000/1000"), std::string::npos);
}

}  // namespace
}  // namespace hookpoint::output
