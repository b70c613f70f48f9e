// What users changed while a run continued: changes.csv, from which the run is repeated byte for
// byte (docs/data.md). The changes of step k are applied in their order after row k was written and
// before the step to k + 1.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hookpoint::simulation {

struct Change {
  std::int64_t step = 0;
  double time = 0.;   ///< of the step, for readers [s]
  std::string trail;  ///< a port that was set, or a field that was edited
  std::string value;  ///< the shortest text of a number, or a field's value as it was given
  bool operator==(const Change&) const = default;
};

/// A file of changes that is not one; the message names the file, the line and what is wrong.
struct ChangesError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The changes of a file, steps in order. Throws ChangesError.
std::vector<Change> read_changes(const std::filesystem::path& path);
/// The line of such a file on which its change `index` stands, from 1 on.
std::size_t line_of_change(std::size_t index);

/// The number that is all of `text`: what sets a port. Nothing of an expression, a unit, a word.
std::optional<double> plain_number(const std::string& text);

/// changes.csv in a run's folder, written at each change: whatever becomes of the program, the run
/// can be repeated up to there.
class ChangeLog {
 public:
  static constexpr const char* file_name = "changes.csv";

  /// Nothing is written before the first change. An empty `file`: never.
  explicit ChangeLog(std::filesystem::path file = {}) : file_(std::move(file)) {}

  /// Throws output::FileError.
  void add(std::span<const Change> changes);
  /// Forgets all but the first `count`, in the file too. Throws output::FileError.
  void truncate(std::size_t count);
  /// The file again as it is to be, after somebody else cleared its folder.
  void rewrite();
  const std::vector<Change>& changes() const { return changes_; }

 private:
  std::filesystem::path file_;
  std::vector<Change> changes_;
  bool written_ = false;  ///< the file is there
};

}  // namespace hookpoint::simulation
