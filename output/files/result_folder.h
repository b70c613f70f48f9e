// The folder that a run or a study leaves: one writer at a time, nothing stale in it, and every
// file tied to its experiment.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output/files/file.h"

namespace hookpoint::output {

/// The folder cannot take the results: somebody else writes into it, or a file in it is not known
/// to be hookpoint's. The message names the file and what to do. What was in it stays.
struct FolderError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that an experiment reads.
struct InputFile {
  std::string path;  ///< absolute
  std::string hash;  ///< of its bytes (output/files/hash.h)
};

/// files.json: what lies in the folder, and which experiment it is of.
struct Manifest {
  static constexpr const char* file_name = "files.json";

  std::string experiment;                                  ///< its hash
  std::vector<std::pair<std::string, std::string>> about;  ///< "engine" -> "dts 0.1.0, double"
  std::vector<InputFile> inputs;
  /// By name from the folder on, with the hash of the bytes; "" of a file that was being written
  /// when its writer ended. "rows/" is a folder whose files are hookpoint's own.
  std::map<std::string, std::string> files;
};

/// Nothing when there is no files.json. Throws FolderError when it cannot be read as one, or names
/// a file outside the folder.
std::optional<Manifest> read_manifest(const std::filesystem::path& folder);

/// A file of a folder: its name, known before anything runs, and what is to be written.
struct ResultFile {
  std::string name;
  std::function<std::string()> text;  ///< after the run; "": nothing is written
};

class ResultFolder {
 public:
  /// Makes the folder where it is missing, locks it, and clears the results that an earlier run
  /// left: what its files.json lists, unchanged since. `names`: what may be written from now on,
  /// from the folder on ("traces/fig5_00004.csv"); one that ends in '/' is a folder that is kept as
  /// it is. `experiment`, `about` and `inputs` of `manifest` count. Throws FolderError before it
  /// changed anything: locked by another, a name that stands there and is not hookpoint's, a result
  /// that was changed since; FileError when the disk refuses.
  ResultFolder(std::filesystem::path folder, Manifest manifest, std::vector<std::string> names);
  /// Gives the lock back. What was not finished stays listed, without hashes.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  /// `text` as the file `name`, one of `names`. Throws FileError.
  void write(const std::string& name, std::string_view text);
  void write(const std::vector<ResultFile>& files);
  /// What `write` wrote, in order.
  const std::vector<std::string>& written() const { return written_; }
  /// When all is written: lists with their hashes the files that are there of those announced.
  /// Throws FileError.
  void finish();

 private:
  void lock();
  void unlock();
  void check(const Manifest& earlier) const;
  void clear(const Manifest& earlier);

  std::filesystem::path folder_;
  Manifest manifest_;
  std::vector<std::string> names_, written_;
  int lock_ = -1;
};

/// Names under which `name` may stand before it is complete, itself first.
std::vector<std::string> stages_of(const std::string& name);

std::vector<std::string> names_of(const std::vector<ResultFile>& files);

}  // namespace hookpoint::output
