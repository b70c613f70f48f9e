// The plugins that a file and its Includes name, found without evaluating anything: paths are
// strings of the syntax, so the list is complete before any class is known.
#pragma once

#include <set>
#include <string>

#include "language/document/document.h"
#include "language/syntax/files.h"

namespace hookpoint::language {

class PluginSearch {
 public:
  PluginSearch(FileStore& files, const Library::PluginLoader& load) : files_(files), load_(load) {}

  /// Loads what the file and, where they stand, its Includes name.
  void visit(const ParsedFile& file);
  /// False, with all that was found wrong, when a plugin was not loaded.
  bool deliver(Diagnostics& diagnostics) const;

 private:
  void include(const ParsedFile& file, const Item& item);
  void load(const ParsedFile& file, const Item& item);

  FileStore& files_;
  const Library::PluginLoader& load_;
  Report report_;
  bool all_loaded_ = true;
  std::set<const ParsedFile*> visited_;
  std::set<std::filesystem::path> loaded_;
};

}  // namespace hookpoint::language
