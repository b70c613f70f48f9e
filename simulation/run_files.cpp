#include "simulation/run_files.h"

namespace hookpoint::simulation {
namespace {

std::vector<Port> find_ports(const Experiment& experiment, const std::vector<Port>& ports,
                             const std::vector<std::string>& trails) {
  std::vector<Port> found;
  for (const std::string& trail : trails) found.push_back(find_port(experiment, ports, trail));
  return found;
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
  experiment.movies.push_back({"movie", path, std::nullopt});
}

// What cannot be written is found out before anything is.
RunFiles::RunFiles(const Experiment& experiment, World& world, const std::vector<Port>& ports,
                   const RunRequest& request, std::int64_t first_step)
    : ports_(find_ports(experiment, ports, request.trails)),
      values_(ports_.size()),
      movies_(experiment, world, request.folder, request.text, first_step),
      records_(experiment, ports, request.folder, request.text, first_step) {
  if (!ports_.empty()) {
    std::vector<output::TraceColumn> columns;
    for (std::size_t i = 0; i < ports_.size(); ++i)
      columns.push_back({request.trails[i], ports_[i].unit});
    trace_.emplace(request.folder / "trace.csv", columns);
  }
  if (request.leaves_files || trace_ || !experiment.records.empty())
    output::write_file(request.folder / "experiment.hook", request.text);
}

void RunFiles::row(std::int64_t step, double time) {
  records_.row(step, time);
  movies_.row(step);
  if (!trace_) return;
  for (std::size_t i = 0; i < ports_.size(); ++i) values_[i] = *ports_[i].value;
  trace_->row(time, values_);
}

void RunFiles::close() {
  records_.close();
  movies_.close();
  if (trace_) trace_->close();
}

}  // namespace hookpoint::simulation
