#include "python/python_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "python/errors.h"
#include "python/run_beside.h"
#include "python/trails.h"
#include "studies/workers.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;
using simulation::Port;

py::ssize_t signed_size(std::size_t size) { return static_cast<py::ssize_t>(size); }

/// "2 x 3".
std::string shape_text(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    text += (i > 0 ? " x " : "") + std::to_string(array.shape(i));
  return text;
}

/// The ports under `trails`, in order.
std::vector<Port> all_ports_of(const simulation::Experiment& experiment,
                               const std::vector<Port>& ports,
                               const std::vector<std::string>& trails) {
  std::vector<Port> all;
  for (const std::string& trail : trails) {
    for (Port& port : ports_of(experiment, ports, trail)) all.push_back(std::move(port));
  }
  return all;
}

std::vector<std::string> trails_of(const std::vector<Port>& ports) {
  std::vector<std::string> trails;
  for (const Port& port : ports) trails.push_back(port.trail);
  return trails;
}

}  // namespace

PythonBatch::PythonBatch(std::shared_ptr<LoadedFile> file, const BatchOptions& options)
    : file_(std::move(file)) {
  if (options.worlds < 1) throw_error("a Batch has one world or more");
  if (options.threads < 0) throw_error("`threads` is a number of threads, 0 for one a core");
  if (!options.seeds.empty() && options.seeds.size() != options.worlds)
    throw_error(
        fmt::format("`seeds` are one a world: {}, not {}", options.worlds, options.seeds.size()));
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  threads_ = options.threads > 0 ? options.threads : static_cast<int>(cores);
  worlds_.reserve(options.worlds);
  for (std::size_t i = 0; i < options.worlds; ++i) {
    const std::uint64_t seed = options.seeds.empty() ? file_->experiment().seed : options.seeds[i];
    const auto [place, added] = kinds_.try_emplace(seed);
    if (added) {
      place->second.experiment = file_->experiment();
      place->second.experiment.seed = seed;
    }
    add_world(place->second, options);
  }
  observations_ =
      py::array_t<double>({signed_size(size()), signed_size(observation_trails_.size())});
  actions_ = py::array_t<double>({signed_size(size()), signed_size(action_trails_.size())});
  done_ = py::array_t<bool>(signed_size(size()));
  observed_ = observations_.mutable_data();
  written_ = actions_.mutable_data();
  finished_ = done_.mutable_data();
  for (std::size_t i = 0; i < size(); ++i) show_all(i);
  observations_.attr("setflags")(py::arg("write") = false);
  done_.attr("setflags")(py::arg("write") = false);
}

void PythonBatch::add_world(Kind& kind, const BatchOptions& options) {
  Member& member = worlds_.emplace_back();
  member.kind = &kind;
  member.world = file_->make_world(kind.experiment);
  const std::vector<Port> ports = member.world->ports();
  const std::vector<Port> observed = all_ports_of(kind.experiment, ports, options.observed);
  const std::vector<Port> written = all_ports_of(kind.experiment, ports, options.written);
  for (const Port& port : written) require_writable(kind.experiment, port);
  if (worlds_.size() == 1) {
    observation_trails_ = trails_of(observed);
    action_trails_ = trails_of(written);
  }
  for (const Port& port : observed) member.observed.push_back(port.value);
  for (const Port& port : written) member.written.push_back(port.writable);
  if (options.done)
    member.done = simulation::find_port(kind.experiment, ports, *options.done).value;
  if (!kind.start.empty() || !member.world->can_be_saved()) return;
  kind.start.resize(member.world->state_size());
  member.world->save(kind.start);
}

void PythonBatch::take_actions(const py::object& given) {
  const std::size_t columns = action_trails_.size();
  if (!given.is_none()) {
    const auto array =
        py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
    if (!array || array.ndim() != 2 || array.shape(0) != signed_size(size()) ||
        array.shape(1) != signed_size(columns))
      throw_error(fmt::format("`actions` is an array of {} x {}, a row a world, not {}", size(),
                              columns, array ? shape_text(array) : "that"));
    std::copy_n(array.data(), array.size(), written_);
  }
  const double* const end = written_ + size() * columns;
  const double* const wrong = std::find_if_not<const double*>(
      written_, end, [](double value) { return std::isfinite(value); });
  if (wrong == end) return;
  const auto index = static_cast<std::size_t>(wrong - written_);
  throw_error(fmt::format("`{}` of world {} takes a finite number", action_trails_[index % columns],
                          index / columns));
}

void PythonBatch::step(const py::object& actions, std::int64_t count) {
  if (count < 0) throw_error("step takes a number of steps that is not negative");
  take_actions(actions);
  run_beside([&](const std::atomic<bool>& stop) {
    return studies::work_through(size(), threads_, [&](std::size_t world) {
      advance(world, count, stop);
      return !stop;
    });
  });
}

bool PythonBatch::is_done(const Member& member) {
  return !member.failure.empty() || !member.world->ended().empty() ||
         (member.done != nullptr && *member.done != 0.);
}

void PythonBatch::advance(std::size_t world, std::int64_t count, const std::atomic<bool>& stop) {
  Member& member = worlds_[world];
  if (finished_[world]) return;
  const double* action = written_ + world * member.written.size();
  for (double* port : member.written) *port = *action++;
  if (!member.written.empty()) member.world->follow();
  for (std::int64_t i = 0; i < count && !stop; ++i) {
    const simulation::StepStatus status = member.world->step();
    if (!status.ok())
      member.failure = fmt::format("at {:.6g} s: {}: {}", status.time, status.body, status.advice);
    if (is_done(member)) break;
  }
  show(world);
}

void PythonBatch::show(std::size_t world) {
  const Member& member = worlds_[world];
  double* row = observed_ + world * member.observed.size();
  for (const double* value : member.observed) *row++ = *value;
  finished_[world] = is_done(member);
}

void PythonBatch::show_all(std::size_t world) {
  const Member& member = worlds_[world];
  double* row = written_ + world * member.written.size();
  for (const double* value : member.written) *row++ = *value;
  show(world);
}

void PythonBatch::reset(const py::object& mask) {
  std::vector<bool> wanted(size(), true);
  if (!mask.is_none()) {
    const auto array = py::array_t<bool, py::array::c_style | py::array::forcecast>::ensure(mask);
    if (!array || array.ndim() != 1 || array.shape(0) != signed_size(size()))
      throw_error(fmt::format("`mask` has one value a world: {}, not {}", size(),
                              array ? shape_text(array) : "that"));
    for (std::size_t i = 0; i < size(); ++i) wanted[i] = array.data()[i];
  }
  for (std::size_t i = 0; i < size(); ++i) {
    if (!wanted[i]) continue;
    Member& member = worlds_[i];
    if (member.kind->start.empty()) state_bytes(member);  // says why
    member.world->restore(member.kind->start);
    member.failure.clear();
    show_all(i);
  }
}

PythonBatch::Member& PythonBatch::member(std::size_t world) {
  if (world >= size())
    throw py::index_error(fmt::format("there are worlds 0 to {}, no {}", size() - 1, world));
  return worlds_[world];
}

const simulation::StateBytes& PythonBatch::state_bytes(const Member& member) {
  Kind& kind = *member.kind;
  if (!kind.state_bytes)
    kind.state_bytes.emplace(file_->text_with_seed(kind.experiment.seed), kind.experiment,
                             *member.world);
  return *kind.state_bytes;
}

py::bytes PythonBatch::state(std::size_t world) {
  const Member& of = member(world);
  return state_bytes(of).of(*of.world);
}

void PythonBatch::set_state(std::size_t world, const py::bytes& state) {
  Member& of = member(world);
  state_bytes(of).restore(std::string_view(state), *of.world);
  of.failure.clear();
  show_all(world);
}

py::array_t<double> PythonBatch::time() const {
  py::array_t<double> times(signed_size(size()));
  for (std::size_t i = 0; i < size(); ++i)
    times.mutable_at(signed_size(i)) = worlds_[i].world->state().time;
  return times;
}

py::array_t<std::uint64_t> PythonBatch::seeds() const {
  py::array_t<std::uint64_t> seeds(signed_size(size()));
  for (std::size_t i = 0; i < size(); ++i)
    seeds.mutable_at(signed_size(i)) = worlds_[i].kind->experiment.seed;
  return seeds;
}

py::dict PythonBatch::failures() const {
  py::dict all;
  for (std::size_t i = 0; i < size(); ++i) {
    if (!worlds_[i].failure.empty()) all[py::int_(i)] = worlds_[i].failure;
  }
  return all;
}

}  // namespace hookpoint::python
