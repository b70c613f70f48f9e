#include "studies/blocks/schema.h"

#include "studies/blocks/calibrate.h"
#include "studies/blocks/cases.h"
#include "studies/blocks/claim.h"
#include "studies/blocks/fix.h"
#include "studies/blocks/matrix.h"
#include "studies/blocks/measure.h"
#include "studies/blocks/objective.h"
#include "studies/blocks/only.h"
#include "studies/blocks/plot.h"
#include "studies/blocks/study.h"
#include "studies/blocks/subject.h"
#include "studies/blocks/sweep.h"
#include "studies/blocks/table.h"
#include "studies/blocks/trace.h"
#include "studies/blocks/truth.h"
#include "studies/blocks/tune.h"
#include "studies/blocks/vary.h"
#include "studies/blocks/wall.h"

namespace hookpoint::studies {

void add_study_classes(language::Schema& schema) {
  add_study_class(schema);
  add_wall_classes(schema);
  add_matrix_classes(schema);
  add_subject_class(schema);
  add_sweep_class(schema);
  add_measure_class(schema);
  add_truth_class(schema);
  add_plot_class(schema);
  add_table_class(schema);
  add_claim_class(schema);
  add_reference_class(schema);
  add_fix_class(schema);
  add_only_class(schema);
  add_tune_class(schema);
  add_calibrate_class(schema);
  add_trace_classes(schema);
  add_cases_class(schema);
  add_vary_class(schema);
  add_objective_classes(schema);
  add_require_class(schema);
}

}  // namespace hookpoint::studies
