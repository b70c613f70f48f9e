#include "apps/view/session/file_watch.h"

#include <system_error>
#include <utility>

namespace hookpoint::view {

void FileWatch::watch(std::vector<std::filesystem::path> paths) {
  paths_ = std::move(paths);
  times_.clear();
  for (const std::filesystem::path& path : paths_) {
    std::error_code gone;
    times_.push_back(std::filesystem::last_write_time(path, gone));
  }
}

bool FileWatch::written() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return false;
  next_ = now + std::chrono::milliseconds(500);
  bool any = false;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    std::error_code gone;
    const auto time = std::filesystem::last_write_time(paths_[i], gone);
    if (gone || time == times_[i]) continue;
    times_[i] = time;
    any = true;
  }
  return any;
}

}  // namespace hookpoint::view
