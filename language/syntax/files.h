// The files that a Library has read: found along the search path, parsed once, kept for good.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "language/syntax/syntax.h"

namespace hookpoint::language {

class FileStore {
 public:
  FileStore(const Schema& schema, std::vector<std::filesystem::path> search_path)
      : schema_(schema), search_path_(std::move(search_path)) {}

  /// See Library::find.
  std::filesystem::path find(const std::filesystem::path& path,
                             const std::filesystem::path& from) const;
  /// The folders where find() looks, in order.
  std::vector<std::string> searched(const std::filesystem::path& path,
                                    const std::filesystem::path& from) const;
  /// The file, parsed; when it cannot be read its report says so. Thread-safe.
  const ParsedFile& load(const std::filesystem::path& path);
  /// `text` as the file `path`, which need not exist. Replaces nothing that was read. Thread-safe.
  void give(const std::filesystem::path& path, std::string text);
  /// `trail=value` as a file of its own, named <--set trail>, of which the text is kept for good: a
  /// study of 100,000 runs sets as many values. Thread-safe.
  ParsedFile override_text(const std::string& trail, const std::string& value);
  const std::vector<std::filesystem::path>& search_path() const { return search_path_; }
  /// What `make` returns, under the name `key`: made once, kept for good, as what a reader of
  /// another format finds in files of its own. `make` requests nothing that is stored. Thread-safe.
  template <class Made>
  const Made& keep(const std::string& key, const std::function<Made()>& make) {
    const std::lock_guard lock(made_mutex_);
    std::shared_ptr<const void>& made = made_[key];
    if (made == nullptr) made = std::make_shared<const Made>(make());
    return *static_cast<const Made*>(made.get());
  }

 private:
  struct StoredFile {
    explicit StoredFile(SourceFile file) : source(std::move(file)) {}
    SourceFile source;
    ParsedFile parsed{source};
  };
  /// Under the lock: where the file is kept, null before it is.
  std::unique_ptr<StoredFile>& place_of(const std::filesystem::path& path);
  /// Parses what has been read.
  void take(ParsedFile& file) const;
  const SourceFile& override_source(const std::string& trail, const std::string& value);

  const Schema& schema_;
  std::vector<std::filesystem::path> search_path_;
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<StoredFile>> files_;
  std::map<std::string_view, std::unique_ptr<const SourceFile>> overrides_;  ///< by their own texts
  std::mutex made_mutex_;
  std::map<std::string, std::shared_ptr<const void>> made_;
};

/// Where the file `path` lies that an Include or a Plugin of `file` names at `place`. Empty, after
/// an error in `report`, if nowhere.
std::filesystem::path find_named(const FileStore& files, const ParsedFile& file,
                                 const std::string& path, const Position& place, Report& report);
/// The same of an item that has its path in quotes.
std::filesystem::path find_named(const FileStore& files, const ParsedFile& file, const Item& item,
                                 Report& report);

/// The declaration of a Param of the file, or null; the names of all of them.
const Item* find_param(const ParsedFile& file, std::string_view name);
std::vector<std::string> param_names(const ParsedFile& file);

}  // namespace hookpoint::language
