#include "simulation/records.h"

#include <fmt/format.h>

#include <optional>

namespace hookpoint::simulation {
namespace {

control::Schedule schedule_of(const RecordSpec& spec, double deltat) {
  std::optional<control::Rational> rate;
  if (spec.rate) rate = control::Rational::from(*spec.rate);
  return {rate, control::Rational::from(deltat)};
}

output::RecordHeader header_of(const RecordSpec& spec, const Experiment& experiment) {
  output::RecordHeader header;
  header.name = spec.name;
  header.channels = spec.channels;
  header.annotations = {{"hookpoint", HOOKPOINT_VERSION},
                        {"world", experiment.world},
                        {"engine", experiment.engine},
                        {"contact", experiment.contact},
                        {"integrator", experiment.integrator},
                        {"deltat", fmt::format("{}", experiment.deltat)},
                        {"seed", fmt::format("{}", experiment.seed)}};
  return header;
}

}  // namespace

Records::Records(const Experiment& experiment, const std::vector<Port>& ports,
                 const std::filesystem::path& folder, const std::string& experiment_text) {
  for (const RecordSpec& spec : experiment.records) {
    Record record{schedule_of(spec, experiment.deltat), {}, {}, nullptr};
    output::RecordHeader header = header_of(spec, experiment);
    header.period = record.schedule.period();
    header.experiment = experiment_text;
    for (output::Channel& channel : header.channels) {
      const Port port = find_port(experiment, ports, channel.path);
      if (channel.unit.empty()) channel.unit = port.unit;
      record.sources.push_back(port.value);
    }
    record.values.resize(record.sources.size());
    record.writer = output::make_record_writer(spec.format, folder / spec.file, header);
    records_.push_back(std::move(record));
  }
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

void Records::close() {
  for (Record& record : records_) record.writer->close();
}

}  // namespace hookpoint::simulation
