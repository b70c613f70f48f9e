// What standard output and the disk do not take: the exit status that the manual promises, one
// message, and no half of anything.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "tests/support/command.h"
#include "tests/support/folders.h"

namespace hookpoint::testing {
namespace {

constexpr int missing = 3;

/// A world that prints a summary and is done at once.
constexpr const char* world =
    "World w { deltat = 1 ms; duration = 10 ms;\n"
    "  Robot r { Base.mobile { mass = 1; location = 0, 0, 1; Shape.Cube dimensions = 1, 1, 1; } } "
    "}\n";

/// What a script for bash, in which $H is the program, ends with and says.
CommandResult script(const Workplace& place, const std::string& text) {
  place.file("script.sh", "H='" + testing::build_folder() + "/hookpoint'\n" + text);
  const std::string folder = place.folder().string();
  const int raw =
      std::system(("cd '" + folder + "' && bash script.sh >.out 2>.err </dev/null").c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw), place.read(".out"),
          place.read(".err")};
}

TEST(StandardOutput, ThatIsFullIsAnError) {
  const Workplace place;
  place.file("w.hook", world);
  for (const std::string command :
       {"describe", "describe --markdown", "describe Link", "print w.hook", "run w.hook",
        "dynamics w.hook", "check w.hook", "engines --json", "--help", "--version"}) {
    const CommandResult result = script(place, "$H " + command + " >/dev/full\n");
    EXPECT_EQ(result.status, missing) << command;
    EXPECT_NE(result.err.find("hookpoint: error: cannot write to standard output: No space left"),
              std::string::npos)
        << command << ": " << result.err;
  }
}

TEST(StandardOutput, ThatIsClosedIsAnErrorAndNoFileTakesItsPlace) {
  const Workplace place;
  place.file("w.hook", world);
  const CommandResult result =
      script(place, "$H run w.hook --record w.r.base.location.z --out run >&-\n");
  EXPECT_EQ(result.status, missing);
  EXPECT_NE(result.err.find("cannot write to standard output: Bad file descriptor"),
            std::string::npos)
      << result.err;
  EXPECT_TRUE(place.read("run/trace.csv").starts_with("time [s],w.r.base.location.z"))
      << place.read("run/trace.csv");
  EXPECT_EQ(place.read("run/trace.csv").find("velocity"), std::string::npos);
}

TEST(StandardOutput, WhoseReaderGoesAwayEndsQuietlyAndKeepsTheFiles) {
  const Workplace place;
  place.file("w.hook", world);
  const std::string gone = std::to_string(128 + SIGPIPE) + " 0\n";
  const std::string told = "; echo ${PIPESTATUS[@]} >status\n";
  const CommandResult listed = script(place, "$H describe --markdown | head -c 1" + told);
  EXPECT_EQ(place.read("status"), gone);
  EXPECT_EQ(listed.err, "");
  // A pipe that nobody reads any more before anything is printed.
  const CommandResult run = script(place,
                                   "mkfifo pipe; exec 4<>pipe 5>pipe 4<&-\n"
                                   "$H run w.hook --record w.r.base.location.z --out run >&5\n");
  EXPECT_EQ(run.status, 128 + SIGPIPE) << run.err;
  EXPECT_TRUE(std::filesystem::exists(place.folder() / "run/trace.csv"));
}

/// Runs the script without root's right to write everywhere, with a program of its own: the build may
/// stand in a folder that only root enters.
CommandResult unprivileged(const Workplace& place, const std::string& text) {
  std::filesystem::permissions(place.folder(), std::filesystem::perms::all);
  std::filesystem::copy_file(testing::build_folder() + "/hookpoint", place.folder() / "hookpoint",
                             std::filesystem::copy_options::skip_existing);
  place.file("inner.sh", "H=./hookpoint\n" + text);
  const std::string drop =
      geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
  return script(place, drop + "bash inner.sh\n");
}

TEST(Disk, AFolderThatCannotBeMadeOrWrittenIsNamedWithTheReason) {
  const Workplace place;
  place.file("w.hook", world);
  std::filesystem::create_directory(place.folder() / "closed");
  std::filesystem::permissions(place.folder() / "closed", std::filesystem::perms::owner_read |
                                                              std::filesystem::perms::owner_exec |
                                                              std::filesystem::perms::others_read |
                                                              std::filesystem::perms::others_exec);
  for (const std::string folder : {"closed", "closed/new/run"}) {
    const CommandResult result = unprivileged(place, "$H run w.hook --out " + folder + "\n");
    EXPECT_EQ(result.status, missing) << result.err;
    EXPECT_NE(result.err.find("Permission denied"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("--out names another folder"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("No such file"), std::string::npos) << result.err;
  }
}

TEST(Disk, AFullOneIsSaid) {
  const Workplace place;
  place.file("w.hook", world);
  // A limit on the size of files refuses as a full disk does.
  const CommandResult result =
      script(place,
             "trap '' XFSZ; mkfifo said; cat <said & (ulimit -f 0; $H run w.hook --out run "
             "--record w.r.base.location.z >said 2>&1); status=$?; wait; exit $status\n");
  EXPECT_EQ(result.status, missing) << result.out;
  EXPECT_NE(result.out.find("File too large"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace hookpoint::testing
