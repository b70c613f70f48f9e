// The errors of one evaluation as they are found, in whatever order; delivered sorted by place and
// without repetitions.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "language/diagnostics.h"

namespace hookpoint::language {

/// An error or warning and the other places that belong to it.
struct Finding {
  Diagnostic diagnostic;
  std::vector<Diagnostic> notes;
  std::vector<Position> included_from;  ///< the Includes on the way to it, innermost first
};

class Report {
 public:
  /// No more than this many are looked for; nobody reads more, and a file of ten million mistakes
  /// must not take long.
  static constexpr std::size_t limit = 1000;

  void error(const Position& position, std::string message);
  /// A place that belongs to the error before it.
  void note(const Position& position, std::string message);
  /// What is no mistake and to be known all the same; reported before the errors.
  void remark(const Position& position, std::string message);
  /// Adds the syntax errors of a file.
  void append(const Report& syntax_errors);
  /// Whether the place is in a file with syntax errors: what it lacks may have been lost to one.
  bool is_broken(const Position& position) const { return broken_.contains(position.file); }

  bool has_errors() const { return !findings_.empty(); }
  /// Whether an error was found at the place: a loop comes by it again, and a hint costs time.
  bool told_at(const Position& position) const {
    return told_.contains({position.file, position.offset});
  }
  /// Enough found: time to stop looking for them.
  bool full() const { return findings_.size() >= limit; }
  /// Files in the order in which they were first reached; errors are sorted by it, unknown files
  /// last.
  void order_file(const SourceFile& file);
  /// Between the two, errors in `file` tell that it is included at `place`.
  void enter_include(const SourceFile& file, const Position& place) {
    includes_.push_back({&file, place});
  }
  void leave_include() { includes_.pop_back(); }
  void deliver(Diagnostics& diagnostics) const;

 private:
  struct Include {
    const SourceFile* file;
    Position place;
  };

  std::vector<Finding> findings_;
  std::vector<Diagnostic> remarks_;
  std::vector<Include> includes_;
  std::map<const SourceFile*, std::size_t> file_order_;
  std::set<std::tuple<const SourceFile*, std::size_t, std::string>> seen_;
  std::set<std::pair<const SourceFile*, std::size_t>> told_;
  std::set<const SourceFile*> broken_;
  bool repeated_ = true;
};

}  // namespace hookpoint::language
