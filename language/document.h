// From files to a checked object tree: the one door of this folder. A Library keeps parsed files,
// so that a study evaluates its scene a thousand times and reads it once.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/object.h"
#include "language/schema.h"

namespace hookpoint::language {

/// An assignment from outside the file (`--set SimpleWorld.deltat="1 ms"`, a study's subject):
/// `value` is the language's text.
struct Override {
  std::string trail;  ///< from the top of the file, ending in a field:
                      ///< SimpleWorld.simplebot.leg1.link1.angle
  std::string value;
};

struct EvaluateOptions {
  std::map<std::string, std::string>
      parameters;  ///< values of the file's `Param`s, the language's text
  std::vector<Override> overrides;
};

/// A file's Param as declared: for checking sweeps and for `describe`.
struct ParameterDeclaration {
  std::string name;
  std::string default_text;  ///< "" when it is required
  Position position;
};

/// The object or port that `trail` means at the top of the file; errors in `diagnostics`, without a
/// place. `want_port`: must end in a port that can be wired or recorded (an object alone then means
/// its default output).
std::optional<Reference> resolve(const Object& root, const std::string& trail, bool want_port,
                                 Diagnostics& diagnostics);

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
  /// Where an Include written in `from` (or "" for the command line) finds `path`: beside it, then
  /// in the configs/ of the folders above, then along the search path. Empty if nowhere.
  std::filesystem::path find(const std::filesystem::path& path,
                             const std::filesystem::path& from) const;
  const std::vector<std::filesystem::path>& search_path() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The files that the tree was laid down from, as absolute paths in order, each once.
std::vector<std::string> sources_of(const Object& root);

/// The tree as a file: what was given, as SI values in the shortest form that reads back to the
/// same double; references as trails from the top.
std::string print(const Object& root);

/// Canonical layout of a file's text, comments kept; idempotent. `diagnostics` gets the syntax
/// errors; the text is then returned unchanged.
std::string format(const std::filesystem::path& file, const std::string& text,
                   Diagnostics& diagnostics);

/// One class as a manual entry; `describe_all` is the index of all of them.
std::string describe(const ClassSchema& schema);
/// The same, with the classes that it may stand in.
std::string describe(const ClassSchema& schema, const Schema& all);
std::string describe_all(const Schema& schema);
/// All classes as a page of the manual, in Markdown.
std::string describe_markdown(const Schema& schema);

/// The language's words as a TextMate grammar (JSON), for editors.
std::string describe_textmate(const Schema& schema);

/// The value of `text` ("2 * 3 ms") as a field that takes one number in `unit` would have it, in
/// SI; nothing when such a field would refuse it.
std::optional<double> number_of(const std::string& text, const std::string& unit);

/// The name of `candidates` nearest to `name` (edit distance at most a third of its length), or ""
/// if none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace hookpoint::language
