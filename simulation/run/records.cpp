#include "simulation/run/records.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "simulation/run/shown_scene.h"

namespace hookpoint::simulation {
namespace {

output::RecordHeader header_of(const RecordSpec& spec, const Experiment& experiment,
                               const RunText& text) {
  output::RecordHeader header;
  header.name = spec.name;
  header.channels = spec.channels;
  header.annotations = run_annotations(experiment, text.hash);
  header.experiment = text.text;
  if (spec.scene && output::find_record_format(spec.format)->shows_scene)
    header.scene = shown_scene(experiment);
  return header;
}

/// Ports of a frame in the order of a pose in a row.
std::array<std::string, output::numbers_of_pose> pose_ports(const ShownFrame& frame) {
  const std::string place = frame.trail + "." + frame.position,
                    orientation = frame.trail + ".orientation";
  return {place + ".x",       place + ".y",       place + ".z",      orientation + ".w",
          orientation + ".x", orientation + ".y", orientation + ".z"};
}

}  // namespace

control::Schedule row_schedule(const std::optional<double>& rate, double deltat) {
  std::optional<control::Rational> exact;
  if (rate) exact = control::Rational::from(*rate);
  return {exact, control::Rational::from(deltat)};
}

std::vector<std::pair<std::string, std::string>> run_annotations(const Experiment& experiment,
                                                                 const std::string& hash) {
  return {{"hash", hash},
          {"hookpoint", HOOKPOINT_VERSION},
          {"world", experiment.world},
          {"engine", experiment.engine},
          {"contact", experiment.contact},
          {"integrator", experiment.integrator},
          {"deltat", fmt::format("{}", experiment.deltat)},
          {"seed", fmt::format("{}", experiment.seed)}};
}

Records::Records(const Experiment& experiment, const std::vector<Port>& ports,
                 const std::filesystem::path& folder, const RunText& text,
                 std::int64_t first_step) {
  for (const RecordSpec& spec : experiment.records) {
    Record record{row_schedule(spec.rate, experiment.deltat), {}, {}, {}, nullptr};
    output::RecordHeader header = header_of(spec, experiment, text);
    for (std::int64_t step = 0; step < first_step; ++step) record.schedule.due(step);
    header.period = record.schedule.period();
    const auto add = [&](const std::string& trail) {
      const Port port = find_port(experiment, ports, trail);
      record.sources.push_back(port.value);
      record.trails.push_back(port.trail);
      return port.unit;
    };
    for (output::Channel& channel : header.channels) {
      const std::string unit = add(channel.path);
      if (channel.unit.empty()) channel.unit = unit;
    }
    if (!header.scene.bodies.empty())
      for (const ShownFrame& frame : shown_frames(experiment))
        for (const std::string& port : pose_ports(frame)) add(port);
    record.values.resize(record.sources.size());
    record.writer = output::make_record_writer(spec.format, folder / spec.file, header);
    records_.push_back(std::move(record));
  }
}

void Records::rebind(const Experiment& experiment, const std::vector<Port>& ports) {
  std::vector<std::vector<const double*>> sources;
  for (const Record& record : records_) {
    sources.emplace_back();
    for (const std::string& trail : record.trails)
      sources.back().push_back(find_port(experiment, ports, trail).value);
  }
  for (std::size_t i = 0; i < records_.size(); ++i) records_[i].sources = std::move(sources[i]);
}

void Records::row(std::int64_t step, double time) {
  std::optional<output::FileError> refused;
  for (Record& record : records_) {
    if (!record.schedule.due(step)) continue;
    for (std::size_t i = 0; i < record.sources.size(); ++i) record.values[i] = *record.sources[i];
    try {
      record.writer->row(time, record.values);
    } catch (const output::FileError& error) {
      if (!refused) refused = error;
    }
  }
  if (refused) throw *refused;
}

const std::string& Records::first_not_finite() const {
  static const std::string none;
  for (const Record& record : records_) {
    for (std::size_t i = 0; i < record.sources.size(); ++i)
      if (!std::isfinite(*record.sources[i])) return record.trails[i];
  }
  return none;
}

void Records::close() {
  for (Record& record : records_) record.writer->close();
}

}  // namespace hookpoint::simulation
