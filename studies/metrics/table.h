// The families of metrics, one a file; a family's rows stand in its file, and table.cpp has their
// order in the manual. A new metric is a row and its name there (docs/adding_a_metric.md).
#pragma once

#include <span>
#include <string_view>

#include "studies/measure/metric.h"

namespace hookpoint::studies {

std::span<const MetricDefinition> conservation_metrics();
std::span<const MetricDefinition> contact_metrics();
std::span<const MetricDefinition> force_metrics();
std::span<const MetricDefinition> integrator_metrics();
std::span<const MetricDefinition> joints_metrics();
std::span<const MetricDefinition> motion_metrics();
std::span<const MetricDefinition> stability_metrics();
std::span<const MetricDefinition> stance_metrics();
std::span<const MetricDefinition> threshold_metrics();
std::span<const MetricDefinition> walk_metrics();
std::span<const MetricDefinition> work_metrics();
std::span<const MetricDefinition> several_runs_metrics();

/// Names of all metrics in the order of the manual; metric_table() has a row for each, and no other.
std::span<const std::string_view> metric_order();

}  // namespace hookpoint::studies
