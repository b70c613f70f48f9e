// Colours and redrawn lines: on a terminal that can, unless the user does not want them.
#include "text/terminal.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

namespace hookpoint::text {
namespace {

class Terminal : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_GE(master_, 0);
    ASSERT_EQ(grantpt(master_), 0);
    ASSERT_EQ(unlockpt(master_), 0);
    terminal_ = ::open(ptsname(master_), O_RDWR | O_NOCTTY);
    ASSERT_GE(terminal_, 0);
    ::setenv("TERM", "xterm", 1);
    ::unsetenv("NO_COLOR");
  }
  void TearDown() override {
    ::close(terminal_);
    ::close(master_);
  }
  int master_ = posix_openpt(O_RDWR | O_NOCTTY), terminal_ = -1;
};

TEST_F(Terminal, IsColoured) {
  EXPECT_TRUE(is_able_terminal(terminal_));
  EXPECT_TRUE(wants_colours(terminal_));
}

TEST_F(Terminal, IsNotColouredAgainstTheUsersWish) {
  ::setenv("NO_COLOR", "1", 1);
  EXPECT_FALSE(wants_colours(terminal_));
  EXPECT_TRUE(is_able_terminal(terminal_)) << "a bar is no colour";
  ::setenv("NO_COLOR", "", 1);
  EXPECT_TRUE(wants_colours(terminal_)) << "no-color.org: when not empty";
}

TEST_F(Terminal, ThatIsDumbIsWrittenToLikeAFile) {
  ::setenv("TERM", "dumb", 1);
  EXPECT_FALSE(is_able_terminal(terminal_));
  EXPECT_FALSE(wants_colours(terminal_));
  ::unsetenv("TERM");
  EXPECT_FALSE(wants_colours(terminal_));
}

TEST_F(Terminal, IsNoFile) {
  const int file = ::open("/dev/null", O_WRONLY);
  EXPECT_FALSE(wants_colours(file));
  ::close(file);
}

}  // namespace
}  // namespace hookpoint::text
