#include "studies/blocks/tune.h"

#include <algorithm>

namespace hookpoint::studies {

namespace {

/// What --quick leaves of a search.
constexpr int quick_population = 8, quick_generations = 3, quick_seeds = 2, quick_samples = 0;

Fields<TuneBlock> make_tune_fields() {
  Fields<TuneBlock> fields;
  append(fields, varied_scene_fields("what is tuned for, first thing in the report"));
  append(fields, times_fields("simulated time of every run; default: the scene's",
                              "time from which metrics look"));
  append(fields,
         {choice_field("method", {"nsga2", "cmaes"}, &TuneBlock::method,
                       "NSGA-II, for any number of objectives, or CMA-ES, for one"),
          between(8, 10000,
                  integer_field("population", &TuneBlock::population,
                                "candidates of a generation; of nsga2 a multiple of 4")),
          between(1, 10000,
                  integer_field("generations", &TuneBlock::generations,
                                "generations, the first guesses' own included")),
          between(1, 1000,
                  integer_field("seeds", &TuneBlock::seeds,
                                "runs of a candidate, each with another seed")),
          not_negative(integer_field("seed", &TuneBlock::seed, "of the search, not of the runs")),
          between(0, 100000,
                  integer_field("samples", &TuneBlock::samples,
                                "of Sobol's indices: each is samples (constants + 2) candidates; "
                                "0: none"))});
  return fields;
}

const Fields<TuneBlock>& tune_fields() {
  static const Fields<TuneBlock> fields = make_tune_fields();
  return fields;
}

}  // namespace

void add_tune_class(language::Schema& schema) {
  schema.add(top_block_class("Tune",
                             "Constants of a scene's ground, or any Params of it, searched for "
                             "what its objectives ask.",
                             schemas(tune_fields()),
                             {"Subject", "Vary", "Measure", "Objective", "Require", "Fix"}));
}

TuneBlock load_tune(const language::Object& block, bool quick) {
  TuneBlock tune = load_fields(block, tune_fields());
  if (!quick) return tune;
  tune.population.value = std::min(*tune.population, quick_population);
  tune.generations = std::min(tune.generations, quick_generations);
  tune.seeds = std::min(tune.seeds, quick_seeds);
  tune.samples = std::min(tune.samples, quick_samples);
  return tune;
}

}  // namespace hookpoint::studies
