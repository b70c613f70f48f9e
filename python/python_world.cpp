#include "python/python_world.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "output/text/number.h"
#include "python/errors.h"
#include "simulation/scene/load.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

/// "file.hook:3:5: message".
std::string placed(const language::Diagnostic& diagnostic) {
  if (diagnostic.position.file == nullptr) return diagnostic.message;
  const language::LineColumn place = language::line_and_column(diagnostic.position);
  return fmt::format("{}:{}:{}: {}", diagnostic.position.file->path, place.line, place.column,
                     diagnostic.message);
}

/// Whether the ends of a wire named by these trails are one port, or one is a part of the other.
bool same_port(const std::string& a, const std::string& b) {
  const std::string& shorter = a.size() < b.size() ? a : b;
  const std::string& longer = a.size() < b.size() ? b : a;
  return longer.starts_with(shorter) &&
         (longer.size() == shorter.size() || longer[shorter.size()] == '.');
}

py::array_t<double> array_of(const std::vector<double>& numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

}  // namespace

QuietApplication::QuietApplication(bool allow_plugins)
    : told_(std::make_shared<Told>()),
      application_(std::make_unique<application::Application>(
          allow_plugins, [told = told_](const language::Diagnostics& diagnostics) {
            told->last = diagnostics;
            for (const language::Diagnostic& diagnostic : diagnostics.all()) {
              if (diagnostic.severity == language::Severity::warning)
                told->warnings.push_back(placed(diagnostic));
            }
          })) {}

void QuietApplication::fail() const { throw_diagnostics(told_->last); }

void QuietApplication::pass_on_warnings() {
  for (const std::string& warning : std::exchange(told_->warnings, {})) warn(warning);
}

PythonWorld::PythonWorld(const Source& source)
    : source_(source), application_(source.allow_plugins) {
  if (source_.text) application_->give(source_.file, *source_.text);
  if (!application_->load_plugins(source_.file)) application_.fail();
  if (source_.engine) source_.settings = settings_with("engine", *source_.engine);
  const auto root = application_->evaluate(source_.file, source_.settings);
  if (!root) application_.fail();
  experiment_ = application_->load(*root);
  if (!experiment_) application_.fail();
  application_.pass_on_warnings();
  simulation::write_chosen_step(*experiment_, *root);
  text_ = language::print(*root);
  sources_ = language::sources_of(*root);
  world_ =
      std::make_unique<simulation::World>(*experiment_, application_->make_engine(*experiment_));
  ports_ = world_->ports();
}

std::vector<std::string> PythonWorld::settings_with(const std::string& field,
                                                    const std::string& value) {
  std::vector<std::string> settings = source_.settings;
  for (std::string& setting : application_->world_settings(source_.file, field, value))
    settings.push_back(std::move(setting));
  return settings;
}

/// The rows of a run as they come.
struct PythonWorld::Recording {
  std::vector<const double*> from;
  std::int64_t every = 1, since = 0;
  std::vector<double> time;
  std::vector<std::vector<double>> columns;  ///< one a trail
  std::unique_ptr<simulation::RunFiles> files;

  void first(const simulation::WorldState& state) {
    if (files) files->row(state.step, state.time);
    row(state.time);
  }
  void next(const simulation::WorldState& state) {
    if (files) files->row(state.step, state.time);
    if (++since < every) return;
    since = 0;
    row(state.time);
  }
  void row(double now) {
    time.push_back(now);
    for (std::size_t i = 0; i < from.size(); ++i) columns[i].push_back(*from[i]);
  }
};

simulation::StepStatus PythonWorld::advance(std::int64_t count, Recording& recording) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds patience{50};
  const py::gil_scoped_release others_run;
  Clock::time_point looked = Clock::now();
  for (std::int64_t i = 0; i < count && world_->ended().empty(); ++i) {
    const simulation::StepStatus status = world_->step();
    if (!status.ok()) return status;
    recording.next(world_->state());
    if (Clock::now() - looked < patience) continue;
    looked = Clock::now();
    const py::gil_scoped_acquire ours;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return {};
}

void PythonWorld::step(std::int64_t count) {
  if (count < 0) throw_error("step takes a number of steps that is not negative");
  Recording none;
  none.every = count + 1;
  const simulation::StepStatus status = advance(count, none);
  if (!status.ok()) throw_failure(status);
}

std::string PythonWorld::text_of_run(const RunOptions& options) {
  if (!options.duration || steps() > 0) return text_;
  const auto root = application_->evaluate(
      source_.file, settings_with("duration", output::shortest(*options.duration)));
  if (!root) application_.fail();
  simulation::write_chosen_step(*experiment_, *root);
  return language::print(*root);
}

std::unique_ptr<simulation::RunFiles> PythonWorld::open_files(const RunOptions& options) {
  if (!options.output) {
    if (options.movie) throw_error("`movie` goes with `output`, the folder of what the run leaves");
    return nullptr;
  }
  simulation::Experiment written = *experiment_;
  if (options.movie) simulation::add_movie(*options.movie, written);
  return std::make_unique<simulation::RunFiles>(
      written, *world_, ports_,
      simulation::RunRequest{*options.output, options.trails, text_of_run(options), true,
                             application_->describe_engine(*experiment_), sources_},
      steps());
}

py::dict PythonWorld::run(const RunOptions& options) {
  if (options.every < 1) throw_error("`every` is a number of steps, 1 or more");
  const double left = options.duration ? *options.duration : experiment_->duration - time();
  const double steps = std::round(left / experiment_->deltat);
  if (!(steps >= 0. && steps < 1e15))
    throw_error("`duration` is a time in seconds that is not negative");
  Recording recording;
  recording.every = options.every;
  for (const std::string& trail : options.trails) recording.from.push_back(port(trail).value);
  recording.columns.resize(options.trails.size());
  recording.files = open_files(options);
  // Whatever ends the run, what was recorded up to then stays; files are complete unless the disk
  // refuses.
  const auto keep = [&] {
    py::dict kept;
    kept["time"] = array_of(recording.time);
    for (std::size_t i = 0; i < options.trails.size(); ++i)
      kept[py::str(options.trails[i])] = array_of(recording.columns[i]);
    recorded_ = kept;
  };
  simulation::StepStatus status;
  try {
    recording.first(world_->state());
    status = advance(static_cast<std::int64_t>(steps), recording);
  } catch (const output::FileError&) {
    keep();
    throw;
  } catch (const py::error_already_set&) {
    keep();
    if (recording.files) recording.files->close();
    throw;
  }
  keep();
  if (recording.files) recording.files->close();
  if (!status.ok()) throw_failure(status);
  return recorded_;
}

const simulation::Port& PythonWorld::port(const std::string& trail) {
  const auto known = found_.find(trail);
  if (known != found_.end()) return known->second;
  return found_.emplace(trail, simulation::find_port(*experiment_, ports_, trail)).first->second;
}

double PythonWorld::read(const std::string& trail) { return *port(trail).value; }

void PythonWorld::write(const std::string& trail, double value) {
  const simulation::Port& to = port(trail);
  if (to.writable == nullptr) {
    throw_error(fmt::format("`{}` can be read, not written: inputs can, such as a joint's torque",
                            to.trail));
  }
  if (!std::isfinite(value)) throw_error(fmt::format("`{}` takes a finite number", to.trail));
  for (const simulation::WireSpec& wire : experiment_->wires) {
    if (same_port(wire.to, to.trail)) {
      throw_error(
          fmt::format("`{}` is driven by a wire from `{}`: write that, or leave the wire "
                      "out of the file",
                      to.trail, wire.from));
    }
  }
  *to.writable = value;
}

py::list PythonWorld::ports() {
  py::list all;
  for (const simulation::Port& port : ports_)
    all.append(py::make_tuple(port.trail, port.unit, port.writable != nullptr));
  return all;
}

}  // namespace hookpoint::python
