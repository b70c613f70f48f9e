// Diagnostics with a place: what is reported to the user, all of a file's errors in one go, at most
// `limit` of them.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "language/source.h"

namespace hookpoint::language {

enum class Severity { error, warning, note };

struct Diagnostic {
  Severity severity = Severity::error;
  Position position;
  std::string message;
};

class Diagnostics {
 public:
  static constexpr std::size_t limit = 20;

  void error(const Position& position, std::string message);
  void warning(const Position& position, std::string message);
  /// A second place that belongs to the diagnostic before it ("defined here").
  void note(const Position& position, std::string message);

  /// Reports a diagnostic again, at another place: one of an included file, where the includer can
  /// mend it.
  void report_again(const Diagnostic& diagnostic, const Position& position);

  /// Keeps what positions point into alive as long as the diagnostics.
  void keep(std::shared_ptr<const void> source) { kept_.push_back(std::move(source)); }

  /// The same without the warnings that `drop` names, and without their notes.
  Diagnostics without(const std::function<bool(const Diagnostic& warning)>& drop) const;

  bool has_errors() const { return errors_ > 0; }
  std::size_t error_count() const { return errors_; }
  /// Its message; "" without one.
  std::string first_error() const;
  const std::vector<Diagnostic>& all() const { return diagnostics_; }

  /// `path:line:column: error: message`, the line, and a caret under the place; one line saying how
  /// many more there were.
  void print(std::ostream& out, bool colours) const;

 private:
  void add(Severity severity, const Position& position, std::string message);
  std::vector<Diagnostic> diagnostics_;
  std::size_t errors_ = 0;
  std::vector<std::shared_ptr<const void>> kept_;
};

}  // namespace hookpoint::language
