#include "studies/blocks/calibrate.h"

#include <algorithm>

namespace hookpoint::studies {

namespace {

/// What --quick leaves of the work.
constexpr std::size_t quick_starts = 4, quick_folds = 2;
constexpr int quick_generations_of_fit = 3;

Fields<CalibrateBlock> make_calibrate_fields() {
  using Block = CalibrateBlock;
  Fields<Block> fields;
  append(fields, varied_scene_fields("what is fitted and why, first thing in the report"));
  fields.push_back(words_field(
      "subjects", 100, &Block::subjects,
      "laws, and engines with their settings, each calibrated by itself: hunt_crossley, "
      "mujoco_matched; default: the scene's own, unless there are Subjects"));
  append(fields,
         Fields<CalibrationWork>{
             between(0, 1000,
                     integer_field("folds", &CalibrationWork::folds,
                                   "parts of a cross-validation over the traces; below 2: none")),
             between(0, 100000,
                     integer_field("resamples", &CalibrationWork::resamples,
                                   "samples of the bootstrap, for correlations; 0: neither "
                                   "correlations nor intervals")),
             choice_field("bootstrap", {"refits", "one_step"}, &CalibrationWork::bootstrap,
                          "each sample is fitted again, or solved with the model linearised at the "
                          "optimum, without a run; of least_squares"),
             between(1, 10000,
                     integer_field("starts", &CalibrationWork::starts,
                                   "points all over the ranges that are looked at; the best are "
                                   "refined")),
             choice_field("method", {"least_squares", "cmaes"}, &CalibrationWork::method,
                          "what is made least and how: the sum of all squares, by derivatives from "
                          "the best `starts`, or the mean distance, which a run that went astray "
                          "does not rule, by CMA-ES, which needs none"),
             between(8, 10000,
                     integer_field("population", &CalibrationWork::population,
                                   "of cmaes, places of a generation")),
             between(1, 10000,
                     integer_field("generations", &CalibrationWork::generations,
                                   "of cmaes, the Latin hypercube it begins with included")),
             between(1, 1000000,
                     without_default(integer_field(
                         "most_cases", &CalibrationWork::most_cases,
                         "of cmaes, cases that a search looks at, drawn by `seed` from those that "
                         "it may; default: all"))),
             not_negative(
                 integer_field("seed", &CalibrationWork::seed, "of starts, bootstrap and folds"))});
  return fields;
}

const Fields<CalibrateBlock>& calibrate_fields() {
  static const Fields<CalibrateBlock> fields = make_calibrate_fields();
  return fields;
}

}  // namespace

void add_calibrate_class(language::Schema& schema) {
  schema.add(top_block_class(
      "Calibrate", "Constants of a scene's ground, or any Params of it, fitted to measured traces.",
      schemas(calibrate_fields()), {"Subject", "Vary", "Trace", "Cases", "Fix"}));
}

CalibrateBlock load_calibrate(const language::Object& block, bool quick) {
  CalibrateBlock calibrate = load_fields(block, calibrate_fields());
  if (!quick) return calibrate;
  calibrate.folds = std::min(calibrate.folds, quick_folds);
  calibrate.bootstrap = Bootstrap::one_step;
  calibrate.generations = std::min(calibrate.generations, quick_generations_of_fit);
  calibrate.starts = std::min(calibrate.starts, quick_starts);
  return calibrate;
}

}  // namespace hookpoint::studies
