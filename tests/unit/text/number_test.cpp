#include "text/number.h"

#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <random>

#include "tests/support/command.h"

namespace hookpoint::text {
namespace {

TEST(Number, ShortestReadsBackAsTheSameDouble) {
  std::mt19937_64 bits(1);
  for (int i = 0; i < 100000; ++i) {
    const auto word = bits();
    double value;
    static_assert(sizeof value == sizeof word);
    std::memcpy(&value, &word, sizeof value);
    if (value != value) continue;
    EXPECT_EQ(std::strtod(shortest(value).c_str(), nullptr), value);
  }
}

TEST(Number, ShortestIsShort) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(-3.), "-3");
  EXPECT_EQ(shortest(1e-9), "1e-09");
  EXPECT_EQ(shortest(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(shortest(-std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(Number, AnAbsentValueHasAWord) {
  EXPECT_EQ(shortest(std::optional(0.1), "-"), "0.1");
  EXPECT_EQ(shortest(std::optional<double>()), "");
  EXPECT_EQ(shortest(std::optional<double>(), "-"), "-");
  EXPECT_EQ(rounded(std::optional(0.123456789), "none", 3), "0.123");
  EXPECT_EQ(rounded(std::optional<double>(), "none", 3), "none");
}

TEST(Number, SeventeenDigitsAreThoseOfTheBinaryValue) {
  // 0.1 is 0.1000000000000000055511151231257827... in binary64.
  EXPECT_EQ(seventeen_digits(0.1), "0.10000000000000001");
  EXPECT_EQ(seventeen_digits(1.), "1");
  EXPECT_EQ(seventeen_digits(-9.81), "-9.8100000000000005");
}

TEST(Number, RoundedReadsWell) {
  EXPECT_EQ(rounded(0.), "0");
  EXPECT_EQ(rounded(12345.6), "12346");
  EXPECT_EQ(rounded(3.14159265), "3.142");
  EXPECT_EQ(rounded(2.1e-16), "2.1e-16");
  EXPECT_EQ(rounded(-0.000123456), "-0.0001235");
}

TEST(Number, TheLocaleDoesNotMatter) {
  // Compiled here from the package's sources of locales.
  const testing::Workplace work;
  const std::string compile = "localedef -i de_DE -f UTF-8 '" +
                              (work.folder() / "de_DE.UTF-8").string() + "' >/dev/null 2>&1";
  ASSERT_EQ(std::system(compile.c_str()), 0)
      << "localedef finds no de_DE: scripts/setup test installs the package locales";
  const std::string before = std::setlocale(LC_ALL, nullptr);
  setenv("LOCPATH", work.folder().c_str(), 1);
  ASSERT_NE(std::setlocale(LC_ALL, "de_DE.UTF-8"), nullptr);
  std::array<char, 8> with_comma{};
  std::snprintf(with_comma.data(), with_comma.size(), "%g", 0.5);
  EXPECT_STREQ(with_comma.data(), "0,5");
  EXPECT_EQ(shortest(0.5), "0.5");
  EXPECT_EQ(seventeen_digits(0.5), "0.5");
  EXPECT_EQ(rounded(0.5), "0.5");
  std::setlocale(LC_ALL, before.c_str());
  unsetenv("LOCPATH");
}

}  // namespace
}  // namespace hookpoint::text
