// From files to a checked object tree: the one door of this folder. A Library keeps parsed files,
// so that a study evaluates its scene a thousand times and reads it once.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "language/diagnostics.h"
#include "language/document/textmate.h"
#include "language/schema/describe.h"
#include "language/schema/schema.h"
#include "language/syntax/format.h"
#include "language/tree/evaluate_options.h"
#include "language/tree/number_of.h"
#include "language/tree/object.h"
#include "language/tree/print.h"
#include "language/tree/references.h"

namespace hookpoint::language {

/// A file's Param as declared: for checking sweeps and for `describe`.
struct ParameterDeclaration {
  std::string name;
  std::string default_text;  ///< "" when it is required
  Position position;
};

class Library {
 public:
  /// `search_path`: where includes are looked up last (HOOKPOINT_PATH, the installation's configs/;
  /// language/search.h).
  Library(const Schema& schema, std::vector<std::filesystem::path> search_path);
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  /// From now on `text` is the file `path`, which need not exist.
  void give(const std::filesystem::path& path, std::string text);
  /// Parses, evaluates and checks `file`. Null when `diagnostics` got an error. Thread-safe: parsed
  /// files are kept under a lock and only read afterwards. The tree and the diagnostics point into
  /// the Library and the Schema. Cost: linear in the size of the laid-down tree.
  std::unique_ptr<Object> evaluate(const std::filesystem::path& file,
                                   const EvaluateOptions& options, Diagnostics& diagnostics);
  /// Whatever stands in the way of loading a library: "" or a predicate to the subject "the plugin
  /// `x.so`". Takes the path as found.
  using PluginLoader = std::function<std::string(const std::filesystem::path&)>;
  /// Hands every library that `file` and its Includes name as a Plugin to `load`, once each, in the
  /// order of the files; nothing is evaluated. What `load` objects to is an error at the Plugin;
  /// false after any, with the syntax errors of the files beside them. When true `diagnostics` got
  /// nothing: `evaluate` reports what else is wrong.
  bool load_plugins(const std::filesystem::path& file, const PluginLoader& load,
                    Diagnostics& diagnostics);
  /// The Params that `file` declares.
  std::vector<ParameterDeclaration> parameters(const std::filesystem::path& file,
                                               Diagnostics& diagnostics);
  /// Whether `file` itself, not an Include of it, holds an object of this class at its top. O(items there),
  /// nothing is evaluated; false for a file that is wrong or not in the language.
  bool declares(const std::filesystem::path& file, std::string_view type);
  /// Of `file` and the files that it and they include, by a path in quotes, those that hold an object
  /// of this class at their top. Nothing is evaluated.
  std::vector<std::filesystem::path> declaring(const std::filesystem::path& file,
                                               std::string_view type);
  /// The first object at the top of `file` itself that is of another class.
  std::optional<Position> other_than(const std::filesystem::path& file, std::string_view type);
  /// Where an Include written in `from` (or "" for the command line) finds `path`: beside it, then
  /// in the configs/ of the folders above, then along the search path. Empty if nowhere.
  std::filesystem::path find(const std::filesystem::path& path,
                             const std::filesystem::path& from) const;
  const std::vector<std::filesystem::path>& search_path() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The files that the tree was made from, as absolute paths in order, each once.
std::vector<std::string> sources_of(const Object& root);

}  // namespace hookpoint::language
