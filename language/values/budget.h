// What a file may require in all, so that a short one that requires too much is refused at once and
// neither waited for nor answered with an empty memory (docs/language.md has the table).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "language/report.h"

namespace hookpoint::language {

/// What is counted while a file is evaluated.
enum class Resource { steps, values, objects };

/// The account of one evaluation.
class Budget {
 public:
  static constexpr std::size_t most_steps = 50'000'000;
  /// Elements of lists, a long text as several.
  static constexpr std::size_t most_values = 4'000'000;
  /// Objects and wires.
  static constexpr std::size_t most_objects = 200'000;

  /// Whether `amount` more may be had. If not: one error at `place`, and never anything again.
  bool take(Resource resource, std::size_t amount, const Position& place, Report& report);
  /// Whether too much was required.
  bool spent() const { return spent_; }

 private:
  std::size_t used_[3] = {};
  bool spent_ = false;
};

/// "3e+12 rows, more than the 1000000 allowed": what follows "requires".
std::string too_many(double required, std::size_t most, std::string_view noun);

}  // namespace hookpoint::language
