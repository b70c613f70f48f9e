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

#include "python/loaded_file.h"
#include "simulation/run/saved_state.h"

namespace hookpoint::python {

struct BatchOptions {
  std::size_t worlds = 1;
  int threads = 0;                             ///< 0: one a core
  std::vector<std::uint64_t> seeds;            ///< one a world; empty: the file's own
  std::vector<std::string> observed, written;  ///< trails
  std::optional<std::string> done;             ///< trail that is not 0 once a world is done
};

/// Each world bit for bit what it is alone, for any number of threads. The file and its experiment
/// are shared by the worlds of one seed.
class PythonBatch {
 public:
  /// All at time 0. Throws hookpoint.Error.
  PythonBatch(std::shared_ptr<LoadedFile> file, const BatchOptions& options);

  /// Writes `actions`, unless they are None, and takes `count` steps in each world that is not
  /// done, fewer where it comes to be. Throws hookpoint.Error for actions of another shape or that
  /// are not finite.
  void step(const pybind11::object& actions, std::int64_t count);
  /// Puts the worlds of `mask`, of None all, back to time 0. Throws hookpoint.Error.
  void reset(const pybind11::object& mask);
  pybind11::bytes state(std::size_t world);
  void set_state(std::size_t world, const pybind11::bytes& state);

  std::size_t size() const { return worlds_.size(); }
  int threads() const { return threads_; }
  const LoadedFile& file() const { return *file_; }
  /// Rows of the observed numbers, a row a world; its memory lasts, as that of all arrays here.
  const pybind11::array_t<double>& observations() const { return observations_; }
  /// What the next step writes.
  const pybind11::array_t<double>& actions() const { return actions_; }
  const pybind11::array_t<bool>& done() const { return done_; }
  pybind11::array_t<double> time() const;
  pybind11::array_t<std::uint64_t> seeds() const;
  /// The trails of the columns.
  const std::vector<std::string>& observation_trails() const { return observation_trails_; }
  const std::vector<std::string>& action_trails() const { return action_trails_; }
  /// Why steps could not be taken, by world.
  pybind11::dict failures() const;

 private:
  /// What worlds of one seed share.
  struct Kind {
    simulation::Experiment experiment;
    std::vector<double> start;  ///< at time 0; empty: cannot be saved
    std::optional<simulation::StateBytes> state_bytes;
  };
  struct Member {
    Kind* kind = nullptr;
    std::unique_ptr<simulation::World> world;
    std::vector<const double*> observed;
    std::vector<double*> written;
    const double* done = nullptr;
    std::string failure;
  };

  void add_world(Kind& kind, const BatchOptions& options);
  void take_actions(const pybind11::object& given);
  Member& member(std::size_t world);
  const simulation::StateBytes& state_bytes(const Member& member);
  /// Without the GIL.
  void advance(std::size_t world, std::int64_t count, const std::atomic<bool>& stop);
  static bool is_done(const Member& member);
  /// Puts what is observed, and whether it is done, into the arrays.
  void show(std::size_t world);
  /// The present actions too.
  void show_all(std::size_t world);

  std::shared_ptr<LoadedFile> file_;
  int threads_ = 1;
  std::map<std::uint64_t, Kind> kinds_;  // by seed
  std::vector<Member> worlds_;
  std::vector<std::string> observation_trails_, action_trails_;
  pybind11::array_t<double> observations_, actions_;
  pybind11::array_t<bool> done_;
  double* observed_ = nullptr;  // the arrays' memory
  double* written_ = nullptr;
  bool* finished_ = nullptr;
};

}  // namespace hookpoint::python
