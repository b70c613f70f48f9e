// Plugin in the language: where it may stand, in which order libraries are handed out, and that
// nothing but the syntax is needed to know them.
#include <gtest/gtest.h>

#include "tests/support/language_files.h"

namespace hookpoint::language::testing {
namespace {

/// What load_plugins hands out for a file, and what it says.
struct Loaded {
  bool good = false;
  std::vector<std::string> libraries;  ///< file names, in order
  std::string errors;
};

Loaded load(const std::filesystem::path& file, const std::string& problem = "") {
  const Schema schema = make_schema();
  Library library(schema, {});
  Diagnostics diagnostics;
  Loaded loaded;
  loaded.good = library.load_plugins(
      file,
      [&](const std::filesystem::path& found) {
        loaded.libraries.push_back(found.filename().string());
        return problem;
      },
      diagnostics);
  std::ostringstream out;
  diagnostics.print(out, false);
  loaded.errors = out.str();
  return loaded;
}

using Names = std::vector<std::string>;

TEST(Plugin, IsFoundInEveryFileInTheOrderOfTheText) {
  const Folder folder;
  for (const char* name : {"a.so", "b.so", "deep/c.so"}) folder.write(name, "");
  folder.write("deep/leg.hook", "Param side; Plugin \"c.so\"; Plugin \"../b.so\"; Link l;");
  const auto file = folder.write(
      "main.hook",
      "Plugin \"a.so\";\n"
      "World w { For i in 0..2 { Robot r[i] { Include \"deep/leg.hook\" (side = i) leg; } } }\n"
      "Plugin \"b.so\";\n"
      "Nonsense of = any + kind;\n");
  const Loaded loaded = load(file);
  EXPECT_TRUE(loaded.good);
  EXPECT_EQ(loaded.libraries, (Names{"a.so", "c.so", "b.so"})) << "each once";
  EXPECT_EQ(loaded.errors, "") << "the evaluation says the rest";
}

TEST(Plugin, CyclesOfIncludesEnd) {
  const Folder folder;
  folder.write("a.so", "");
  folder.write("b.hook", "Include \"a.hook\"; Plugin \"a.so\";");
  EXPECT_EQ(load(folder.write("a.hook", "Include \"b.hook\"; World w;")).libraries, Names{"a.so"});
}

TEST(Plugin, InsideAnObjectALoopOrAnErrorIsNotHandedOut) {
  const Folder folder;
  folder.write("a.so", "");
  for (const char* text : {"World w { Plugin \"a.so\"; }", "For i in 0..1 { Plugin \"a.so\"; }",
                           "World Plugin \"a.so\";", "Plugin a.so;", "Plugin \"a.so\" name;",
                           "Plugin \"a.so\" { }", "Plugin;", "// Plugin \"a.so\";\nWorld w;"}) {
    EXPECT_EQ(load(folder.write("test.hook", text)).libraries, Names{}) << text;
  }
}

TEST(Plugin, WhatStandsInTheWayIsAnErrorAtItsPath) {
  const Folder folder;
  folder.write("a.so", "");
  folder.write("x.hook", "\n  Plugin \"a.so\";\nWorld w { deltat = ; }\n");
  std::filesystem::current_path(folder.path());
  const Loaded loaded = load("x.hook", "is no good");
  EXPECT_FALSE(loaded.good);
  EXPECT_EQ(loaded.errors,
            "x.hook:2:10: error: the plugin `a.so` is no good\n 2 |   Plugin \"a.so\";\n"
            "   |          ^~~~~~\n"
            "x.hook:3:20: error: expected a value, not `;`\n 3 | World w { deltat = ; }\n"
            "   |                    ^\n");
}

TEST(Plugin, IsPrintedAsAnAbsolutePathOnce) {
  const Folder folder;
  folder.write("part/a \"1\".so", "");
  folder.write("part/p.hook", "Plugin \"a \\\"1\\\".so\"; World w;");
  const auto file =
      folder.write("main.hook", "Plugin \"part/a \\\"1\\\".so\"; Include \"part/p.hook\";");
  const Evaluated tree = evaluate_file(file);
  ASSERT_NE(tree.root, nullptr) << tree.errors();
  EXPECT_EQ(print(*tree.root),
            "Plugin \"" + (folder.path() / "part/a \\\"1\\\".so").string() + "\";\nWorld w;\n");
}

TEST(Plugin, IsLaidOutLikeAnInclude) {
  EXPECT_EQ(format_text("Plugin   \"a.so\" /* why */ ;World w;"),
            "Plugin \"a.so\";  /* why */\nWorld w;\n");
}

TEST(Plugin, MistakesAreToldInItsWords) {
  EXPECT_EQ(evaluate_text("Plugin mine; World w;").messages(),
            "expected the path of a shared library in quotes, not `mine`\n");
  EXPECT_EQ(evaluate_text("World w { Plugin \"a.so\"; }").messages(),
            "a Plugin stands at the top of its file, not inside an object or a loop\n");
  EXPECT_NE(evaluate_text("Plugin \"\"; World w;").messages().find("there is no file ``"),
            std::string::npos);
}

}  // namespace
}  // namespace hookpoint::language::testing
