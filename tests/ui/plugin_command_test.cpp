// Plugins as a user meets them: who may run, what is said of each that cannot, and that a class of
// a plugin is a class like any other once it is loaded.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "control/plugin/plugin_abi.h"
#include "tests/support/command.h"
#include "tests/support/folders.h"

namespace hookpoint {
namespace {

using testing::CommandResult;
using testing::Workplace;
namespace fs = std::filesystem;

const fs::path built = fs::path(testing::build_folder()) / "tests/plugins";

/// A ball in free fall and a class of the plugin `good` that doubles its height.
constexpr const char* doubled_height = R"(Plugin "libmine.so";
World w {
  gravity = 9.81; deltat = 1 ms; duration = 5 ms;
  Robot ball { Base.mobile { location = 0, 0, 100; mass = 1; inertia = 1, 1, 1, 0, 0, 0; } }
}
Test.Doubler twice Wire FROM w.ball.base.location.z TO in;
)";

class PluginCommand : public ::testing::Test {
 protected:
  void SetUp() override { unsetenv("HOOKPOINT_TRUSTED_PLUGINS"); }
  void TearDown() override { unsetenv("HOOKPOINT_TRUSTED_PLUGINS"); }

  void copy(const std::string& plugin, const std::string& to = "libmine.so") const {
    fs::create_directories((place.folder() / to).parent_path());
    fs::copy_file(built / ("libplugin_" + plugin + ".so"), place.folder() / to);
  }
  std::string here() const { return fs::canonical(place.folder()).string(); }
  bool code_ran() const { return fs::exists(place.folder() / "ran"); }

  Workplace place;
};

/// What is said, whole, of the Plugin on line 1 of run.hook.
std::string said(const std::string& message) {
  return "run.hook:1:8: error: " + message +
         "\n 1 | Plugin \"libmine.so\";\n   |        ^~~~~~~~~~~~\n";
}

std::string refusal(const std::string& folder) {
  return "the plugin `libmine.so` is refused, since it would run with all of your rights: allow it "
         "with --allow-plugins, or put its folder `" +
         folder + "` into HOOKPOINT_TRUSTED_PLUGINS";
}

TEST_F(PluginCommand, NoCommandRunsItWithoutPermission) {
  copy("good");
  place.file("run.hook", doubled_height);
  place.file("study.hook",
             "Study s { scene = \"run.hook\"; duration = 5 ms; Subject dts { engine = dts; } }");
  for (const char* command : {"check run.hook", "print run.hook", "run run.hook --out out",
                              "run run.hook --for 1ms", "dynamics run.hook", "run.hook"}) {
    const CommandResult result = place.hookpoint(command);
    EXPECT_EQ(result.status, 2) << command;
    EXPECT_EQ(result.out, "") << command;
    EXPECT_EQ(result.err, said(refusal(here()))) << command;
  }
  const CommandResult study = place.hookpoint("study study.hook --out out");
  EXPECT_EQ(study.status, 2);
  EXPECT_NE(study.err.find(said(refusal(here()))), std::string::npos) << study.err;
  const CommandResult describe = place.hookpoint("describe Test.Doubler --plugin libmine.so");
  EXPECT_EQ(describe.status, 2);
  EXPECT_EQ(describe.err, "hookpoint: error: " + refusal(here()) + "\n");
  EXPECT_FALSE(code_ran());
  EXPECT_FALSE(fs::exists(place.folder() / "out"));
}

TEST_F(PluginCommand, FormattingLoadsNothing) {
  copy("good");
  place.file("run.hook", "Plugin   \"libmine.so\" ;  World w{}");
  EXPECT_EQ(place.hookpoint("fmt run.hook").status, 0);
  EXPECT_EQ(place.read("run.hook"), "Plugin \"libmine.so\";\nWorld w {}\n");
  EXPECT_FALSE(code_ran());
}

TEST_F(PluginCommand, ItsClassIsAClassLikeAnyOther) {
  copy("good");
  place.file("run.hook", doubled_height);
  EXPECT_EQ(place.hookpoint("check run.hook --allow-plugins").out, "run.hook: fine\n");
  EXPECT_TRUE(code_ran());
  const CommandResult run =
      place.hookpoint("run.hook --allow-plugins --for 2ms --record twice.output --out out");
  ASSERT_EQ(run.status, 0) << run.err;
  // Free fall by semi-implicit Euler: z = 100 - g dt^2 k (k + 1)/2 after k steps.
  EXPECT_EQ(place.read("out/trace.csv").find("time [s],twice.output\n0,200\n0.001,199.99998038"),
            0U)
      << place.read("out/trace.csv");
  const CommandResult misspelt = place.hookpoint("run run.hook --allow-plugins --set twice.inn=1");
  EXPECT_NE(misspelt.err.find("`inn`"), std::string::npos) << misspelt.err;
  const CommandResult describe =
      place.hookpoint("describe Test.Doubler --plugin libmine.so --allow-plugins");
  EXPECT_EQ(describe.status, 0) << describe.err;
  EXPECT_NE(describe.out.find("from the plugin: " + here() + "/libmine.so"), std::string::npos)
      << describe.out;
  EXPECT_EQ(place.hookpoint("dynamics run.hook --allow-plugins").status, 0);
}

TEST_F(PluginCommand, ItsFamilyMayStandWhereComponentsMay) {
  copy("good");
  std::string text = doubled_height;
  const std::string object = "Test.Doubler twice Wire FROM w.ball.base.location.z TO in;\n";
  text.erase(text.find(object));
  text.insert(text.find("Base.mobile"), "Test.Doubler twice Wire FROM base.location.z TO in; ");
  place.file("run.hook", text);
  const CommandResult result = place.hookpoint("check run.hook --allow-plugins");
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(PluginCommand, ThePrintedExperimentFindsItFromAnywhere) {
  copy("good", "lib/libmine.so");
  place.file("run.hook", std::string(doubled_height).replace(8, 0, "lib/"));
  const CommandResult printed = place.hookpoint("print run.hook --allow-plugins");
  EXPECT_EQ(printed.out.substr(0, printed.out.find('\n')),
            "Plugin \"" + here() + "/lib/libmine.so\";");
  fs::create_directory(place.folder() / "elsewhere");
  place.file("elsewhere/printed.hook", printed.out);
  const CommandResult again = place.hookpoint("print elsewhere/printed.hook --allow-plugins");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out, printed.out);
}

TEST_F(PluginCommand, AStudyOfItsSceneRunsAndIsAnotherWithAnotherBuild) {
  copy("good");
  place.file("run.hook", doubled_height);
  place.file("study.hook", R"(Study fall {
  scene = "run.hook"; duration = 5 ms; settle = 1 ms;
  Subject dts { engine = dts; }
  Measure energy_gain;
})");
  const auto studies = [&] {
    EXPECT_EQ(place.hookpoint("study study.hook --allow-plugins --jobs 1").status, 0)
        << place.read(".err");
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(place.folder() / "runs"))
      folders.push_back(entry.path());
    return folders;
  };
  const std::vector<fs::path> one = studies();
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NE(place.read(one[0] / "scene.hook").find("Plugin \"" + here() + "/libmine.so\";"),
            std::string::npos);
  EXPECT_EQ(studies().size(), 1U) << "the same bytes, the same study";
  place.file("libmine.so", place.read("libmine.so") + "a byte more");
  EXPECT_EQ(studies().size(), 2U);
}

TEST_F(PluginCommand, ATrustedFolderIsTrustedToItsBottomAndNoFurther) {
  copy("good", "trusted/deep/libmine.so");
  copy("good", "trusted-not/libmine.so");
  const auto status = [&](const std::string& library) {
    std::string text = doubled_height;
    place.file("run.hook", text.replace(8, std::string("libmine.so").size(), library));
    return place.hookpoint("check run.hook").status;
  };
  setenv("HOOKPOINT_TRUSTED_PLUGINS", (":/nowhere:" + here() + "/trusted").c_str(), 1);
  EXPECT_EQ(status("trusted/deep/libmine.so"), 0);
  EXPECT_EQ(status("trusted-not/libmine.so"), 2);
  EXPECT_EQ(status("trusted/../trusted-not/libmine.so"), 2);
  fs::create_symlink(place.folder() / "trusted-not/libmine.so", place.folder() / "trusted/link.so");
  EXPECT_EQ(status("trusted/link.so"), 2) << "a link leads out of the folder";
  fs::create_symlink(place.folder() / "trusted/deep/libmine.so", place.folder() / "inward.so");
  EXPECT_EQ(status("inward.so"), 0);
  setenv("HOOKPOINT_TRUSTED_PLUGINS", "", 1);
  EXPECT_EQ(status("trusted/deep/libmine.so"), 2);
}

TEST_F(PluginCommand, NamedByTwoFilesItIsLoadedOnce) {
  copy("good");
  place.file("part.hook", "Plugin \"libmine.so\";\nTest.Doubler inner;\n");
  place.file("run.hook", std::string(doubled_height) + "Include \"part.hook\" part;\n");
  const CommandResult printed = place.hookpoint("print run.hook --allow-plugins");
  EXPECT_EQ(printed.status, 0) << printed.err;
  EXPECT_EQ(printed.out.find("Plugin", 1), std::string::npos) << printed.out;
}

TEST_F(PluginCommand, AnIncludedPluginIsRefusedWhereItStands) {
  copy("good");
  place.file("part.hook", "Plugin \"libmine.so\";\nTest.Doubler inner;\n");
  place.file("run.hook", "World w;\nInclude \"part.hook\" part;\n");
  const CommandResult result = place.hookpoint("check run.hook");
  EXPECT_EQ(result.err, "part.hook" + said(refusal(here())).substr(std::string("run.hook").size()) +
                            "run.hook:2:1: note: included here\n 2 | Include \"part.hook\" part;\n"
                            "   | ^~~~~~~\n");
  EXPECT_FALSE(code_ran());
}

TEST_F(PluginCommand, TwoPluginsOfOneClassAreNamedBoth) {
  copy("good", "liba.so");
  copy("good", "libmine.so");
  place.file("run.hook", "Plugin \"libmine.so\";\nWorld w;\n");
  place.file("both.hook", "Plugin \"liba.so\";\nInclude \"run.hook\";\n");
  const CommandResult result = place.hookpoint("check both.hook --allow-plugins");
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(
      result.err,
      said("the plugin `libmine.so` cannot join the program: class 'Test.Doubler' of '" + here() +
           "/libmine.so' is refused: '" + here() + "/liba.so' has one of that name") +
          "both.hook:2:1: note: included here\n 2 | Include \"run.hook\";\n   | ^~~~~~~\n");
}

TEST_F(PluginCommand, OfARefusedPluginNoClassStays) {
  copy("taken");
  place.file("run.hook", "Plugin \"libmine.so\";\nWorld w;\n");
  place.file("next.hook", "Test.Second left;\n");
  const CommandResult result = place.hookpoint("check run.hook next.hook --allow-plugins");
  EXPECT_NE(result.err.find("unknown class `Test.Second`"), std::string::npos) << result.err;
}

TEST_F(PluginCommand, InsideAnObjectItIsNotLoaded) {
  copy("good");
  place.file("run.hook", "World w { Plugin \"libmine.so\"; }");
  const CommandResult result = place.hookpoint("check run.hook --allow-plugins");
  EXPECT_EQ(result.err,
            "run.hook:1:11: error: a Plugin stands at the top of its file, not inside an object or "
            "a loop\n 1 | World w { Plugin \"libmine.so\"; }\n   |           ^~~~~~\n");
  EXPECT_FALSE(code_ran());
}

TEST_F(PluginCommand, SyntaxErrorsAreToldBesideIt) {
  place.file("libmine.so", "not a library");
  place.file("run.hook", "Plugin \"libmine.so\";\nWorld w { deltat = ; }\nUnknown u;\n");
  const CommandResult result = place.hookpoint("check run.hook --allow-plugins");
  EXPECT_EQ(result.err.find(said("the plugin `libmine.so` is no shared library")), 0U)
      << result.err;
  EXPECT_NE(result.err.find("run.hook:2:20: error: expected"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("Unknown"), std::string::npos) << "it may be a class of the plugin's";
}

struct WrongPlugin {
  std::string name;     ///< of tests/plugins
  std::string message;  ///< after "the plugin `libmine.so` "; HERE stands for the folder
};

class WrongPluginTest : public PluginCommand, public ::testing::WithParamInterface<WrongPlugin> {};

TEST_P(WrongPluginTest, IsToldAtItsPlace) {
  copy(GetParam().name);
  place.file("run.hook", doubled_height);
  std::string message = "the plugin `libmine.so` " + GetParam().message;
  if (const std::size_t at = message.find("HERE"); at != std::string::npos)
    message.replace(at, 4, here());
  const CommandResult result = place.hookpoint("run run.hook --allow-plugins --out out");
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, said(message));
  EXPECT_FALSE(code_ran()) << "code ran before it was known to fit";
  EXPECT_FALSE(fs::exists(place.folder() / "out"));
  place.file("also.hook", "Plugin \"libmine.so\";\nWorld w;\n");
  EXPECT_EQ(place.hookpoint("check run.hook also.hook --allow-plugins").out, "")
      << "the second file is told the same";
}

constexpr const char* again = ": build it again with this hookpoint's package";

INSTANTIATE_TEST_SUITE_P(
    All, WrongPluginTest,
    ::testing::Values(
        WrongPlugin{"no_symbol",
                    "has no symbol `hookpoint_plugin_abi`: it is no plugin, or was not "
                    "built by hookpoint_add_controller"},
        WrongPlugin{"wrong_version",
                    std::string("was built for plugin ABI 999, this program has ") +
                        std::to_string(control::plugin_abi_version) + again},
        WrongPlugin{"old_strings", std::string("was built with libstdc++ with strings from before "
                                               "C++11, this program with libstdc++ with C++11 "
                                               "strings") +
                                       again},
        WrongPlugin{"unresolved",
                    "needs `hookpoint::control::gain_of_tomorrow(double)`, which this program does "
                    "not have: link what defines it, or build the plugin with the headers of this "
                    "hookpoint"},
        WrongPlugin{
            "taken",
            "cannot join the program: class 'Controller.PD' of 'HERE/libmine.so' is refused: "
            "the program has one of that name"},
        WrongPlugin{"badly_declared",
                    "cannot join the program: class 'Test.Twice': two ports are named 'in'"},
        WrongPlugin{"bad_unit",
                    "cannot join the program: class 'Test.Furlongs': Test.Furlongs.output: "
                    "`furlong` is not an SI unit of the language"},
        WrongPlugin{"bad_family",
                    "cannot join the program: class 'Shape.Cloud': 'Shape.Box' of the language is "
                    "no component, so 'Shape.' is not free"},
        WrongPlugin{"bad_name",
                    "cannot join the program: class 'Test.my class': a class is named by "
                    "identifiers joined by dots"},
        WrongPlugin{"silent", "registers no class: HOOKPOINT_REGISTER_COMPONENT is missing"}),
    [](const auto& test) { return test.param.name; });

TEST_F(PluginCommand, OtherSizesAreToldWithBothCompilers) {
  copy("wrong_sizes");
  place.file("run.hook", doubled_height);
  const CommandResult result = place.hookpoint("check run.hook --allow-plugins");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find(" with other sizes of hookpoint's classes than this program by "),
            std::string::npos)
      << result.err;
  EXPECT_FALSE(code_ran());
}

TEST_F(PluginCommand, WhatIsNoLibraryIsTold) {
  place.file("run.hook", doubled_height);
  const auto err = [&] { return place.hookpoint("check run.hook --allow-plugins").err; };
  const std::string none = "the plugin `libmine.so` is no shared library";
  EXPECT_EQ(err(), said("there is no file `libmine.so`; looked in ., " + testing::source_folder() +
                        "/configs"));
  for (const std::string& text : {std::string(), std::string("a text"),
                                  std::string("\x7f"
                                              "ELF")}) {
    place.file("libmine.so", text);
    EXPECT_EQ(err(), said(none)) << text;
  }
  copy("good", "whole.so");
  std::string bytes = place.read("whole.so");
  place.file("libmine.so", bytes.substr(0, 200));
  EXPECT_NE(err().find("has no symbol"), std::string::npos);
  bytes[18] = '\x28';  // e_machine: ARM of 32 bit
  place.file("libmine.so", bytes);
  EXPECT_EQ(err(), said("the plugin `libmine.so` is built for another processor"));
  fs::remove(place.folder() / "libmine.so");
  fs::create_directory(place.folder() / "libmine.so");
  EXPECT_EQ(err(), said(none));
}

}  // namespace
}  // namespace hookpoint
