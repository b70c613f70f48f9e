// The distances between subjects, as a matrix in the report.
#pragma once

#include <string>

#include "studies/results/result.h"

namespace hookpoint::studies {

/// Subjects x subjects, the largest distance over the swept values as number and colour, "" where
/// `peer_distance` is not measured.
std::string distance_table(const StudyResult& study);

}  // namespace hookpoint::studies
