// Folders for files of no lasting use: gone with their owner, and with the next of their kind where
// the owner was killed; nobody else's is touched.
#include "output/files/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "output/files/file.h"
#include "tests/support/command.h"
#include "tests/support/record_scene.h"

namespace hookpoint {
namespace {

namespace fs = std::filesystem;
using output::TemporaryFolder;

class Temporary : public ::testing::Test {
 protected:
  Temporary() { setenv("TMPDIR", work_.folder().c_str(), 1); }
  ~Temporary() override { unsetenv("TMPDIR"); }

  /// A folder as mkdtemp makes it, with one file in it.
  fs::path folder(const std::string& name, const std::string& file, unsigned mode = 0700) const {
    const fs::path path = work_.folder() / name;
    fs::create_directory(path);
    std::ofstream(path / file) << "x";
    ::chmod(path.c_str(), mode);
    return path;
  }

  testing::Workplace work_;
};

TEST_F(Temporary, IsItsOwnersAloneAndGoneWithIt) {
  fs::path path;
  {
    const TemporaryFolder one("movie"), two("movie");
    path = one.path();
    EXPECT_EQ(path.parent_path(), work_.folder());
    EXPECT_TRUE(path.filename().string().starts_with("hookpoint-movie-"));
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_all);
    EXPECT_NE(one.path(), two.path());
    std::ofstream(path / "file") << "x";
    fs::create_directories(path / "more" / "deep");
    EXPECT_TRUE(fs::exists(path)) << "another object of its kind does not take it for abandoned";
  }
  EXPECT_EQ(work_.entries(), 0u);
}

TEST_F(Temporary, OfAKilledProgramIsRemovedByTheNext) {
  testing::run_and_die([] {
    static const TemporaryFolder left("movie");
    std::ofstream(left.path() / "file") << "x";
  });
  EXPECT_EQ(work_.entries(), 1u);
  { const TemporaryFolder other("picture"); }
  EXPECT_EQ(work_.entries(), 1u) << "another kind is another program's";
  { const TemporaryFolder same("movie"); }
  EXPECT_EQ(work_.entries(), 0u);
}

TEST_F(Temporary, LeavesWhatOnlyLooksAlike) {
  const fs::path mine = folder("hookpoint-movie-backup", "holiday.h5");
  const fs::path open = folder("hookpoint-movie-public", ".hookpoint-temporary", 0755);
  const fs::path longer = folder("hookpoint-movie-collection", ".hookpoint-temporary");
  const fs::path target = folder("elsewhere", ".hookpoint-temporary");
  fs::create_directory_symlink(target, work_.folder() / "hookpoint-movie-linked");
  { const TemporaryFolder made("movie"); }
  for (const fs::path& path : {mine / "holiday.h5", open, longer, target / ".hookpoint-temporary"})
    EXPECT_TRUE(fs::exists(path)) << path;
  EXPECT_TRUE(fs::is_symlink(work_.folder() / "hookpoint-movie-linked"));
}

TEST_F(Temporary, SaysWhereThereIsNoRoom) {
  ::chmod(work_.folder().c_str(), 0500);
  if (::access(work_.folder().c_str(), W_OK) == 0) GTEST_SKIP() << "root may write anywhere";
  EXPECT_THROW(TemporaryFolder("movie"), output::FileError);
  ::chmod(work_.folder().c_str(), 0700);
}

}  // namespace
}  // namespace hookpoint
