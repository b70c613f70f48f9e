// Many worlds of one file, stepped by threads, with arrays in and out.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/python/busy.h"
#include "apps/python/loaded_file.h"
#include "apps/python/made_whole.h"
#include "apps/python/state_values.h"
#include "simulation/run/energy_watch.h"
#include "simulation/run/saved_state.h"

namespace hookpoint::python {

/// What a world is loaded with; one a world.
using Variants = std::vector<LoadedFile::Variant>;

struct BatchOptions {
  int threads = 0;                             ///< 0: one a core
  Variants variants;                           ///< one a world
  std::vector<std::string> observed, written;  ///< trails
  std::optional<std::string> done;             ///< trail that is not 0 once a world is done
};

/// Which worlds a reset takes back, and to what.
struct BatchReset {
  pybind11::object mask;             ///< None: all
  pybind11::object state;            ///< None: as the file says
  std::optional<Variants> variants;  ///< one a world; none: they stay
};

/// Most worlds of a Batch.
inline constexpr std::int64_t most_worlds = 100'000;

/// Each world bit for bit what it is alone, for any number of threads. The file is shared by all,
/// an experiment by the worlds of one variant.
class PythonBatch : public MadeWhole {
 public:
  /// All at time 0. Throws hookpoint.Error, and KeyboardInterrupt.
  PythonBatch(std::shared_ptr<LoadedFile> file, const BatchOptions& options);

  /// Writes `actions`, unless they are None, and takes `count` steps in each world that is not
  /// done, fewer where it comes to be. Throws hookpoint.Error for actions of another shape, that
  /// are not finite or out of a port's range.
  void step(const pybind11::object& actions, std::int64_t count);
  /// Throws hookpoint.Error, and then no world has changed.
  void reset(const BatchReset& reset);
  pybind11::bytes state(std::size_t world);
  void set_state(std::size_t world, const pybind11::bytes& state);

  /// A Batch of its own whose worlds continue as these do.
  std::unique_ptr<PythonBatch> copy();
  /// What it was made with, each world as it is since its last reset.
  BatchOptions options() const;
  /// Takes over states, failures, {world: why}, and what the next step writes.
  void continue_from(const pybind11::list& states, const pybind11::dict& failures,
                     const pybind11::array_t<double>& actions);
  /// Of all worlds, in order.
  pybind11::list states();

  std::size_t size() const { return worlds_.size(); }
  int threads() const { return threads_; }
  const LoadedFile& file() const { return *file_; }
  /// What world `world` was loaded with.
  const LoadedFile::Variant& variant(std::size_t world) const {
    return worlds_[world].kind->variant;
  }
  /// Rows of the observed numbers, a row a world; its memory lasts, as that of all arrays here.
  const pybind11::array_t<double>& observations() const { return observations_; }
  /// What the next step writes.
  const pybind11::array_t<double>& actions() const { return actions_; }
  const pybind11::array_t<bool>& done() const { return done_; }
  pybind11::array_t<double> time() const;
  pybind11::array_t<std::uint64_t> seeds() const;
  /// The trails of the columns.
  const std::vector<std::string>& observation_trails() const { return observation_trails_; }
  std::vector<std::string> action_trails() const;
  /// Why steps could not be taken, by world.
  pybind11::dict failures() const;
  /// Of the file, and of worlds since their last reset, with their numbers.
  std::vector<std::string> notices() const;
  std::string repr() const;

 private:
  /// What worlds of one variant share.
  struct Kind {
    LoadedFile::Variant variant;
    simulation::Experiment experiment;
    std::string warning;        ///< of its step
    std::vector<double> start;  ///< at time 0; empty: cannot be saved
    std::optional<simulation::StateBytes> state_bytes;
  };
  struct Member {
    std::shared_ptr<Kind> kind;  ///< outlives the world
    std::unique_ptr<simulation::World> world;
    std::vector<const double*> observed;
    std::vector<double*> written;
    const double* done = nullptr;
    std::string failure;
    std::vector<std::string> notices;  ///< since the last reset
    std::size_t next_notice = 0;       ///< of the engine's
    std::size_t warned = 0;            ///< notices that are warnings already
  };
  /// The memory of the arrays, which they own together with the Batch.
  struct Memory {
    std::vector<double> observed, written;
    std::unique_ptr<bool[]> finished;
  };

  /// A new world and the ports behind its columns.
  struct Made {
    Member member;
    std::vector<simulation::Port> observed, written;
  };

  /// Of each variant its kind, loaded by threads, in order. Throws hookpoint.FileError.
  std::vector<std::shared_ptr<Kind>> load(const Variants& variants);
  /// New worlds of those kinds, made by threads; the first world of all says which columns there
  /// are. Throws hookpoint.Error for worlds with others.
  std::vector<Member> make(const std::vector<std::shared_ptr<Kind>>& kinds);
  Made make_world(const std::shared_ptr<Kind>& kind) const;
  void make_arrays();
  /// Calls `work(i, stop)` with 0 ... count - 1 in threads, without the GIL. Throws what it threw
  /// for the first of them.
  template <class Work>
  void in_threads(std::size_t count, const Work& work) const;
  std::vector<std::size_t> worlds_of(const pybind11::object& mask) const;
  /// Back to time 0. An engine that refuses the state is a failure of the world.
  static void restart(Member& member, const std::vector<simulation::InitialValue>& values);
  void take_actions(const pybind11::object& given);
  Member& member(std::size_t world);
  const simulation::StateBytes& state_bytes(const Member& member);
  /// Without the GIL.
  void advance(std::size_t world, std::int64_t count, const std::atomic<bool>& stop);
  static void take_notices(Member& member);
  /// Whether the steps of all worlds are alike.
  void compare_steps();
  /// New notices as warnings, alike ones of several worlds once.
  void warn_of_notices();
  static bool is_done(const Member& member);
  /// Puts what is observed, and whether it is done, into the arrays.
  void show(std::size_t world);
  /// The present actions too.
  void show_all(std::size_t world);

  std::shared_ptr<LoadedFile> file_;
  BatchOptions options_;  // without the variants once the worlds are made
  int threads_ = 1;
  std::map<LoadedFile::Variant, std::shared_ptr<Kind>> kinds_;  // of the worlds
  std::string steps_notice_;  // of steps that differ; "" where they do not
  std::size_t checked_ = 0;   // kinds that were loaded so far
  std::vector<Member> worlds_;
  std::vector<std::string> observation_trails_;
  std::vector<simulation::Port> action_ports_;  // trails and ranges, of the first world
  std::vector<std::string> bodies_;             // trails of what every world has
  std::shared_ptr<Memory> memory_;
  pybind11::array_t<double> observations_, actions_;
  pybind11::array_t<bool> done_;
  std::atomic<bool> busy_{false};
};

}  // namespace hookpoint::python
