#include "apps/python/python_batch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <thread>
#include <utility>

#include "apps/python/errors.h"
#include "apps/python/memory.h"
#include "apps/python/run_beside.h"
#include "apps/python/trails.h"
#include "simulation/experiment/names.h"
#include "simulation/run/initial_state.h"
#include "simulation/run/loop.h"
#include "simulation/wiring/port_value.h"
#include "studies/measure/workers.h"

namespace hookpoint::python {
namespace {

namespace py = pybind11;
using simulation::Port;

/// A variant that cannot be loaded; its diagnostics say why.
struct WrongVariant {};

/// Worlds that are made before the memory of all is judged.
constexpr std::size_t sample = 32;
/// Settings whose step is compared with the largest stable one: that takes several times as long as
/// loading them.
constexpr std::size_t most_checked = 64;
/// Warnings of one call; the others are counted.
constexpr std::size_t most_warnings = 20;

py::ssize_t signed_size(std::size_t size) { return static_cast<py::ssize_t>(size); }

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

/// An array on memory that `owner` owns. numpy cannot free or resize it.
template <class Number>
py::array_t<Number> array_on(const std::shared_ptr<void>& owner, Number* memory,
                             std::vector<py::ssize_t> shape) {
  const py::capsule keeper(new std::shared_ptr<void>(owner),
                           [](void* held) { delete static_cast<std::shared_ptr<void>*>(held); });
  return py::array_t<Number>(std::move(shape), memory, keeper);
}

/// "world 3", "worlds 0, 1, 2 and 5 more".
std::string words_of(const std::vector<std::size_t>& worlds) {
  constexpr std::size_t most = 3;
  if (worlds.size() == 1) return fmt::format("world {}", worlds[0]);
  const std::vector<std::size_t> first(
      worlds.begin(), worlds.begin() + static_cast<std::ptrdiff_t>(std::min(most, worlds.size())));
  const std::string more =
      worlds.size() > most ? fmt::format(" and {} more", worlds.size() - most) : "";
  return fmt::format("worlds {}{}", fmt::join(first, ", "), more);
}

[[noreturn]] void throw_too_many(std::size_t worlds, double bytes, const std::string& room) {
  throw_error(fmt::format("{} worlds need about {:.2g} GB of memory, {}: make a Batch of fewer",
                          worlds, 1e-9 * bytes, room));
}

}  // namespace

template <class Work>
void PythonBatch::in_threads(std::size_t count, const Work& work) const {
  if (count == 0) return;
  std::vector<std::exception_ptr> failures(count);
  const int threads = static_cast<int>(std::min(static_cast<std::size_t>(threads_), count));
  run_beside([&](const std::atomic<bool>& stop) {
    return studies::work_through(count, threads, [&](std::size_t i) {
      try {
        work(i, stop);
      } catch (...) {
        failures[i] = std::current_exception();
      }
      return !stop && !failures[i];
    });
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

PythonBatch::PythonBatch(std::shared_ptr<LoadedFile> file, const BatchOptions& options)
    : file_(std::move(file)), options_(options) {
  const std::size_t worlds = options.variants.size();
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  threads_ = options.threads > 0 ? options.threads : static_cast<int>(cores);
  threads_ = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads_), worlds));
  const auto make_those = [&](std::size_t first, std::size_t end) {
    const auto begin = options.variants.begin();
    for (Member& made : make(load(Variants(begin + static_cast<std::ptrdiff_t>(first),
                                           begin + static_cast<std::ptrdiff_t>(end)))))
      worlds_.push_back(std::move(made));
  };
  const double before = allocated_memory();
  const std::size_t sampled = std::min(sample, worlds);
  double bytes = 0.;
  try {
    make_those(0, sampled);
    bytes =
        (allocated_memory() - before) / static_cast<double>(sampled) * static_cast<double>(worlds);
    const std::optional<double> room = free_memory();
    if (worlds > sampled && room && bytes > *room)
      throw_too_many(worlds, bytes, fmt::format("and {:.2g} GB are free", 1e-9 * *room));
    make_those(sampled, worlds);
    make_arrays();
  } catch (const std::bad_alloc&) {
    worlds_.clear();
    kinds_.clear();
    throw_too_many(worlds, bytes, "and the system gives no more");
  }
  options_.variants.clear();
  compare_steps();
  warn_of_notices();
}

std::vector<std::shared_ptr<PythonBatch::Kind>> PythonBatch::load(const Variants& variants) {
  std::vector<std::shared_ptr<Kind>> kinds, fresh;
  for (const LoadedFile::Variant& variant : variants) {
    std::shared_ptr<Kind>& kind = kinds_[variant];
    if (!kind) {
      kind = std::make_shared<Kind>();
      kind->variant = variant;
      fresh.push_back(kind);
    }
    kinds.push_back(kind);
  }
  std::vector<language::Diagnostics> diagnostics(fresh.size());
  try {
    in_threads(fresh.size(), [&](std::size_t i, const std::atomic<bool>& /*stop*/) {
      LoadedFile::LoadedVariant loaded = file_->load_variant(fresh[i]->variant);
      diagnostics[i] = std::move(loaded.diagnostics);
      if (!loaded.experiment) throw WrongVariant();
      fresh[i]->experiment = std::move(*loaded.experiment);
      if (checked_ + i < most_checked) fresh[i]->warning = warning_of_step(fresh[i]->experiment);
    });
    checked_ += fresh.size();
  } catch (...) {
    for (const std::shared_ptr<Kind>& kind : fresh) kinds_.erase(kind->variant);
    for (const language::Diagnostics& of : diagnostics) {
      if (of.has_errors()) throw_diagnostics(of);
    }
    throw;
  }
  return kinds;
}

PythonBatch::Made PythonBatch::make_world(const std::shared_ptr<Kind>& kind) const {
  Made made;
  Member& member = made.member;
  member.kind = kind;
  member.world = file_->make_world(kind->experiment);
  const std::vector<Port> ports = member.world->ports();
  made.observed = all_ports_of(kind->experiment, ports, options_.observed);
  made.written = all_ports_of(kind->experiment, ports, options_.written);
  for (const Port& port : made.observed) member.observed.push_back(port.value);
  for (const Port& port : made.written) member.written.push_back(port.writable);
  if (options_.done)
    member.done = simulation::find_port(kind->experiment, ports, *options_.done).value;
  if (!kind->warning.empty() &&
      std::ranges::find(file_->notices(), kind->warning) == file_->notices().end())
    member.notices.push_back(kind->warning);
  return made;
}

std::vector<PythonBatch::Member> PythonBatch::make(
    const std::vector<std::shared_ptr<Kind>>& kinds) {
  std::vector<Made> made(kinds.size());
  in_threads(kinds.size(), [&](std::size_t i, const std::atomic<bool>& /*stop*/) {
    made[i] = make_world(kinds[i]);
  });
  std::vector<Member> members;
  for (Made& one : made) {
    Kind& kind = *one.member.kind;
    for (const Port& port : one.written) require_writable(kind.experiment, port);
    if (bodies_.empty()) {
      observation_trails_ = trails_of(one.observed);
      action_ports_ = one.written;
      bodies_ = simulation::body_trails(kind.experiment);
    }
    if (trails_of(one.observed) != observation_trails_ ||
        trails_of(one.written) != trails_of(action_ports_) ||
        simulation::body_trails(kind.experiment) != bodies_)
      throw_error(
          "the worlds of a Batch have the same bodies and the same columns: with these "
          "settings they have not");
    if (kind.start.empty() && one.member.world->can_be_saved()) {
      kind.start.resize(one.member.world->state_size());
      one.member.world->save(kind.start);
    }
    take_notices(one.member);
    members.push_back(std::move(one.member));
  }
  return members;
}

void PythonBatch::make_arrays() {
  const std::size_t rows = size();
  memory_ = std::make_shared<Memory>();
  memory_->observed.resize(rows * observation_trails_.size());
  memory_->written.resize(rows * action_ports_.size());
  memory_->finished = std::make_unique<bool[]>(rows);
  observations_ = array_on(memory_, memory_->observed.data(),
                           {signed_size(rows), signed_size(observation_trails_.size())});
  actions_ = array_on(memory_, memory_->written.data(),
                      {signed_size(rows), signed_size(action_ports_.size())});
  done_ = array_on(memory_, memory_->finished.get(), {signed_size(rows)});
  for (std::size_t i = 0; i < rows; ++i) show_all(i);
  observations_.attr("setflags")(py::arg("write") = false);
  done_.attr("setflags")(py::arg("write") = false);
}

void PythonBatch::take_actions(const py::object& given) {
  const std::size_t columns = action_ports_.size();
  if (!given.is_none()) {
    const Numbers array = numbers_of(given, "`actions`");
    if (array.ndim() != 2 || array.shape(0) != signed_size(size()) ||
        array.shape(1) != signed_size(columns))
      throw_error(fmt::format("`actions` is an array of {} x {}, a row a world, not {}", size(),
                              columns, shape_text(array)));
    std::copy_n(array.data(), array.size(), memory_->written.data());
  }
  for (std::size_t i = 0; i < memory_->written.size(); ++i) {
    const Port& port = action_ports_[i % columns];
    const std::string problem = simulation::value_problem(port, memory_->written[i]);
    if (!problem.empty())
      throw_error(fmt::format("`{}` of world {} {}", port.trail, i / columns, problem));
  }
}

void PythonBatch::step(const py::object& actions, std::int64_t count) {
  if (count < 0) throw_error("step takes a number of steps that is not negative");
  const Busy busy(busy_);
  take_actions(actions);
  in_threads(size(), [&](std::size_t world, const std::atomic<bool>& stop) {
    advance(world, count, stop);
  });
  warn_of_notices();
}

bool PythonBatch::is_done(const Member& member) {
  return !member.failure.empty() || !member.world->ended().empty() ||
         (member.done != nullptr && *member.done != 0.);
}

void PythonBatch::advance(std::size_t world, std::int64_t count, const std::atomic<bool>& stop) {
  Member& member = worlds_[world];
  if (memory_->finished[world]) return;
  const double* action = memory_->written.data() + world * member.written.size();
  for (double* port : member.written) *port = *action++;
  if (!member.written.empty()) member.world->follow();
  std::optional<simulation::EnergyWatch> energy;
  if (count >= simulation::EnergyWatch::fewest_steps)
    energy.emplace(member.kind->experiment, *member.world, member.world->state().step + count);
  const auto observe = [&] {
    if (energy) energy->observe();
  };
  const simulation::RunEnd end = simulation::run_until(
      *member.world, member.world->state().step + count, [&] { return !stop && !is_done(member); },
      observe);
  if (end.failed()) member.failure = simulation::failure_text(end.status);
  take_notices(member);
  if (energy) {
    if (std::string finding = energy->finding(); !finding.empty())
      member.notices.push_back(std::move(finding));
  }
  show(world);
}

void PythonBatch::take_notices(Member& member) {
  const std::vector<std::string>& all = member.world->state().notices;
  while (member.next_notice < all.size()) member.notices.push_back(all[member.next_notice++]);
}

void PythonBatch::compare_steps() {
  const auto deltat = [](const Member& member) { return member.kind->experiment.deltat; };
  const auto [first, last] = std::ranges::minmax_element(worlds_, {}, deltat);
  const double least = deltat(*first), most = deltat(*last);
  std::string notice;
  if (least < most)
    notice = fmt::format(
        "worlds take steps of different length, from {:.4g} s to {:.4g} s: give deltat a number "
        "for a common one",
        least, most);
  if (notice != steps_notice_ && !notice.empty()) warn(notice);
  steps_notice_ = notice;
}

void PythonBatch::warn_of_notices() {
  std::vector<std::string> texts;
  std::map<std::string, std::vector<std::size_t>> worlds;
  for (std::size_t i = 0; i < size(); ++i) {
    Member& member = worlds_[i];
    for (; member.warned < member.notices.size(); ++member.warned) {
      const std::string& text = member.notices[member.warned];
      std::vector<std::size_t>& of = worlds[text];
      if (of.empty()) texts.push_back(text);
      of.push_back(i);
    }
  }
  const std::size_t shown = std::min(texts.size(), most_warnings);
  for (std::size_t i = 0; i < shown; ++i)
    warn(fmt::format("{}: {}", words_of(worlds[texts[i]]), texts[i]));
  if (shown < texts.size())
    warn(fmt::format("{} more notices: Batch.notices lists them", texts.size() - shown));
}

void PythonBatch::show(std::size_t world) {
  const Member& member = worlds_[world];
  double* row = memory_->observed.data() + world * member.observed.size();
  for (const double* value : member.observed) *row++ = *value;
  memory_->finished[world] = is_done(member);
}

void PythonBatch::show_all(std::size_t world) {
  const Member& member = worlds_[world];
  double* row = memory_->written.data() + world * member.written.size();
  for (const double* value : member.written) *row++ = *value;
  show(world);
}

std::vector<std::size_t> PythonBatch::worlds_of(const py::object& mask) const {
  std::vector<std::size_t> wanted;
  using Mask = py::array_t<bool, py::array::c_style | py::array::forcecast>;
  const Mask array = mask.is_none() ? Mask(signed_size(size())) : Mask::ensure(mask);
  if (!array || array.ndim() != 1 || array.shape(0) != signed_size(size()))
    throw_error(fmt::format("`mask` has one value a world: {}, not {}", size(),
                            array ? shape_text(array) : "that"));
  for (std::size_t i = 0; i < size(); ++i) {
    if (mask.is_none() || array.data()[i]) wanted.push_back(i);
  }
  return wanted;
}

void PythonBatch::restart(Member& member, const std::vector<simulation::InitialValue>& values) {
  member.failure.clear();
  try {
    if (values.empty() && !member.kind->start.empty()) {
      member.world->restore(member.kind->start);
    } else {
      simulation::Experiment start = member.kind->experiment;
      simulation::write_initial_state(member.kind->experiment, values, start);
      member.world->restart(start);
    }
  } catch (const simulation::ExperimentError& error) {
    member.failure = fmt::format("at 0 s: {}", error.what());
  }
}

void PythonBatch::reset(const BatchReset& to) {
  const Busy busy(busy_);
  const std::vector<std::size_t> wanted = worlds_of(to.mask);
  const Kind& first = *worlds_.front().kind;
  const simulation::InitialState initial(first.experiment, worlds_.front().world->state());
  std::vector<Port> ports;
  const StateValues values(to.state, size(), [&](const std::string& trail) {
    if (ports.empty()) ports = worlds_.front().world->ports();
    return initial.find(trail, ports_of(first.experiment, ports, trail));
  });
  // Everything that may be refused comes first.
  std::vector<std::size_t> changed;
  Variants variants;
  for (const std::size_t world : wanted) {
    if (!to.variants || (*to.variants)[world] == variant(world)) continue;
    changed.push_back(world);
    variants.push_back((*to.variants)[world]);
  }
  const std::vector<std::shared_ptr<Kind>> kinds = load(variants);
  std::vector<const Kind*> kind_of;
  for (const Member& member : worlds_) kind_of.push_back(member.kind.get());
  for (std::size_t i = 0; i < changed.size(); ++i) kind_of[changed[i]] = kinds[i].get();
  if (!values.empty()) {
    std::map<const Kind*, simulation::Experiment> trial;
    for (const std::size_t world : wanted) {
      const Kind* kind = kind_of[world];
      simulation::Experiment& start = trial.try_emplace(kind, kind->experiment).first->second;
      simulation::write_initial_state(kind->experiment, values.of(world), start);
    }
  }
  std::vector<Member> made = make(kinds);
  for (std::size_t i = 0; i < changed.size(); ++i) worlds_[changed[i]] = std::move(made[i]);

  const auto restart_one = [&](std::size_t i) {
    Member& member = worlds_[wanted[i]];
    restart(member, values.of(wanted[i]));
    const bool is_new = std::ranges::binary_search(changed, wanted[i]);
    if (is_new) return;
    member.notices.clear();
    member.warned = 0;
    member.next_notice = member.world->state().notices.size();
  };
  if (wanted.size() == 1 || values.empty()) {
    for (std::size_t i = 0; i < wanted.size(); ++i) restart_one(i);
  } else {
    in_threads(wanted.size(),
               [&](std::size_t i, const std::atomic<bool>& /*stop*/) { restart_one(i); });
  }
  for (const std::size_t world : wanted) show_all(world);
  std::erase_if(kinds_, [](const auto& kind) { return kind.second.use_count() == 1; });
  compare_steps();
  warn_of_notices();
}

PythonBatch::Member& PythonBatch::member(std::size_t world) {
  Busy::require_idle(busy_);
  if (world >= size())
    throw py::index_error(fmt::format("there are worlds 0 to {}, no {}", size() - 1, world));
  return worlds_[world];
}

const simulation::StateBytes& PythonBatch::state_bytes(const Member& member) {
  Kind& kind = *member.kind;
  if (!kind.state_bytes)
    kind.state_bytes.emplace(file_->text_of(kind.variant, kind.experiment), kind.experiment,
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

py::list PythonBatch::states() {
  py::list all;
  for (std::size_t i = 0; i < size(); ++i) all.append(state(i));
  return all;
}

BatchOptions PythonBatch::options() const {
  BatchOptions options = options_;
  options.threads = threads_;
  for (const Member& member : worlds_) options.variants.push_back(member.kind->variant);
  return options;
}

void PythonBatch::continue_from(const py::list& states, const py::dict& failures,
                                const py::array_t<double>& actions) {
  for (std::size_t i = 0; i < size(); ++i) {
    set_state(i, states[i].cast<py::bytes>());
    if (failures.contains(i)) worlds_[i].failure = failures[py::int_(i)].cast<std::string>();
    show(i);
  }
  if (static_cast<std::size_t>(actions.size()) != memory_->written.size())
    throw_error(fmt::format("a Batch with {} actions continues from as many, not {}",
                            memory_->written.size(), actions.size()));
  std::copy_n(actions.data(), actions.size(), memory_->written.data());
}

std::unique_ptr<PythonBatch> PythonBatch::copy() {
  auto made = make_whole<PythonBatch>(file_, options());
  made->continue_from(states(), failures(), actions_);
  return made;
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

std::vector<std::string> PythonBatch::action_trails() const { return trails_of(action_ports_); }

py::dict PythonBatch::failures() const {
  py::dict all;
  for (std::size_t i = 0; i < size(); ++i) {
    if (!worlds_[i].failure.empty()) all[py::int_(i)] = worlds_[i].failure;
  }
  return all;
}

std::vector<std::string> PythonBatch::notices() const {
  std::vector<std::string> all = file_->notices();
  if (!steps_notice_.empty()) all.push_back(steps_notice_);
  for (std::size_t i = 0; i < size(); ++i) {
    for (const std::string& notice : worlds_[i].notices)
      all.push_back(fmt::format("world {}: {}", i, notice));
  }
  return all;
}

std::string PythonBatch::repr() const {
  const simulation::Experiment& experiment = file_->experiment();
  return fmt::format(
      "<hookpoint.Batch of {} {}: world {}, engine {}, deltat {:g} s, {} observations, {} actions, "
      "{} thread{}>",
      size(), size() == 1 ? "world" : "worlds", experiment.world, experiment.engine,
      experiment.deltat, observation_trails_.size(), action_ports_.size(), threads_,
      threads_ == 1 ? "" : "s");
}

}  // namespace hookpoint::python
