// The classes of the language that a study is written with: Study, Subject, Sweep, Measure, Truth,
// Plot, Table, Fix, Only, Tune with Vary, Objective and Require, and Calibrate with Trace.
#pragma once

#include "language/schema/schema.h"

namespace hookpoint::studies {

/// Adds the classes of this folder. Call after the world's own have been added: a Subject's choices
/// of engine, law and integrator are those of `World`, so that there is one list of each.
void add_study_classes(language::Schema& schema);

}  // namespace hookpoint::studies
