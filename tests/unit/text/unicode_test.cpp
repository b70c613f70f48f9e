// One decoder of UTF-8: what is a character, what stands for what is none, how wide it is shown.
#include <gtest/gtest.h>

#include "text/display.h"
#include "text/utf8.h"

namespace hookpoint::text {
namespace {

TEST(Utf8, IsTakenApart) {
  EXPECT_EQ(code_points("a\xc2\xb5\xe2\x88\x9e\xf0\x9f\xa6\x97"), U"a\u00b5\u221e\U0001f997");
  EXPECT_EQ(utf16("\xf0\x9f\xa6\x97"), u"\xd83e\xdd97");
}

TEST(Utf8, BrokenBytesAreReplaced) {
  EXPECT_EQ(code_points("a\xb5"), U"a\ufffd");
  EXPECT_EQ(code_points("\xe2\x88"), U"\ufffd");
  EXPECT_EQ(code_points("\xc2z"), U"\ufffdz");
  EXPECT_EQ(repaired("\xc2z\xc2\xb5"), "\xef\xbf\xbdz\xc2\xb5");
}

// The Unicode standard, table 3-7: well-formed UTF-8 byte sequences.
TEST(Utf8, IsAsStrictAsTheStandard) {
  for (const char* good : {"\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf",
                           "\xee\x80\x80", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"})
    EXPECT_EQ(first_character(good).length, std::string_view(good).size());
  for (const char* overlong : {"\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf"})
    EXPECT_EQ(first_character(overlong).length, 0u);
  EXPECT_EQ(first_character("\xed\xa0\x80").length, 0u) << "a surrogate";
  EXPECT_EQ(first_character("\xf4\x90\x80\x80").length, 0u) << "above U+10FFFF";
  EXPECT_EQ(first_character("").length, 0u);
}

TEST(Display, WidthsAreThoseOfATerminal) {
  EXPECT_EQ(display_width("a\u00b5\u221e"), 3u);
  EXPECT_EQ(display_width("\u4e16\u754c"), 4u) << "wide characters";
  EXPECT_EQ(display_width("e\u0301"), 1u) << "an accent stands on its letter";
  EXPECT_EQ(display_width("\xff\t"), 2u);
}

TEST(Display, WhatCommandsATerminalIsNotShown) {
  EXPECT_EQ(printable("a\x1b[1m\u009bz\xff"), "a?[1m??z?");
  EXPECT_EQ(printable("a\tb", true), "a\tb");
  EXPECT_EQ(printable("a\tb"), "a?b");
  EXPECT_EQ(find_control("a\u00b5\n"), 3u);
  EXPECT_EQ(find_control("a\u00b5"), std::string_view::npos);
}

TEST(Display, ACutTextEndsWithAWholeCharacter) {
  EXPECT_EQ(first_characters("a\u221eb", 3), "a");
  EXPECT_EQ(first_characters("a\u221eb", 4), "a\u221e");
  EXPECT_EQ(first_characters("a\u221eb", 9), "a\u221eb");
}

}  // namespace
}  // namespace hookpoint::text
