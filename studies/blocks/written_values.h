// Values as a study's file writes them, with the unit that the author chose.
#pragma once

#include <string>
#include <vector>

#include "language/tree/object.h"
#include "language/units.h"

namespace hookpoint::studies {

/// A unit as written, with its factor to SI.
struct WrittenUnit {
  std::string text;  ///< "deg"; "" when none was written
  language::Unit unit;

  double to_si(double value) const { return value * unit.numerator / unit.denominator; }
  double from_si(double value) const { return value * unit.denominator / unit.numerator; }
  /// `value` in this unit, as text that the language reads back: "5 deg".
  std::string with_unit(double value) const;
};

/// The unit that the field's value is written in.
WrittenUnit written_unit(const language::Field& field);

/// The field's number as text that the language reads back to the same double, in SI with its unit,
/// or the word in its place: what stands for it elsewhere, where the names of its own file mean
/// nothing.
std::string text_of(const language::Field& field);
/// Its words as text that the language reads back: "clay", "\"sand.hook\"".
std::vector<std::string> word_texts(const language::Field& field);

/// To 12 significant digits: 0.30000000000000004 is 0.3.
double tidy(double value);

/// Runs that a study may require, and values of one Sweep.
inline constexpr std::size_t most_runs = 1'000'000;

/// How many values `stepped` gives: 1e15 for a step of 1e-15 from 0 to 1.
double stepped_count(double from, double to, double step);
/// from, from + step, ... up to `to` (half a millionth of a step of tolerance), tidied.
std::vector<double> stepped(double from, double to, double step);
/// `count` values from `from` to `to`, evenly spaced or in geometric progression, tidied.
std::vector<double> spaced(double from, double to, int count, bool logarithmic);

}  // namespace hookpoint::studies
