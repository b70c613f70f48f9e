// What a short file may ask for: one diagnostic, soon, and no more memory than the budget allows.
#include "language/values/budget.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <limits>

#include "tests/support/allocation_counter.h"
#include "tests/support/language_files.h"

namespace hookpoint::language::testing {
namespace {

/// The most memory that this process ever had [kB].
long most_memory() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss;
}

std::string doubled_lists(int times) {
  std::string text = "Let a0 = 1, 2;\n";
  for (int i = 1; i <= times; ++i) {
    const std::string before = "a" + std::to_string(i - 1);
    text += "Let a" + std::to_string(i) + " = " + before + ", " + before + ";\n";
  }
  return text + "World w;\n";
}

TEST(LanguageBudget, AListThatDoublesIsRefusedBeforeItIsMade) {
  const long before = most_memory();
  const Evaluated result = evaluate_text(doubled_lists(40));
  EXPECT_FALSE(result.root);
  EXPECT_EQ(result.diagnostics.error_count(), 1U) << result.errors();
  // 2 + 4 + ... + 2^20 = 2^21 - 2 values stand before a20, which asks for 2^21 more, half at a
  // time.
  EXPECT_NE(result.errors().find(":21:16: error:"), std::string::npos) << result.errors();
  EXPECT_NE(result.messages().find("the file requires more than 4000000 values in lists"),
            std::string::npos);
  EXPECT_LT(most_memory() - before, 2'000'000) << "four million values and no more";
}

TEST(LanguageBudget, ALongTextCountsAsManyValues) {
  const std::string text = "Let s = \"" + std::string(1'000'000, 'x') +
                           "\";\nFor i in 1..100000 { Let t = s; }\nWorld w;\n";
  EXPECT_NE(evaluate_text(text).messages().find("values in lists"), std::string::npos);
  const std::string compared = "Let s = \"" + std::string(1'000'000, 'x') +
                               "\";\nFor i in 1..100000 { Let t = s == s; }\nWorld w;\n";
  EXPECT_NE(evaluate_text(compared).messages().find("steps of evaluation"), std::string::npos);
}

TEST(LanguageBudget, ObjectsAndWiresAreCountedTogether) {
  const Evaluated objects =
      evaluate_text("World w { For i in 1..900000 { Material m[i] { static_friction = .5; } } }");
  EXPECT_EQ(objects.diagnostics.error_count(), 1U) << objects.errors();
  EXPECT_NE(objects.messages().find("more than 200000 objects and wires"), std::string::npos);
  const Evaluated wires = evaluate_text("World w { For i in 1..900000 { Wire FROM a TO b; } }");
  EXPECT_NE(wires.messages().find("more than 200000 objects and wires"), std::string::npos)
      << wires.errors();
}

/// Allocations that `item` costs in each round of a loop.
double allocations_a_round(const std::string& item) {
  constexpr int rounds = 1000;
  const auto cost = [&item](int end) {
    const std::string last = std::to_string(end);
    const long before = hookpoint::testing::allocation_count();
    const Evaluated result = evaluate_text("World w { For i in 1.." + last + " { " + item + " } }");
    EXPECT_EQ(result.diagnostics.error_count(), 1U) << result.errors();
    return static_cast<double>(hookpoint::testing::allocation_count() - before);
  };
  return (cost(3 * rounds) - cost(rounds)) / (2. * rounds);
}

TEST(LanguageBudget, AMistakeInALoopCostsItsHintOnce) {
  // The nearest name to a wrong one is looked for among some forty, three allocations each.
  EXPECT_LT(allocations_a_round("Bad x[i];"), 20.);
  EXPECT_LT(allocations_a_round("Material x[i] { static_frictoin = 1; }"), 20.);
  EXPECT_LT(allocations_a_round("Let a = worl + 1;"), 20.);
  EXPECT_LT(allocations_a_round("Terrain.Flat g[i] { material = cly; }"), 20.);
}

TEST(LanguageBudget, IncludesInALoopAreCounted) {
  const Folder folder;
  folder.write("clay.hook", "Material clay;");
  const auto file =
      folder.write("test.hook", "World w { For i in 1..1000000 { Include \"clay.hook\" m[i]; } }");
  EXPECT_NE(evaluate_file(file).messages().find("steps of evaluation"), std::string::npos);
}

TEST(LanguageBudget, APipeOrADeviceIsNoFile) {
  const Folder folder;
  ASSERT_EQ(mkfifo((folder.path() / "pipe.hook").c_str(), 0600), 0);
  std::filesystem::create_directory(folder.path() / "folder.hook");
  for (const std::string name : {"pipe.hook", "/dev/zero"}) {
    const auto file = folder.write("test.hook", "World w; Include \"" + name + "\";");
    const Evaluated result = evaluate_file(file);
    EXPECT_NE(result.messages().find("this is a pipe or a device, expected a file"),
              std::string::npos)
        << result.errors();
    EXPECT_NE(result.errors().find("test.hook:1:10: note: included here"), std::string::npos)
        << result.errors();
  }
  const auto file = folder.write("test.hook", "World w; Include \"folder.hook\";");
  EXPECT_NE(evaluate_file(file).messages().find("this is a folder, expected a file"),
            std::string::npos);
  EXPECT_NE(evaluate_file(folder.path() / "pipe.hook").messages().find("a pipe or a device"),
            std::string::npos);
}

TEST(LanguageBudget, TooManyIsSaidInOneWay) {
  EXPECT_EQ(too_many(3e12, 1'000'000, "runs"), "3e+12 runs, more than the 1000000 allowed");
  EXPECT_EQ(too_many(1'500'002., 1'000'000, "points"),
            "1.5e+06 points, more than the 1000000 allowed");
  EXPECT_EQ(too_many(std::numeric_limits<double>::infinity(), 10, "runs"),
            "inf runs, more than the 10 allowed");
}

}  // namespace
}  // namespace hookpoint::language::testing
