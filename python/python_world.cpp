#include "python/python_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "output/text/number.h"
#include "python/errors.h"
#include "python/trails.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

py::array_t<double> array_of(const std::vector<double>& numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

}  // namespace

PythonWorld::PythonWorld(std::shared_ptr<LoadedFile> file)
    : file_(std::move(file)), world_(file_->make_world(experiment())), ports_(world_->ports()) {
  first_notices_ = next_notice_ = world_->state().notices.size();
  if (!world_->can_be_saved()) return;
  start_.resize(world_->state_size());
  world_->save(start_);
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
  Clock::time_point looked = count > 1 ? Clock::now() : Clock::time_point{};
  for (std::int64_t i = 0; i < count && world_->ended().empty(); ++i) {
    if (viewed_input_) world_->follow();
    const simulation::StepStatus status = world_->step();
    if (!status.ok()) return status;
    recording.next(world_->state());
    // After the last Python looks by itself.
    if (i + 1 == count || Clock::now() - looked < patience) continue;
    looked = Clock::now();
    const py::gil_scoped_acquire ours;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return {};
}

void PythonWorld::step(std::int64_t count, const py::object& callback, std::int64_t every) {
  if (count < 0) throw_error("step takes a number of steps that is not negative");
  if (every < 1) throw_error("`every` is a number of steps, 1 or more");
  const std::int64_t stretch = callback.is_none() ? count : every;
  for (std::int64_t left = count; left > 0 && world_->ended().empty(); left -= stretch) {
    Recording none;
    none.every = count + 1;
    const simulation::StepStatus status = advance(std::min(left, stretch), none);
    if (!status.ok()) throw_failure(status);
    if (callback.is_none()) continue;
    const py::object told = callback(py::cast(this));
    const int goes_on = told.is_none() ? 1 : PyObject_IsTrue(told.ptr());
    if (goes_on < 0) throw py::error_already_set();
    if (goes_on == 0) return;
  }
}

void PythonWorld::reset() {
  if (start_.empty()) state_bytes();  // says why
  world_->restore(start_);
  next_notice_ = world_->state().notices.size();
}

const simulation::StateBytes& PythonWorld::state_bytes() {
  if (!state_bytes_)
    state_bytes_.emplace(file_->text_with_seed(experiment().seed), experiment(), *world_);
  return *state_bytes_;
}

py::bytes PythonWorld::state() { return state_bytes().of(*world_); }

void PythonWorld::set_state(const py::bytes& state) {
  state_bytes().restore(std::string_view(state), *world_);
}

std::unique_ptr<PythonWorld> PythonWorld::copy() {
  if (start_.empty()) state_bytes();
  auto made = std::make_unique<PythonWorld>(file_);
  std::vector<double> numbers(world_->state_size());
  world_->save(numbers);
  made->world_->restore(numbers);
  return made;
}

py::array PythonWorld::view(const py::object& self, const std::string& trail) {
  const std::vector<simulation::Port> elements = ports_of(experiment(), ports_, trail);
  const double* first = elements.front().value;
  const auto stride = elements.size() > 1 ? elements[1].value - first : 1;
  bool writable = true;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i].value - first != static_cast<std::ptrdiff_t>(i) * stride)
      throw_error(fmt::format("the elements of `{}` do not lie side by side: view each", trail));
    writable = writable && elements[i].writable != nullptr &&
               wire_to(experiment(), elements[i]) == nullptr;
  }
  std::vector<py::ssize_t> shape, strides;
  if (elements.size() > 1) {
    shape.push_back(static_cast<py::ssize_t>(elements.size()));
    strides.push_back(static_cast<py::ssize_t>(stride * sizeof(double)));
  }
  py::array_t<double> viewed(shape, strides, first, self);
  if (!writable) viewed.attr("setflags")(py::arg("write") = false);
  viewed_input_ = viewed_input_ || writable;
  return viewed;
}

std::vector<std::string> PythonWorld::notices() const {
  const std::vector<std::string>& all = world_->state().notices;
  std::vector<std::string> since(all.begin(),
                                 all.begin() + static_cast<std::ptrdiff_t>(first_notices_));
  since.insert(since.end(), all.begin() + static_cast<std::ptrdiff_t>(next_notice_), all.end());
  return since;
}

std::string PythonWorld::text_of_run(const RunOptions& options) {
  if (!options.duration || steps() > 0) return text();
  return file_->text_with("duration", output::shortest(*options.duration));
}

std::unique_ptr<simulation::RunFiles> PythonWorld::open_files(const RunOptions& options) {
  if (!options.output) {
    if (options.movie) throw_error("`movie` goes with `output`, the folder of what the run leaves");
    return nullptr;
  }
  simulation::Experiment written = experiment();
  if (options.movie) simulation::add_movie(*options.movie, written);
  return std::make_unique<simulation::RunFiles>(
      written, *world_, ports_,
      simulation::RunRequest{*options.output, options.trails, text_of_run(options), true,
                             file_->describe_engine(), file_->sources()},
      steps());
}

py::dict PythonWorld::run(const RunOptions& options) {
  if (options.every < 1) throw_error("`every` is a number of steps, 1 or more");
  const double left = options.duration ? *options.duration : experiment().duration - time();
  const double steps = std::round(left / experiment().deltat);
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
  return found_.emplace(trail, simulation::find_port(experiment(), ports_, trail)).first->second;
}

double PythonWorld::read(const std::string& trail) { return *port(trail).value; }

void PythonWorld::write(const std::string& trail, double value) {
  const simulation::Port& to = port(trail);
  require_writable(experiment(), to);
  if (!std::isfinite(value)) throw_error(fmt::format("`{}` takes a finite number", to.trail));
  world_->set(to, value);
}

py::list PythonWorld::ports() {
  py::list all;
  for (const simulation::Port& port : ports_)
    all.append(py::make_tuple(port.trail, port.unit, port.writable != nullptr));
  return all;
}

}  // namespace hookpoint::python
