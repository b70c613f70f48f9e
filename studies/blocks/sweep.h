// Sweep blocks: what a study varies.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/schema/schema.h"
#include "language/tree/object.h"
#include "studies/results/assignment.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

struct StudyParts;

/// What a Sweep sets: a Param, a field of the World, or the ground.
/// `cases`: the Params that a Cases block's table has a column of.
/// `seeds`: the seed of the World's random streams, and a Param `seed` of scene and ground.
/// `scenes`: those of a Wall.
enum class SweepRole { parameter, world_field, ground, cases, seeds, scenes };

/// A terrain's file, in the place of the scene's ground.
struct SweptGround {
  std::filesystem::path file;
  std::vector<std::string> parameters;  ///< Params that it declares
};

struct SweepPlan {
  SweepColumn column;
  std::vector<double> si;          ///< the same values in SI; of words 0, 1, 2 ...
  std::vector<std::string> texts;  ///< as the language writes them: "5 deg", "clay"
  /// All values that the file gives, of which --quick leaves some out: SI or, of words, 0, 1, 2
  /// ...; and as the language writes them.
  std::vector<double> declared;
  std::vector<std::string> declared_texts;
  std::vector<std::string> declared_words;  ///< where it has words
  SweepRole role = SweepRole::parameter;
  std::vector<language::Position> places;         ///< where each value is written
  std::vector<SweptGround> grounds;               ///< one a value of a ground
  std::vector<std::vector<Assignment>> settings;  ///< one list a case
  /// Of cases of which each lasts up to its last sample: one a case [s]; else empty.
  std::vector<double> durations;

  /// "4 deg, 12 deg": all declared values, or of many those nearest to `value` (SI).
  std::string values_near(std::optional<double> value) const;
  /// Whether the table of cases sets the Param.
  bool assigns(const std::string& parameter) const;
};

void add_sweep_class(language::Schema& schema);

/// The grounds that a Sweep `terrain` names, with their Params; none of a Sweep of a Param that is
/// called so. Needed before the blocks that may name these Params.
std::vector<SweptGround> load_grounds(const language::Object& block, const StudyParts& so_far,
                                      language::Diagnostics& diagnostics);
/// Nothing after some of the errors, so that what else names the Sweep is not wrong.
std::optional<SweepPlan> load_sweep(const language::Object& block, const StudyParts& so_far,
                                    language::Diagnostics& diagnostics);

/// The words that the block gives, those too that do not run under --quick.
std::vector<std::string> swept_words(const language::Object& block);

/// Indices in the sweep of those of the field's words that run; errors for words that it lacks.
std::vector<double> word_values(const SweepPlan& sweep, const language::Field& field,
                                language::Diagnostics& diagnostics);
/// The field's numbers; errors for those that the sweep lacks.
std::vector<double> number_values(const SweepPlan& sweep, const language::Field& field,
                                  language::Diagnostics& diagnostics);
/// "`13 deg` is no value of the Sweep `slope`; it has 4 deg, 12 deg"; `value` in SI, if it is a
/// number.
std::string no_such_value(const SweepPlan& sweep, const std::string& text,
                          std::optional<double> value);

}  // namespace hookpoint::studies
