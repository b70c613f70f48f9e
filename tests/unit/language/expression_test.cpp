// Numbers, units, operators and functions, against values known from elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "language/units.h"
#include "tests/support/language_files.h"

namespace hookpoint::language::testing {
namespace {

/// The value of an expression in a field without a unit of its own.
double value_of(const std::string& expression, const std::string& before = "") {
  Evaluated result =
      evaluate_text(before + "Window w Valuator.Slider s value = " + expression + ";");
  EXPECT_TRUE(result.root) << result.errors();
  return result.root ? result.at("w.s").number("value") : std::numeric_limits<double>::quiet_NaN();
}

std::string error_of(const std::string& expression, const std::string& before = "") {
  const Evaluated result =
      evaluate_text(before + "Window w Valuator.Slider s value = " + expression + ";");
  return result.messages();
}

TEST(LanguageNumbers, ReadAsWritten) {
  EXPECT_EQ(value_of("12"), 12.);
  EXPECT_EQ(value_of(".5"), .5);
  EXPECT_EQ(value_of("1e-3"), 1e-3);
  EXPECT_EQ(value_of("2."), 2.);
  EXPECT_EQ(value_of("1.57"), 1.57);
  EXPECT_EQ(value_of("1.7976931348623157e308"), std::numeric_limits<double>::max());
}

TEST(LanguageUnits, AreTheDoubleNearestToTheDecimalInSi) {
  EXPECT_EQ(value_of("5 ms"), 0.005);
  EXPECT_EQ(value_of("120 g"), 0.12);
  EXPECT_EQ(value_of("2 mm"), 0.002);
  EXPECT_EQ(value_of("7 mm"), 0.007);
  EXPECT_EQ(value_of("1 %"), 0.01);
  EXPECT_EQ(value_of("30 kN/m"), 30000.);
  EXPECT_EQ(value_of("25 N.m"), 25.);
  EXPECT_EQ(value_of("100 Hz"), 100.);
  EXPECT_EQ(value_of("3 m/s"), 3.);
  EXPECT_EQ(value_of("3 km/h"), 3000. / 3600.);
  EXPECT_EQ(value_of("2 kg.m^2"), 2.);
  EXPECT_EQ(value_of("4 mm^2"), 4e-6);
  EXPECT_EQ(value_of("5 s^-2"), 5.);
  EXPECT_EQ(value_of("90 deg"), M_PI / 2.);
  EXPECT_EQ(value_of("180deg"), M_PI);
  EXPECT_DOUBLE_EQ(value_of("60 rpm"), 2. * M_PI);
}

TEST(LanguageUnits, BelongToTheNumberWhateverVariablesExist) {
  EXPECT_EQ(value_of("3 m/s", "Let s = 7; Let m = 5;"), 3.);
  EXPECT_EQ(value_of("12/s", "Let s = 4;"), 3.);
  EXPECT_EQ(value_of("(3 m/s) / (1.5 m/s)"), 2.);
}

TEST(LanguageUnits, EveryUnitHasItsDimensionAndSize) {
  EXPECT_EQ(find_unit("N")->dimension, (Dimension{1, 1, -2, 0}));
  EXPECT_EQ(find_unit("J")->dimension, find_unit("N")->dimension * find_unit("m")->dimension);
  EXPECT_EQ(find_unit("W")->dimension, find_unit("J")->dimension / find_unit("s")->dimension);
  EXPECT_EQ(find_unit("Pa")->dimension,
            find_unit("N")->dimension / power(find_unit("m")->dimension, 2));
  for (const std::string& name : unit_names()) {
    ASSERT_TRUE(parse_unit(name)) << name;
    EXPECT_GT(find_unit(name)->numerator, 0.);
  }
  EXPECT_EQ(parse_unit("N.m.s/rad")->dimension, (Dimension{1, 2, -1, -1}));
  EXPECT_EQ(parse_unit("1/m")->dimension, (Dimension{0, -1, 0, 0}));
  EXPECT_FALSE(parse_unit("N m"));
  EXPECT_FALSE(parse_unit("furlong"));
}

TEST(LanguageUnits, TextReadsBackToTheSameDimension) {
  for (int mass = -2; mass <= 2; ++mass) {
    for (int length = -2; length <= 2; ++length) {
      for (int time = -2; time <= 2; ++time) {
        for (int angle = -1; angle <= 1; ++angle) {
          const Dimension dimension{mass, length, time, angle};
          ASSERT_TRUE(parse_unit(unit_text(dimension))) << unit_text(dimension);
          EXPECT_EQ(parse_unit(unit_text(dimension))->dimension, dimension) << unit_text(dimension);
        }
      }
    }
  }
}

TEST(LanguageExpressions, FollowTheUsualPrecedence) {
  EXPECT_EQ(value_of("2 + 3 * 4"), 14.);
  EXPECT_EQ(value_of("(2 + 3) * 4"), 20.);
  EXPECT_EQ(value_of("-2^2"), -4.);
  EXPECT_EQ(value_of("2^-1"), 0.5);
  EXPECT_EQ(value_of("2^3^2"), 512.);
  EXPECT_EQ(value_of("8 / 4 / 2"), 1.);
  EXPECT_EQ(value_of("1 - 2 - 3"), -4.);
  EXPECT_EQ(value_of("- -3"), 3.);
  EXPECT_EQ(value_of("1 < 2 && 2 < 1 || 3 >= 3 ? 10 : 20"), 10.);
  EXPECT_EQ(value_of("!(1 == 1) ? 1 : 2 == 3 ? 4 : 5"), 5.);
}

TEST(LanguageExpressions, FunctionsHaveTheirTextbookValues) {
  EXPECT_EQ(value_of("cos(180 deg)"), -1.);
  EXPECT_DOUBLE_EQ(value_of("sin(pi / 6)"), 0.5);
  EXPECT_DOUBLE_EQ(value_of("tan(45 deg)"), 1.);
  EXPECT_DOUBLE_EQ(value_of("asin(1)"), M_PI / 2.);
  EXPECT_DOUBLE_EQ(value_of("acos(0)"), M_PI / 2.);
  EXPECT_DOUBLE_EQ(value_of("atan(1)"), M_PI / 4.);
  EXPECT_DOUBLE_EQ(value_of("atan2(-1 m, -1 m)"), -3. * M_PI / 4.);
  EXPECT_EQ(value_of("sqrt(9 m^2) / 1 m"), 3.);
  EXPECT_EQ(value_of("abs(-3)"), 3.);
  EXPECT_EQ(value_of("min(3, 1, 2)"), 1.);
  EXPECT_EQ(value_of("max(3, 1, 2)"), 3.);
  EXPECT_EQ(value_of("pow(2, 10)"), 1024.);
  EXPECT_DOUBLE_EQ(value_of("log(exp(2))"), 2.);
  EXPECT_EQ(value_of("floor(-1.5)"), -2.);
  EXPECT_EQ(value_of("ceil(-1.5)"), -1.);
  EXPECT_EQ(value_of("round(2.5)"), 3.);
  EXPECT_EQ(value_of("mod(7, 3)"), 1.);
  EXPECT_EQ(value_of("hypot(3 m, 4 m) / 1 m"), 5.);
}

TEST(LanguageExpressions, AnAngleAddsToAPureNumber) {
  EXPECT_DOUBLE_EQ(value_of("pi / 2 + 90 deg"), M_PI);
}

TEST(LanguageExpressions, BranchesNotTakenAreNotEvaluated) {
  EXPECT_EQ(value_of("0 == 0 ? 1 : 1 / 0"), 1.);
  EXPECT_EQ(value_of("0 != 0 && 1 / 0 > 1 ? 1 : 2"), 2.);
}

TEST(LanguageExpressions, MistakesAreNamed) {
  EXPECT_EQ(error_of("1 / 0"), "division by zero\n");
  EXPECT_EQ(error_of("0^-1"), "division by zero\n");
  EXPECT_EQ(error_of("1e308 * 10"), "the result does not fit a double (about 1e308)\n");
  EXPECT_EQ(error_of("1e400"),
            "the number `1e400` does not fit a double (about 1e-308 to 1e308)\n");
  EXPECT_EQ(error_of("sqrt(-1)"), "sqrt has no value there\n");
  EXPECT_EQ(error_of("1 m + 1 s"), "m and s cannot be added\n");
  EXPECT_EQ(error_of("1 m < 1 s ? 1 : 2"), "m and s cannot be compared\n");
  EXPECT_EQ(error_of("1 m + 1"), "m and no unit cannot be added\n");
  EXPECT_EQ(error_of("sin(1 m)"), "sin takes an angle, not a value in m\n");
  EXPECT_EQ(error_of("2^(1 m)"), "an exponent is a pure number, not one in m\n");
  EXPECT_EQ(error_of("sqrt(2 m)"), "sqrt of a value in m has no unit\n");
  EXPECT_EQ(error_of("sin(1, 2)"), "sin takes 1 argument, not 2\n");
  EXPECT_EQ(error_of("sine(1)"), "unknown function `sine`; did you mean `sin`?\n");
  EXPECT_EQ(error_of("2 * lenth", "Let length = 3;"),
            "undefined variable `lenth`; did you mean `length`?\n");
  EXPECT_EQ(error_of("3 kgg"), "unknown unit `kgg`; did you mean `kg`?\n");
  EXPECT_EQ(error_of("1 + true"), "expected a number, not true or false\n");
  EXPECT_EQ(error_of("1 + \"a\""), "a string and a number cannot be put together\n");
  EXPECT_EQ(error_of("1 ? 2 : 3"), "expected true or false, not a number\n");
}

TEST(LanguageExpressions, ALongChainNeedsNoStack) {
  std::string sum = "0";
  for (int i = 0; i < 200000; ++i) sum += "+1";
  EXPECT_EQ(value_of(sum), 200000.);
  EXPECT_EQ(value_of(std::string(100000, '-') + "1"), 1.);
}

TEST(LanguageVariables, HoldValuesListsAndWords) {
  EXPECT_EQ(value_of("x * 2", "Let x = 3;"), 6.);
  Evaluated result = evaluate_text(
      "Let p = 1, 2; Let law = ode; World w { engine = law; gravity = p, 3; } Let label = "
      "\"hello\"; Window v label = label;");
  ASSERT_TRUE(result.root) << result.errors();
  EXPECT_EQ(result.at("w").word("engine"), "ode");
  EXPECT_EQ(result.at("w").numbers("gravity"), (std::vector<double>{1., 2., 3.}));
  EXPECT_EQ(result.at("v").word("label"), "hello");
}

TEST(LanguageVariables, EndWithTheirBlockAndAreDefinedOnce) {
  EXPECT_TRUE(evaluate_text("World a { Let x = 1; } World b { Let x = 2; deltat = x; }").root);
  EXPECT_NE(evaluate_text("World a { Let x = 1; } World b { deltat = 2 * x; }")
                .messages()
                .find("undefined variable `x`"),
            std::string::npos);
  EXPECT_EQ(error_of("x", "Let x = 1; Let x = 2;"),
            "the variable `x` is defined already\ndefined here\n");
}

}  // namespace
}  // namespace hookpoint::language::testing
