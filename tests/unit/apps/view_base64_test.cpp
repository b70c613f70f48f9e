#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "apps/view/wire/base64.h"

namespace hookpoint::view {
namespace {

// RFC 4648, section 10.
TEST(Base64, HasTheBytesOfTheStandardsExamples) {
  const std::vector<std::pair<std::string, std::string>> examples{{"", ""},
                                                                  {"f", "Zg=="},
                                                                  {"fo", "Zm8="},
                                                                  {"foo", "Zm9v"},
                                                                  {"foob", "Zm9vYg=="},
                                                                  {"fooba", "Zm9vYmE="},
                                                                  {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : examples) {
    EXPECT_EQ(to_base64(bytes), text);
    EXPECT_EQ(from_base64(text), bytes);
  }
}

TEST(Base64, TakesEveryByteThereAndBack) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  EXPECT_EQ(from_base64(to_base64(bytes)), bytes);
  EXPECT_EQ(to_base64("\xfb\xff"), "+/8=");
}

TEST(Base64, RefusesOtherLetters) {
  EXPECT_FALSE(from_base64("Zm9*"));
  EXPECT_FALSE(from_base64("Zm=v"));
  EXPECT_FALSE(from_base64("-_8="));
}

}  // namespace
}  // namespace hookpoint::view
