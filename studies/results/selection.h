// Rows, sweeps and metrics of a study by name and value.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "simulation/experiment/experiment.h"
#include "studies/measure/engine_table.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

std::optional<std::size_t> sweep_index(const StudyResult& study, const std::string& name);
std::optional<std::size_t> metric_index(const StudyResult& study, const std::string& name);

/// A value of the sweep as text: its word, or `digits` significant digits.
std::string label_of(const SweepColumn& sweep, double value, int digits = 6);
/// The same exactly: a word, or the shortest text that reads back.
std::string exact_label_of(const SweepColumn& sweep, double value);
/// What runs the row: its subject, as a sweep may have composed it.
const SubjectInfo& composition_of(const StudyResult& study, const RunResult& row);
/// What runs an experiment, as the subject `name`: engine, law, integrator and settings that are in
/// force. A peer has a contact and an integrator of its own, an impulse law its own time advance.
SubjectInfo composition_of(const simulation::Experiment& experiment, const EngineTable& engines,
                           std::string name = "");

/// Whether two values of a sweep are the same but for rounding: 1e-9 of the greater.
bool same_value(double a, double b);
/// Whether the row has, of each sweep that `where` names, one of the values given there.
bool admits(const StudyResult& study, const SweepValues& where, const RunResult& row);

}  // namespace hookpoint::studies
