// A text as a word of a command: what the shell makes of it is the text again.
#include "text/shell_word.h"

#include <gtest/gtest.h>

#include "tests/support/command.h"

namespace hookpoint::text {
namespace {

TEST(ShellWord, TheShellReadsWhatWasWritten) {
  const hookpoint::testing::Workplace place;
  for (const std::string text : {"plain", "", "two words", "it's", "'", "$HOME", "`id`", "a\\b",
                                 "*", "\"", "x;y", "#", "~"}) {
    for (const std::string& word : {shell_word(text), quoted_shell_word(text)}) {
      const std::string out = (place.folder() / "out").string();
      ASSERT_EQ(std::system(("printf %s " + word + " > '" + out + "'").c_str()), 0) << word;
      EXPECT_EQ(place.read("out"), text) << word;
    }
  }
}

TEST(ShellWord, IsQuotedOnlyWhereItMustBe) {
  EXPECT_EQ(shell_word("world.deltat=0.5"), "world.deltat=0.5");
  EXPECT_EQ(shell_word("0.5 ms"), "'0.5 ms'");
}

}  // namespace
}  // namespace hookpoint::text
