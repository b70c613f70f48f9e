// Any bytes as a data file. The first byte chooses the reader, the rest is what it reads. A reader
// gives a value or says what is wrong with the file; nothing else may happen.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "contact/ascii_grid.h"
#include "control/rational.h"
#include "control/table.h"
#include "language/units.h"
#include "simulation/urdf.h"
#include "tests/fuzz/fuzz.h"

namespace hookpoint {
namespace {

std::filesystem::path written(const std::string& bytes, const char* name) {
  static const fuzz::Folder folder;
  const std::filesystem::path file = folder.path() / name;
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

void require_series(const control::Series& series) {
  fuzz::require(!series.time.empty() && series.time.size() == series.value.size(),
                "a series of two lengths");
  for (std::size_t i = 0; i < series.time.size(); ++i) {
    fuzz::require(std::isfinite(series.time[i]) && std::isfinite(series.value[i]),
                  "a series that is not finite");
    fuzz::require(i == 0 || series.time[i] > series.time[i - 1], "time that does not increase");
  }
}

void read_csv(const std::string& bytes) {
  const control::Table table = control::read_csv_table(written(bytes, "table.csv"));
  for (const std::string& name : table.names) {
    const std::vector<double>& first =
        table.columns[static_cast<std::size_t>(&name - table.names.data())];
    require_series({table.time, first});
  }
}

void read_mat(const std::string& bytes) {
  const std::filesystem::path file = written(bytes, "series.mat");
  require_series(control::read_mat_series(file, "force"));
}

void read_grid(const std::string& bytes) {
  std::istringstream stream(bytes);
  const contact::AsciiGridResult result = contact::read_ascii_grid(stream);
  fuzz::require(result.grid.has_value() == result.message.empty(), "a grid and a message");
  if (!result.grid) return;
  const contact::AsciiGrid& grid = *result.grid;
  fuzz::require(grid.heights.size() ==
                    static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns),
                "a grid that is not full");
}

void read_unit(const std::string& bytes) {
  if (const auto unit = language::scan_unit(bytes))
    fuzz::require(unit->length > 0 && unit->length <= bytes.size(), "a unit longer than its text");
  language::parse_unit(bytes);
}

void read_rational(const std::string& bytes) {
  double value = 0.;
  std::memcpy(&value, bytes.data(), std::min(bytes.size(), sizeof value));
  const double back = control::Rational::from(value).value();
  fuzz::require(std::fabs(back - value) <= 1e-15 * std::fabs(value),
                "a fraction far from its number");
}

void read_urdf(const std::string& bytes) {
  language::SourceFile file{"robot.urdf", bytes, {}};
  language::index_lines(file);
  language::Report report;
  const auto objects = simulation::include_urdf(file, {}, report);
  fuzz::require(!objects.empty() || report.has_errors(), "neither a robot nor a mistake");
  language::Diagnostics diagnostics;
  report.deliver(diagnostics);
  for (const language::Diagnostic& diagnostic : diagnostics.all())
    fuzz::require(diagnostic.position.offset <= bytes.size(), "a place outside the file");
}

void run(char kind, const std::string& bytes) {
  constexpr void (*readers[])(const std::string&) = {read_csv,  read_mat,      read_grid,
                                                     read_unit, read_rational, read_urdf};
  try {
    readers[static_cast<unsigned char>(kind) % std::size(readers)](bytes);
  } catch (const std::exception&) {
    // What is wrong with the file was said.
  }
}

}  // namespace
}  // namespace hookpoint

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0)
    hookpoint::run(static_cast<char>(data[0]), {reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}
