// Any bytes as a data file. The first byte chooses the reader, the rest is what it reads. A reader
// gives a value or says what is wrong with the file; nothing else may happen.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "control/core/rational.h"
#include "control/data/table.h"
#include "control/plugin/elf_constant.h"
#include "control/plugin/plugin_abi.h"
#include "language/units.h"
#include "output/files/csv.h"
#include "output/files/hash.h"
#include "output/movies/movie.h"
#include "output/records/spool.h"
#include "simulation/run/changes.h"
#include "simulation/scene/mjcf/mjcf.h"
#include "simulation/scene/sdf/sdf.h"
#include "simulation/scene/terrain/ascii_grid.h"
#include "simulation/scene/terrain/png_grid.h"
#include "simulation/scene/urdf/hull.h"
#include "simulation/scene/urdf/mesh.h"
#include "simulation/scene/urdf/urdf.h"
#include "studies/cluster/journal.h"
#include "studies/cluster/run_list.h"
#include "studies/run/run_folder.h"
#include "studies/run/run_record.h"
#include "studies/run/run_store.h"
#include "tests/fuzz/fuzz.h"
#include "text/display.h"
#include "text/json_reader.h"
#include "text/utf8.h"

namespace hookpoint {
namespace {

std::filesystem::path written(const std::string& bytes, const char* name) {
  static const fuzz::Folder folder;
  const std::filesystem::path file = folder.path() / name;
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

void require_series(const control::Table& table) {
  fuzz::require(!table.time.empty() && !table.columns.empty(), "a table without numbers");
  for (std::size_t i = 0; i < table.time.size(); ++i) {
    fuzz::require(std::isfinite(table.time[i]), "a time that is not finite");
    fuzz::require(i == 0 || table.time[i] > table.time[i - 1], "time that does not increase");
  }
  for (const std::vector<double>& column : table.columns) {
    fuzz::require(column.size() == table.time.size(), "a series of two lengths");
    for (const double value : column)
      fuzz::require(std::isfinite(value), "a series that is not finite");
  }
}

void read_csv(const std::string& bytes) {
  const std::filesystem::path file = written(bytes, "table.csv");
  text::SeriesRequest request;
  request.gaps = text::Gaps::interpolate;
  try {
    require_series(control::read_csv_table(file, request));
  } catch (const std::runtime_error&) {
    request.sample_rate = 100.;
    require_series(control::read_csv_table(file, request));
  }
}

void read_mat(const std::string& bytes) {
  text::SeriesRequest request;
  request.columns = {"force"};
  require_series(control::read_mat_table(written(bytes, "series.mat"), request));
}

void read_grid(const std::string& bytes) {
  std::istringstream stream(bytes);
  const simulation::AsciiGridResult result = simulation::read_ascii_grid(stream);
  fuzz::require(result.grid.has_value() == result.message.empty(), "a grid and a message");
  if (!result.grid) return;
  const simulation::AsciiGrid& grid = *result.grid;
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

using RobotReader = std::vector<language::ForeignObject>(const language::SourceFile&,
                                                         const language::ForeignArguments&,
                                                         language::FileStore&, language::Report&);
void read_robot_by(RobotReader* reader, const std::string& bytes) {
  const language::SourceFile file = language::source_file("robot.xml", bytes);
  language::Report report;
  const language::Schema schema;
  language::FileStore files(schema, {});
  const auto objects = reader(file, {}, files, report);
  fuzz::require(!objects.empty() || report.has_errors(), "neither a robot nor a mistake");
  language::Diagnostics diagnostics;
  report.deliver(diagnostics);
  for (const language::Diagnostic& diagnostic : diagnostics.all())
    fuzz::require(diagnostic.position.offset <= bytes.size(), "a place outside the file");
}

/// The same bytes as each kind of mesh.
void read_meshes(const std::string& bytes) {
  for (const auto& read : {simulation::read_stl, simulation::read_obj, simulation::read_collada}) {
    const simulation::MeshPoints mesh = read(bytes);
    fuzz::require(mesh.vertices.size() <= bytes.size() * 10'000, "vertices out of nothing");
    if (mesh.vertices.empty() || mesh.vertices.size() > 1000) continue;
    const auto hull = simulation::spread_points(mesh.vertices, 8);
    fuzz::require(hull.size() <= 8, "more points than were asked for");
  }
}

void read_robot(const std::string& bytes) {
  read_robot_by(simulation::include_urdf, bytes);
  read_robot_by(simulation::include_mjcf, bytes);
  read_robot_by(simulation::include_sdf, bytes);
  read_meshes(bytes);
}

void read_movie(const std::string& bytes) {
  const output::MovieReader movie(written(bytes, "movie.h5"));
  std::vector<double> state(movie.header().size);
  const std::size_t count = std::min<std::size_t>(movie.times().size(), 3);
  for (std::size_t i = 0; i < count; ++i) movie.read(i, state);
}

void read_spool(const std::string& bytes) {
  output::SpoolReader spool(written(bytes, "record.mat.spool"));
  std::vector<std::vector<double>> columns(
      std::min<std::size_t>(spool.header().channels.size(), 2) + 1);
  spool.read(0, columns);
  for (const std::vector<double>& column : columns)
    fuzz::require(column.size() == static_cast<std::size_t>(spool.rows()), "a column of rows");
}

void read_json(const std::string& bytes) {
  const auto leaves = text::json_leaves(bytes);
  if (!leaves) return;
  for (const auto& [path, text] : *leaves)
    fuzz::require(path.size() <= bytes.size() * 12, "a path that is longer than its document");
}

void read_table(const std::string& bytes) {
  const auto table = output::parse_csv(bytes);
  if (!table) return;
  for (const auto& row : table->rows)
    fuzz::require(row.size() == table->header.size(), "a row of another width");
  fuzz::require(output::parse_csv(table->text())->rows == table->rows, "a table that changes");
  for (const simulation::Change& change : simulation::read_changes(written(bytes, "changes.csv")))
    fuzz::require(std::isfinite(change.time), "a change at no time");
}

/// As the runs of a folder that is resumed: what is in them, then one more.
void read_store(const std::string& bytes) {
  static const fuzz::Folder folder("store");
  for (const char* suffix : {"", "-wal", "-shm", "-journal"})
    std::filesystem::remove(folder.path() / (std::string("runs.sqlite") + suffix));
  std::ofstream(folder.path() / "runs.sqlite", std::ios::binary) << bytes;
  studies::RunStore store(folder.path(), true);
  const std::string identity(32, '0');
  store.load(store.assigned("creep", 3).value_or(identity));
  store.timing(identity);
  store.save("creep", 4, identity, {});
  fuzz::require(store.assigned("creep", 4) == identity, "a run that is not its row's");
}

void read_png(const std::string& bytes) {
  const simulation::PngGridResult result =
      simulation::read_png_grid(written(bytes, "grid.png"), 0., 1.);
  fuzz::require(result.grid.has_value() == result.message.empty(), "a grid and a message");
  if (!result.grid) return;
  for (const double height : result.grid->heights)
    fuzz::require(height >= 0. && height <= 1., "a height out of its range");
}

void read_elf(const std::string& bytes) {
  const control::ElfConstant constant = control::read_constant(bytes, control::plugin_symbol);
  fuzz::require(constant.problem.empty() || constant.bytes.empty(), "a constant and a problem");
}

/// A kept run as it is, and with the hash that its numbers end with, without which nothing of them
/// is looked at; as samples; as a journal and as a list of runs.
void read_row(const std::string& bytes) {
  const std::string whole = bytes + "\nend " + output::Hash().add(bytes).text() + "\n";
  for (const std::string& text : {bytes, whole}) {
    auto record = studies::read_numbers(text);
    if (!record) continue;
    fuzz::require(studies::read_numbers(studies::numbers_text(*record)).has_value(),
                  "a run that is not read back");
    studies::read_samples(bytes + output::Hash().add(bytes).text(), *record);
  }
  std::string_view rest = bytes;
  while (studies::take_entry(rest))
    fuzz::require(rest.size() < bytes.size(), "an entry without bytes");
  try {
    studies::read_run_list(written(bytes, "list.json"));
  } catch (const studies::RunListError&) {
  }
}

/// The first byte chooses which file of a run it is.
void read_folder(const std::string& bytes) {
  static const fuzz::Folder folder("run");
  constexpr const char* names[] = {"experiment.hook", "results.csv", "provenance.json", "trace.csv",
                                   "timing.csv",      "scene.hook",  "files.json"};
  if (bytes.empty()) return;
  for (const char* name : names) std::ofstream(folder.path() / name, std::ios::binary);
  // As a run lists them that did not end: without hashes, which none of these bytes would have.
  std::ofstream(folder.path() / "files.json")
      << "{\"experiment\": \"e\", \"files\": {\"experiment.hook\": \"\", \"results.csv\": \"\", "
         "\"provenance.json\": \"\", \"trace.csv\": \"\", \"timing.csv\": \"\", "
         "\"scene.hook\": \"\"}}";
  const char* chosen = names[static_cast<unsigned char>(bytes[0]) % std::size(names)];
  std::ofstream(folder.path() / chosen, std::ios::binary) << bytes.substr(1);
  studies::read_run_folder(folder.path());
}

/// What is shown commands nothing, and a second time is the same.
void read_text(const std::string& bytes) {
  const std::string shown = text::printable(bytes);
  fuzz::require(text::find_control(shown) == std::string::npos, "a command to the terminal");
  fuzz::require(text::printable(shown) == shown, "a text that changes");
  fuzz::require(text::display_width(shown) <= 2 * bytes.size(), "a text that is too wide");
  const std::string repaired = text::repaired(bytes);
  fuzz::require(text::repaired(repaired) == repaired, "a text that is not repaired");
}

void run(char kind, const std::string& bytes) {
  constexpr void (*readers[])(const std::string&) = {
      read_csv,   read_mat,    read_grid, read_unit,  read_rational, read_robot,
      read_movie, read_spool,  read_json, read_table, read_png,      read_elf,
      read_row,   read_folder, read_text, read_store};
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
