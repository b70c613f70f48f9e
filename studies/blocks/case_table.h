// The table of a Cases block: a row a case, whose columns set Params of the scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/tree/fields.h"
#include "studies/results/assignment.h"

namespace hookpoint::studies {

/// A Cases block as its file has it.
struct CasesBlock {
  language::Placed<std::string> file, case_column;
  const language::Field* quick_values = nullptr;
};
CasesBlock cases_block(const language::Object& block);

/// A row: what it is called, and what it sets.
struct CaseRow {
  std::string name;
  std::vector<Assignment> settings;
};

struct CaseTable {
  std::vector<std::string> parameters;  ///< that have a column, by whose name they are called
  std::vector<CaseRow> cases;           ///< that the block's Only admits, in the order of the table
};

/// Of a Cases block, whose table is `file`; its columns set those of `parameters`, the scene's,
/// that are called like them. Nothing after errors: a column that there is not, one that sets a
/// Param and has a field that is no number, the same case twice, no case that Only admits.
std::optional<CaseTable> read_cases(const language::Object& block,
                                    const std::filesystem::path& file,
                                    const std::vector<std::string>& parameters,
                                    language::Diagnostics& diagnostics);

}  // namespace hookpoint::studies
