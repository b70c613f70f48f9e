#include "apps/python/python_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <unordered_set>
#include <utility>

#include "apps/python/arguments.h"
#include "apps/python/errors.h"
#include "apps/python/gil.h"
#include "apps/python/state_values.h"
#include "apps/python/trails.h"
#include "simulation/engine_interface/step_count.h"
#include "simulation/run/energy_watch.h"
#include "simulation/run/initial_state.h"
#include "simulation/run/loop.h"
#include "simulation/wiring/port_value.h"
#include "text/number.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;

py::array_t<double> array_of(const std::vector<double>& numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

/// Each port once: of two ports of one trail the first hides the second.
std::vector<simulation::Port> without_hidden(std::vector<simulation::Port> ports) {
  std::unordered_set<std::string> seen;
  std::erase_if(ports,
                [&](const simulation::Port& port) { return !seen.insert(port.trail).second; });
  return ports;
}

}  // namespace

PythonWorld::PythonWorld(std::shared_ptr<LoadedFile> file)
    : file_(std::move(file)),
      world_(file_->make_world(experiment())),
      ports_(without_hidden(world_->ports())),
      notices_(file_->notices()) {
  take_notices();
  first_notices_ = notices_.size();
  if (!world_->can_be_saved()) return;
  start_.resize(world_->state_size());
  world_->save(start_);
}

/// The rows of a run as they come.
struct PythonWorld::Recording {
  struct Column {
    std::vector<const double*> from;  ///< the elements
    std::vector<double> values;       ///< rows
  };
  std::int64_t every = 1, since = 0;
  std::vector<double> time;
  std::vector<Column> columns;  ///< one a trail
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
    for (Column& column : columns) {
      for (const double* value : column.from) column.values.push_back(*value);
    }
  }
  /// An array of rows, with a second dimension where a row has several numbers.
  static py::array_t<double> array(const Column& column) {
    const auto width = static_cast<py::ssize_t>(column.from.size());
    if (width == 1) return array_of(column.values);
    const auto rows = static_cast<py::ssize_t>(column.values.size()) / width;
    return py::array_t<double>({rows, width}, column.values.data());
  }
};

/// Watches the energy of the steps of one call (energy_watch.h).
class PythonWorld::Watch {
 public:
  Watch(PythonWorld& owner, std::int64_t count) : owner_(owner) {
    if (count >= simulation::EnergyWatch::fewest_steps)
      energy_.emplace(owner.experiment(), *owner.world_, owner.steps() + count);
  }
  void observe() {
    if (energy_) energy_->observe();
  }
  /// After the last step.
  void finish() {
    if (!energy_) return;
    if (std::string finding = energy_->finding(); !finding.empty())
      owner_.add_notice(std::move(finding));
  }

 private:
  PythonWorld& owner_;
  std::optional<simulation::EnergyWatch> energy_;
};

simulation::StepStatus PythonWorld::check_viewed() const {
  for (const simulation::Port& port : viewed_inputs_) {
    const std::string problem = simulation::value_problem(port, *port.value);
    if (!problem.empty())
      return {simulation::StepStatus::Kind::not_finite, time(), port.trail,
              fmt::format("{} was written to a view of it, which {}", *port.value, problem)};
  }
  return {};
}

simulation::StepStatus PythonWorld::advance(std::int64_t count, Recording& recording,
                                            Watch& watch) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds patience{50};
  const Busy busy(busy_);
  WithoutGil others_run;
  Clock::time_point looked = count > 1 ? Clock::now() : Clock::time_point{};
  const std::int64_t last = steps() + count;
  simulation::StepStatus viewed;
  const auto before = [&] {
    if (interpreter_ends()) wait_for_the_end();
    if (viewed_inputs_.empty()) return true;
    viewed = check_viewed();
    if (viewed.ok()) world_->follow();
    return viewed.ok();
  };
  const auto after = [&] {
    recording.next(world_->state());
    watch.observe();
    // After the last Python looks by itself.
    if (steps() == last || Clock::now() - looked < patience) return;
    looked = Clock::now();
    const WithGil ours(others_run);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  const simulation::RunEnd end = simulation::run_until(*world_, last, before, after);
  return viewed.ok() ? end.status : viewed;
}

void PythonWorld::step(std::int64_t count, const py::object& callback, std::int64_t every) {
  if (count < 0) throw_error("step takes a number of steps that is not negative");
  if (every < 1) throw_error("`every` is a number of steps, 1 or more");
  const py::object self = callback.is_none() ? py::none() : py::cast(this);
  const std::int64_t stretch = callback.is_none() ? count : std::min(count, every);
  Watch watch(*this, count);
  for (std::int64_t left = count; left > 0 && world_->ended().empty(); left -= stretch) {
    Recording none;
    none.every = std::numeric_limits<std::int64_t>::max();
    const simulation::StepStatus status = advance(std::min(left, stretch), none, watch);
    take_notices();
    if (!status.ok()) throw_failure(status);
    if (callback.is_none()) continue;
    const auto answer = py::reinterpret_steal<py::object>(call(callback, self));
    if (!answer) throw py::error_already_set();
    const int continues = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
    if (continues < 0) throw py::error_already_set();
    if (continues == 0) break;
  }
  watch.finish();
}

void PythonWorld::reset(const py::object& state) {
  Busy::require_idle(busy_);
  const simulation::InitialState initial(experiment(), world_->state());
  const StateValues values(
      state, 1, [&](const std::string& trail) { return initial.find(trail, ports(trail)); });
  if (values.empty() && !start_.empty()) {
    world_->restore(start_);
  } else {
    if (!started_) started_ = experiment();
    simulation::write_initial_state(experiment(), values.of(0), *started_);
    world_->restart(*started_);
  }
  notices_.resize(first_notices_);
  next_notice_ = world_->state().notices.size();
}

void PythonWorld::take_notices() {
  const std::vector<std::string>& all = world_->state().notices;
  while (next_notice_ < all.size()) add_notice(all[next_notice_++]);
}

void PythonWorld::add_notice(std::string notice) {
  notices_.push_back(std::move(notice));
  warn(notices_.back());
}

const simulation::StateBytes& PythonWorld::state_bytes() {
  if (!state_bytes_)
    state_bytes_.emplace(file_->text_with_seed(experiment().seed), experiment(), *world_);
  return *state_bytes_;
}

py::bytes PythonWorld::state() {
  Busy::require_idle(busy_);
  return state_bytes().of(*world_);
}

void PythonWorld::set_state(const py::bytes& state) {
  Busy::require_idle(busy_);
  state_bytes().restore(std::string_view(state), *world_);
}

std::unique_ptr<PythonWorld> PythonWorld::copy() {
  Busy::require_idle(busy_);
  if (start_.empty()) state_bytes();
  auto made = make_whole<PythonWorld>(file_);
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
  if (!writable) {
    viewed.attr("setflags")(py::arg("write") = false);
    return viewed;
  }
  for (const simulation::Port& element : elements) {
    if (std::ranges::find(viewed_inputs_, element.value, &simulation::Port::value) ==
        viewed_inputs_.end())
      viewed_inputs_.push_back(element);
  }
  return viewed;
}

std::string PythonWorld::text_of_run(const RunOptions& options) {
  if (!options.duration || steps() > 0) return text();
  return file_->text_with("duration", text::shortest(*options.duration));
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
      simulation::RunFilesRequest{*options.output, options.trails, text_of_run(options), true,
                                  file_->describe_engine(), file_->sources()},
      steps());
}

py::dict PythonWorld::run(const RunOptions& options) {
  if (options.every < 1) throw_error("`every` is a number of steps, 1 or more");
  const double left = options.duration ? *options.duration : experiment().duration - time();
  const double steps = std::round(left / experiment().deltat);
  if (!(steps >= 0.)) throw_error("`duration` is a time in seconds that is not negative");
  if (const std::string problem = simulation::step_count_problem(left, experiment().deltat);
      !problem.empty())
    throw_error(problem);
  Recording recording;
  recording.every = options.every;
  for (const std::string& trail : options.trails) {
    Recording::Column& column = recording.columns.emplace_back();
    for (const simulation::Port& element : ports(trail)) column.from.push_back(element.value);
  }
  recording.files = open_files(options);
  // Whatever ends the run, what was recorded up to then stays; files are complete unless the disk
  // refuses.
  const auto keep = [&] {
    py::dict kept;
    kept["time"] = array_of(recording.time);
    for (std::size_t i = 0; i < options.trails.size(); ++i)
      kept[py::str(options.trails[i])] = Recording::array(recording.columns[i]);
    recorded_ = kept;
  };
  simulation::StepStatus status;
  Watch watch(*this, static_cast<std::int64_t>(steps));
  try {
    recording.first(world_->state());
    status = advance(static_cast<std::int64_t>(steps), recording, watch);
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
  take_notices();
  if (!status.ok()) throw_failure(status);
  watch.finish();
  return recorded_;
}

const std::vector<simulation::Port>& PythonWorld::ports(const std::string& trail) {
  const auto known = found_.find(trail);
  if (known != found_.end()) return known->second;
  return found_.emplace(trail, ports_of(experiment(), ports_, trail)).first->second;
}

py::object PythonWorld::read(const std::string& trail) {
  const std::vector<simulation::Port>& elements = ports(trail);
  if (elements.size() == 1) return py::float_(*elements.front().value);
  py::array_t<double> values(static_cast<py::ssize_t>(elements.size()));
  double* value = values.mutable_data();
  for (const simulation::Port& element : elements) *value++ = *element.value;
  return values;
}

void PythonWorld::write(const std::string& trail, const py::object& value) {
  const std::vector<simulation::Port>& elements = ports(trail);
  for (const simulation::Port& element : elements) require_writable(experiment(), element);
  const Numbers numbers = numbers_of(value, fmt::format("`{}`", trail));
  if (static_cast<std::size_t>(numbers.size()) != elements.size() ||
      numbers.ndim() > (elements.size() > 1 ? 1 : 0))
    throw_error(fmt::format("`{}` takes {}, not {}", trail,
                            elements.size() == 1 ? std::string("one number")
                                                 : fmt::format("{} numbers", elements.size()),
                            shape_text(numbers)));
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::string problem = simulation::value_problem(elements[i], numbers.data()[i]);
    if (!problem.empty()) throw_error(fmt::format("`{}` {}", elements[i].trail, problem));
  }
  Busy::require_idle(busy_);
  for (std::size_t i = 0; i < elements.size(); ++i) world_->set(elements[i], numbers.data()[i]);
}

std::string PythonWorld::repr() const {
  const std::size_t robots = experiment().robots.size();
  return fmt::format(
      "<hookpoint.World {}: engine {}, {} robot{}, deltat {:g} s, at {:g} s of {:g} s>",
      experiment().world, experiment().engine, robots, robots == 1 ? "" : "s", experiment().deltat,
      time(), experiment().duration);
}

py::list PythonWorld::ports() {
  py::list all;
  for (const simulation::Port& port : ports_)
    all.append(py::make_tuple(port.trail, port.unit, port.writable != nullptr));
  return all;
}

}  // namespace hookpoint::python
