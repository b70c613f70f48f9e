#include "output/files/result_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "output/files/hash.h"
#include "text/json.h"
#include "text/json_reader.h"

namespace hookpoint::output {
namespace {

namespace fs = std::filesystem;

constexpr const char* lock_name = ".lock";
constexpr const char* advice = "move it away, or name another folder with --out";

bool is_folder(const std::string& name) { return name.ends_with('/'); }

bool there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

/// What a list of files names may be removed: nothing outside the list's own folder.
bool stays_inside(const fs::path& name) {
  return !name.empty() && name.is_relative() && std::ranges::find(name, "..") == name.end();
}

/// A folder without anything in it takes nobody's place.
bool takes_place(const fs::path& path, const std::string& name) {
  std::error_code ignored;
  return there(path) && !(is_folder(name) && fs::is_empty(path, ignored));
}

/// The process that wrote its number into the lock, "" when it did not yet.
std::string holder(int lock) {
  char text[32];
  const ssize_t count = ::pread(lock, text, sizeof text, 0);
  return count > 0 ? " (process " + std::string(text, static_cast<std::size_t>(count)) + ")" : "";
}

bool same_file(int descriptor, const fs::path& path) {
  struct stat held {
  }, named{};
  return ::fstat(descriptor, &held) == 0 && ::stat(path.c_str(), &named) == 0 &&
         held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

void read_leaf(const std::string& key, const std::string& value, Manifest& manifest) {
  const std::string_view files = "files.", inputs = "inputs[";
  if (key == "experiment") {
    manifest.experiment = value;
  } else if (key.starts_with(files)) {
    manifest.files[key.substr(files.size())] = value;
  } else if (key.starts_with(inputs)) {
    if (key.ends_with(".path")) manifest.inputs.push_back({value, {}});
    if (key.ends_with(".hash") && !manifest.inputs.empty()) manifest.inputs.back().hash = value;
  } else {
    manifest.about.emplace_back(key, value);
  }
}

std::string text_of(const Manifest& manifest) {
  text::JsonWriter json;
  json.begin_object().member("experiment", manifest.experiment);
  for (const auto& [key, value] : manifest.about) json.member(key, value);
  json.key("inputs").begin_array();
  for (const InputFile& input : manifest.inputs)
    json.begin_object().member("path", input.path).member("hash", input.hash).end_object();
  json.end_array().key("files").begin_object();
  for (const auto& [name, hash] : manifest.files) json.member(name, hash);
  json.end_object().end_object();
  return json.text();
}

}  // namespace

std::vector<std::string> stages_of(const std::string& name) {
  if (is_folder(name)) return {name};
  return {name, name + ".partial", name + ".spool"};
}

std::vector<std::string> names_of(const std::vector<ResultFile>& files) {
  std::vector<std::string> names;
  for (const ResultFile& file : files) names.push_back(file.name);
  return names;
}

std::optional<Manifest> read_manifest(const fs::path& folder) {
  const fs::path path = folder / Manifest::file_name;
  if (!there(path)) return std::nullopt;
  const auto leaves = text::json_leaves(read_file(path).value_or(""));
  Manifest manifest;
  if (leaves)
    for (const auto& [key, value] : *leaves) read_leaf(key, value, manifest);
  const bool inside = std::ranges::all_of(
      manifest.files, [](const auto& file) { return stays_inside(file.first); });
  if (manifest.experiment.empty() || !inside)
    throw FolderError(path.string() + " is not a list of files that hookpoint wrote; " + advice);
  return manifest;
}

ResultFolder::ResultFolder(fs::path folder, Manifest manifest, std::vector<std::string> names)
    : folder_(std::move(folder)), manifest_(std::move(manifest)), names_(std::move(names)) {
  std::error_code error, ignored;
  fs::create_directories(folder_, error);
  if (!fs::is_directory(folder_, ignored))
    throw PlaceError("cannot make the folder " + folder_.string() + ": " +
                     (error ? error.message() : "a file has its name") +
                     "; --out names another folder");
  try {
    lock();
    const Manifest earlier = read_manifest(folder_).value_or(Manifest{});
    check(earlier);
    manifest_.files.clear();
    for (const std::string& name : names_) manifest_.files[name];
    // What is kept stays hookpoint's own under the next list too.
    for (const auto& [name, hash] : earlier.files)
      if (is_folder(name) && takes_place(folder_ / name, name)) manifest_.files[name];
    // A disk that is full is met before anything is removed.
    PartialFile list(folder_ / Manifest::file_name);
    list.write(text_of(manifest_));
    clear(earlier);
    list.complete();
  } catch (...) {
    unlock();
    throw;
  }
}

ResultFolder::~ResultFolder() { unlock(); }

void ResultFolder::lock() {
  const fs::path path = folder_ / lock_name;
  for (;;) {
    lock_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0) {
      const int reason = errno;
      throw PlaceError("cannot write into the folder " + folder_.string() + ": " +
                       std::generic_category().message(reason) + "; --out names another folder");
    }
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      const std::string other = holder(lock_);
      ::close(std::exchange(lock_, -1));
      throw FolderError("another hookpoint" + other + " writes into " + folder_.string() +
                        "; wait for it, or name another folder with --out");
    }
    // Where the file system has no locks, one writer at a time is the user's affair. Else the file
    // that is locked may have been removed by who held it before.
    if (same_file(lock_, path)) break;
    ::close(std::exchange(lock_, -1));
  }
  const std::string number = std::to_string(::getpid());
  if (::ftruncate(lock_, 0) != 0 || ::pwrite(lock_, number.data(), number.size(), 0) < 0)
    fail_file("write", path);
}

void ResultFolder::unlock() {
  if (lock_ < 0) return;
  ::unlink((folder_ / lock_name).c_str());
  ::close(std::exchange(lock_, -1));
}

void ResultFolder::check(const Manifest& earlier) const {
  for (const auto& [name, hash] : earlier.files) {
    const fs::path path = folder_ / name;
    if (hash.empty() || !there(path)) continue;
    if (!fs::is_regular_file(path) || hash_of_file(path) != hash)
      throw FolderError(path.string() + " was changed since hookpoint wrote it; " + advice);
  }
  // Text is read before a run begins; a movie while it goes on.
  for (const InputFile& input : manifest_.inputs) {
    const fs::path path(input.path);
    std::error_code ignored;
    if (path.extension() != ".hook" && earlier.files.contains(path.filename()) &&
        fs::equivalent(path, folder_ / path.filename(), ignored))
      throw FolderError(path.string() + " is what this run reads; name another folder with --out");
  }
  for (const std::string& name : names_) {
    if (earlier.files.contains(name)) continue;
    for (const std::string& stage : stages_of(name))
      if (takes_place(folder_ / stage, stage))
        throw FolderError((folder_ / stage).string() +
                          " stands in the way, and hookpoint did not write it; " + advice);
  }
}

void ResultFolder::clear(const Manifest& earlier) {
  std::set<fs::path> emptied;
  std::error_code error;
  for (const auto& [name, hash] : earlier.files) {
    if (is_folder(name)) continue;
    for (const std::string& stage : stages_of(name)) {
      fs::remove(folder_ / stage, error);
      if (error)
        throw FileError("cannot remove " + (folder_ / stage).string() + ": " + error.message());
    }
    const fs::path parent = (folder_ / name).parent_path();
    if (parent != folder_) emptied.insert(parent);
  }
  // Others' files keep a folder where it is.
  for (const fs::path& parent : emptied) fs::remove(parent, error);
}

void ResultFolder::write(const std::string& name, std::string_view text) {
  if (std::ranges::find(names_, name) == names_.end())
    throw std::logic_error(name + " is written but was not announced");
  make_folder_of(folder_ / name);
  write_file(folder_ / name, text);
  written_.push_back(name);
}

void ResultFolder::write(const std::vector<ResultFile>& files) {
  for (const ResultFile& file : files)
    if (const std::string text = file.text(); !text.empty()) write(file.name, text);
}

void ResultFolder::finish() {
  for (const std::string& name : names_) {
    if (is_folder(name)) continue;
    const fs::path path = folder_ / name;
    if (there(path)) {
      manifest_.files[name] = hash_of_file(path);
      continue;
    }
    const auto stages = stages_of(name);
    const bool begun = std::ranges::any_of(
        stages, [this](const std::string& stage) { return there(folder_ / stage); });
    if (begun)
      manifest_.files[name].clear();
    else
      manifest_.files.erase(name);
  }
  write_file(folder_ / Manifest::file_name, text_of(manifest_));
}

}  // namespace hookpoint::output
