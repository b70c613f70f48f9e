// What `match` made of each law's ground, as the terminal, the report and matched.csv tell it.
#pragma once

#include <string>
#include <vector>

#include "output/files/csv.h"
#include "studies/results/result.h"

namespace hookpoint::studies {

/// A constant that was chosen for the runs of a subject on a material. Numbers to four digits,
/// "least … largest" where runs differ.
struct ChosenConstant {
  std::string name, unit, own, chosen;
};

struct MatchedLine {
  std::string subject, material;
  std::string under;                      ///< "9.81 N a contact that lands at 1.4 m/s"
  std::vector<ChosenConstant> constants;  ///< empty: hookpoint's serve
  std::string matched;  ///< "depth, stiffness, rebound", or what differs and how much
};

/// One a subject and material, in their order.
std::vector<MatchedLine> matched_lines(const StudyResult& study);

/// "normal_stiffness 2e+04 → 9810 N/m", joined by commas; "the file's own" where none was chosen.
std::string constants_text(const MatchedLine& line);

/// A row a run, material and constant, in full precision.
output::CsvTable matched_table(const StudyResult& study);

}  // namespace hookpoint::studies
