#include "simulation/run/run_files.h"

#include <cmath>

#include "output/files/hash.h"
#include "output/records/files.h"
#include "simulation/engine_interface/identity.h"
#include "simulation/run/changes.h"
#include "simulation/wiring/port_search.h"

namespace hookpoint::simulation {
namespace {

constexpr const char* experiment_file = "experiment.hook";
constexpr const char* trace_file = "trace.csv";

/// The name that `file` has in the folder; "" of one that lies elsewhere.
std::string name_in(const std::filesystem::path& folder, const std::string& file) {
  const std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  const std::filesystem::path name = (whole / file).lexically_normal().lexically_relative(whole);
  return *name.begin() == ".." ? "" : name.string();
}

/// All that the run writes into the folder, but for experiment.hook.
std::vector<std::string> names_of(const Experiment& experiment, const RunFilesRequest& request) {
  std::vector<std::string> names;
  if (!request.trails.empty()) names.emplace_back(trace_file);
  for (const RecordSpec& record : experiment.records)
    for (std::string& file : output::record_files(record.format, record.file))
      names.push_back(std::move(file));
  for (const MovieSpec& movie : experiment.movies)
    if (std::string name = name_in(request.folder, movie.file); !name.empty())
      names.push_back(std::move(name));
  return names;
}

std::unique_ptr<output::ResultFolder> open_folder(const Experiment& experiment,
                                                  const RunFilesRequest& request,
                                                  const std::string& hash) {
  std::vector<std::string> names = names_of(experiment, request);
  if (names.empty() && !request.leaves_files) return nullptr;
  names.emplace_back(experiment_file);
  if (request.changes) names.emplace_back(ChangeLog::file_name);
  output::Manifest manifest;
  manifest.experiment = hash;
  manifest.about = {{"run", run_hash(hash, request.engine)},
                    {"hookpoint", HOOKPOINT_VERSION},
                    {"program", output::hash_of_program()},
                    {"engine", engine_text(request.engine)}};
  if (request.engine.name == "dts") manifest.about.emplace_back("law", experiment.contact);
  std::set<std::string> inputs = files_read(experiment);
  inputs.insert(request.sources.begin(), request.sources.end());
  manifest.inputs = hashed(inputs);
  return std::make_unique<output::ResultFolder>(request.folder, std::move(manifest),
                                                std::move(names));
}

}  // namespace

void add_movie(const std::filesystem::path& file, Experiment& experiment) {
  const std::string path =
      file.empty() ? std::string("movie.h5") : std::filesystem::absolute(file).string();
  for (const MovieSpec& movie : experiment.movies) {
    if (movie.file == path)
      throw ExperimentError("the file's Movie `" + movie.name + "` writes " + path +
                            "; give the movie that is added another name");
  }
  for (const RecordSpec& record : experiment.records) {
    if (record.file == path)
      throw ExperimentError("the file's Record `" + record.name + "` writes " + path +
                            "; give the movie that is added another name");
  }
  experiment.movies.push_back({"movie", path, std::nullopt});
}

void check_run_files(const Experiment& experiment, const std::vector<Port>& ports,
                     const RunFilesRequest& request) {
  find_all_ports(experiment, ports, request.trails);
  for (const RecordSpec& record : experiment.records)
    for (const output::Channel& channel : record.channels)
      find_port(experiment, ports, channel.path);
}

std::vector<std::string> run_files() {
  return {experiment_file, trace_file, ChangeLog::file_name, output::Manifest::file_name, ".lock"};
}

RunFiles::RunFiles(const Experiment& experiment, World& world, const std::vector<Port>& ports,
                   const RunFilesRequest& request, std::int64_t first_step)
    : RunFiles(experiment, world, ports, request,
               {request.text, experiment_hash(request.text, experiment)}, first_step) {}

RunFiles::RunFiles(const Experiment& experiment, World& world, const std::vector<Port>& ports,
                   const RunFilesRequest& request, const RunText& text, std::int64_t first_step)
    : place_(request.folder),
      ports_(find_all_ports(experiment, ports, request.trails)),
      values_(ports_.size()),
      folder_((check_run_files(experiment, ports, request),
               open_folder(experiment, request, text.hash))),
      movies_(experiment, world, request.folder, text, first_step),
      records_(experiment, ports, request.folder, text, first_step) {
  if (!ports_.empty()) {
    std::vector<output::TraceColumn> columns;
    for (const Port& port : ports_) columns.push_back({port.trail, port.unit});
    trace_.emplace(request.folder / trace_file, columns);
  }
  if (!folder_) return;
  output::write_file(request.folder / experiment_file, request.text);
  names_ = names_of(experiment, request);
  names_.insert(names_.begin(), experiment_file);
}

void RunFiles::row(std::int64_t step, double time) {
  records_.row(step, time);
  movies_.row(step);
  if (!trace_) return;
  for (std::size_t i = 0; i < ports_.size(); ++i) values_[i] = *ports_[i].value;
  trace_->row(time, values_);
}

void RunFiles::rebind(const Experiment& experiment, const World& world,
                      const std::vector<Port>& ports) {
  std::vector<Port> found;
  for (const Port& port : ports_) found.push_back(find_port(experiment, ports, port.trail));
  records_.rebind(experiment, ports);
  movies_.rebind(world);
  for (std::size_t i = 0; i < ports_.size(); ++i) ports_[i].value = found[i].value;
}

const std::string& RunFiles::first_not_finite() const {
  for (const Port& port : ports_)
    if (!std::isfinite(*port.value)) return port.trail;
  return records_.first_not_finite();
}

void RunFiles::close() {
  records_.close();
  movies_.close();
  if (trace_) trace_->close();
  if (folder_) folder_->finish();
}

void RunFiles::close_within_step() {
  records_.close();
  movies_.close_within_step();
  if (trace_) trace_->close();
  if (folder_) folder_->finish();
}

}  // namespace hookpoint::simulation
