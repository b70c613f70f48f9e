#include "output/files/temporary_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <utility>

#include "output/files/file.h"

namespace hookpoint::output {
namespace {

namespace fs = std::filesystem;

/// Without it a folder may be anybody's.
constexpr const char* mark_file = ".hookpoint-temporary";
constexpr std::size_t random_letters = 6;  ///< of mkdtemp

/// The folder, open, which this process alone uses from now on; -1 where another one uses it, it is
/// not this user's alone, or it is gone.
int lock_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return -1;
  struct stat found {};
  const bool ours = ::fstat(descriptor, &found) == 0 && found.st_uid == ::geteuid() &&
                    (found.st_mode & 0777U) == 0700U;
  const bool locked = ours && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  // Whoever had it locked before may have removed it.
  if (locked && ::fstat(descriptor, &found) == 0 && found.st_nlink > 0) return descriptor;
  ::close(descriptor);
  return -1;
}

/// Removes what programs that were killed left behind.
void remove_abandoned(const fs::path& parent, const std::string& prefix) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(parent, ignored)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with(prefix) || name.size() != prefix.size() + random_letters) continue;
    const int lock = lock_folder(entry.path());
    if (lock < 0) continue;
    struct stat mark {};
    if (::fstatat(lock, mark_file, &mark, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(mark.st_mode))
      fs::remove_all(entry.path(), ignored);
    else
      ::rmdir(entry.path().c_str());  // an empty one has no mark yet; others stay
    ::close(lock);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder(std::string_view kind) {
  const fs::path parent = fs::temp_directory_path();
  const std::string prefix = "hookpoint-" + std::string(kind) + "-";
  remove_abandoned(parent, prefix);
  // Another process may take a new folder for an abandoned one until it is locked.
  for (int tries = 0; lock_ < 0 && tries < 100; ++tries) {
    std::string pattern = parent / (prefix + std::string(random_letters, 'X'));
    if (::mkdtemp(pattern.data()) == nullptr) fail_file("create a folder in", parent);
    path_ = pattern;
    lock_ = lock_folder(path_);
  }
  if (lock_ < 0) {
    errno = EAGAIN;
    fail_file("lock a folder in", parent);
  }
  const int mark = ::openat(lock_, mark_file, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (mark >= 0) ::close(mark);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  ::close(lock_);
}

}  // namespace hookpoint::output
