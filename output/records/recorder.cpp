#include "output/records/recorder.h"

#include <array>
#include <cassert>
#include <stdexcept>

#include "output/records/formats.h"
#include "text/number.h"

namespace hookpoint::output {
namespace {

using Factory = std::unique_ptr<RecordWriter> (*)(const std::filesystem::path&,
                                                  const RecordHeader&);

constexpr std::array<RecordFormat, 6> formats{{
    {"csv", "csv", "comma-separated text, one line a row; channels in NAME.channels.csv"},
    {"mat5", "mat", "MATLAB and Octave, version 5: a struct a channel and a vector of times"},
    {"mat73", "mat", "MATLAB version 7.3 (HDF5 inside): the same, larger than 2 GB if need be"},
    {"hdf5", "h5", "HDF5: a compressed dataset a channel, annotated by attributes"},
    {"wl", "wl", "Mathematica: one association, read by Get"},
    {"mcap", "mcap",
     "MCAP for Foxglove, PlotJuggler, Rerun: a topic a channel, with JSON schema; poses and shapes",
     true},
}};

constexpr std::array<Factory, formats.size()> factories{make_csv_record,   make_mat5_record,
                                                        make_mat73_record, make_hdf5_record,
                                                        make_wl_record,    make_mcap_record};

}  // namespace

void RecordWriter::row(double time, std::span<const double> values) {
  if (values.size() != values_)
    throw std::logic_error("a row has not a value for each channel and a pose for each body");
  assert(!closed_);
  if (!refusal_.empty()) throw FileError(refusal_);
  time_ = time;
  try {
    append(time, values);
  } catch (const FileError& error) {
    refuse(error);
  }
}

void RecordWriter::close() {
  if (closed_ || !refusal_.empty()) return;
  try {
    finish();
    closed_ = true;
  } catch (const FileError& error) {
    refuse(error);
  }
}

void RecordWriter::refuse(const FileError& error) {
  const Kept kept = keep();
  refusal_ = std::string(error.what()) + ", at " + text::shortest(time_) + " s; the first " +
             std::to_string(kept.rows) + " rows are kept in " + kept.file.string();
  throw FileError(refusal_);
}

std::span<const RecordFormat> record_formats() { return formats; }

const RecordFormat* find_record_format(std::string_view name) {
  for (const RecordFormat& format : formats)
    if (format.name == name) return &format;
  return nullptr;
}

std::unique_ptr<RecordWriter> make_record_writer(std::string_view format,
                                                 const std::filesystem::path& path,
                                                 const RecordHeader& header) {
  const RecordFormat* known = find_record_format(format);
  if (known == nullptr)
    throw std::invalid_argument("no record format named " + std::string(format));
  return factories[static_cast<std::size_t>(known - formats.data())](path, header);
}

}  // namespace hookpoint::output
