#include "studies/blocks/case_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "studies/blocks/only.h"
#include "studies/measurements/trace_file.h"

namespace hookpoint::studies {
namespace {

using language::Diagnostics;
using language::Object;

/// A column that sets a Param, which has its name.
struct SettingColumn {
  std::size_t column = 0;
  text::Column title;
};

/// An Only block: what a row's field must be.
struct AdmittedColumn {
  std::size_t column = 0;
  double to_si = 1.;
  OnlyBlock only;

  /// Of words or strings: what a field says, not its number.
  const std::vector<std::string>* words() const {
    return only.values == nullptr || only.values->words.empty() ? nullptr : &only.values->words;
  }
  bool admits(double value) const {
    const language::Field* values = only.values;
    if (values != nullptr && std::ranges::find(values->numbers, value) == values->numbers.end())
      return false;
    return (!only.from || value >= *only.from) && (!only.to || value <= *only.to);
  }
};

/// A Cases block and its table.
class CaseReader {
 public:
  CaseReader(const Object& object, const std::filesystem::path& file,
             const text::ForeignTable& table, Diagnostics& diagnostics)
      : object_(object),
        block_(cases_block(object)),
        file_(file),
        table_(table),
        diagnostics_(diagnostics) {}

  std::optional<CaseTable> read(const std::vector<std::string>& parameters) {
    const auto name =
        column_of(table_, *block_.case_column, file_, block_.case_column.position(), diagnostics_);
    if (!name || !find_admitted()) return std::nullopt;
    find_settings(parameters);
    CaseTable read;
    for (const SettingColumn& setting : settings_) read.parameters.push_back(setting.title.name);
    std::set<std::string> known;
    for (std::size_t row = 0; row < table_.rows.size(); ++row) {
      const std::string& text = table_.rows[row][*name];
      if (!known.insert(text).second) return wrong(row, fmt::format("`{}` is there already", text));
      const auto admitted = is_admitted(row);
      if (!admitted) return std::nullopt;
      if (!*admitted) continue;
      CaseRow& one = read.cases.emplace_back(CaseRow{text, {}});
      for (const SettingColumn& setting : settings_) {
        if (!number(row, setting.column)) return std::nullopt;
        const std::string& unit = setting.title.unit;
        one.settings.push_back({setting.title.name, table_.rows[row][setting.column] +
                                                        (unit.empty() ? "" : " " + unit)});
      }
    }
    if (!read.cases.empty()) return read;
    diagnostics_.error(object_.position, fmt::format("no row of {} is a case", file_.string()));
    return std::nullopt;
  }

 private:
  void find_settings(const std::vector<std::string>& parameters) {
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const text::Column& title = table_.columns[i];
      if (std::ranges::find(parameters, title.name) != parameters.end())
        settings_.push_back({i, title});
    }
  }

  /// Whether the Only blocks let the row in; nothing after an error.
  std::optional<bool> is_admitted(std::size_t row) {
    bool admitted = true;
    for (const AdmittedColumn& column : admitted_) {
      if (const std::vector<std::string>* words = column.words()) {
        const std::string& text = table_.rows[row][column.column];
        admitted = admitted && std::ranges::find(*words, text) != words->end();
        continue;
      }
      const auto value = number(row, column.column);
      if (!value) return std::nullopt;
      admitted = admitted && column.admits(*value * column.to_si);
    }
    return admitted;
  }

  bool find_admitted() {
    for (const Object* only : object_.children_of("Only")) {
      const auto column = column_of(table_, only->name, file_, only->position, diagnostics_);
      if (!column) return false;
      const std::string unit = table_.columns[*column].unit;
      const language::Unit written = language::parse_unit(unit).value_or(language::Unit{});
      admitted_.push_back({*column, written.numerator / written.denominator, only_block(*only)});
    }
    return true;
  }

  std::optional<double> number(std::size_t row, std::size_t column) {
    return number_at(table_, row, column, file_, block_.file.position(), diagnostics_);
  }
  std::nullopt_t wrong(std::size_t row, const std::string& what) {
    tell_wrong_row(file_, table_, row, what, block_.file.position(), diagnostics_);
    return std::nullopt;
  }

  const Object& object_;
  const CasesBlock block_;
  const std::filesystem::path& file_;
  const text::ForeignTable& table_;
  Diagnostics& diagnostics_;
  std::vector<SettingColumn> settings_;
  std::vector<AdmittedColumn> admitted_;
};

}  // namespace

std::optional<CaseTable> read_cases(const Object& block, const std::filesystem::path& file,
                                    const std::vector<std::string>& parameters,
                                    Diagnostics& diagnostics) {
  const auto tables = read_tables(file, cases_block(block).file.position(), diagnostics);
  if (!tables) return std::nullopt;
  return CaseReader(block, file, tables->front(), diagnostics).read(parameters);
}

}  // namespace hookpoint::studies
