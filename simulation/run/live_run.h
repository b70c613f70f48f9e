// A run that a user may change: its world, the files that it leaves, and the log of what was
// changed, by which it is repeated byte for byte. Whoever shows it and who repeats it (`run
// --changes`) step the same code.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "simulation/run/changes.h"
#include "simulation/run/run_files.h"
#include "simulation/run/start_values.h"
#include "simulation/run/world.h"

namespace hookpoint::simulation {

/// An experiment as a file with some fields overridden gives it.
struct LoadedExperiment {
  Experiment experiment;
  std::string text;                  ///< as printed
  std::vector<std::string> sources;  ///< files that it was made from, absolute
  EngineDescription engine;
  std::function<std::unique_ptr<Engine>(const Experiment&)> make_engine;
};

/// Loads the file with `overrides` ("trail=value", as --set takes them) beside what the command
/// line sets. Nothing when it is wrong; `problem` then says why.
using Load = std::function<std::optional<LoadedExperiment>(
    const std::vector<std::string>& overrides, std::string& problem)>;

struct LiveRunRequest {
  /// Where changes.csv goes too, once something is changed; empty: of nothing.
  std::filesystem::path folder;
  std::vector<std::string> trails;  ///< of trace.csv
  bool leaves_files = false;        ///< experiment.hook is written even beside nothing else
};

/// An instant to which a run can go back. A plain value; `numbers` keeps its room when it is saved
/// into again.
struct Moment {
  std::int64_t step = 0;
  std::size_t changes = 0;  ///< how many of the run's changes had been made
  std::vector<double> numbers;
};

class LiveRun {
 public:
  /// At time 0, its row written, the changes of `script` at step 0 made. `script`: changes that are
  /// made when their step comes. Throws ExperimentError, output::FolderError, output::FileError.
  LiveRun(Load load, LiveRunRequest request, std::vector<Change> script = {});
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  /// As the file and the edits have it, with the initial state that the take started from.
  const Experiment& experiment() const;
  World& world();
  const World& world() const;
  const WorldState& state() const { return world().state(); }
  /// Grows whenever `world()` is another one: who holds ports of it looks them up again.
  std::uint64_t generation() const { return generation_; }

  /// One step, its row, and then the changes of the script. Moves nothing while `World.running` is
  /// false. Allocates nothing where nothing is changed. Throws output::FileError, and ChangesError
  /// for a change of the script that cannot be made.
  StepStatus step();
  /// Why a run without a user ends here, or "" while it continues.
  std::string ended() const { return world().ended(); }

  /// All of `values` or, where something is wrong, none: "" or what is wrong. A press of a `Button`
  /// (any value but 0) is taken back by itself once each of its wires has sampled it.
  std::string set(std::span<const PortValue> values);
  /// A field of the file, `value` as --set takes it; the world continues from where it is under the
  /// new constants. "" or what is wrong.
  std::string edit(const std::string& trail, const std::string& value);
  /// Starts the run again at time 0, with edited fields and inputs as they are now: from the present pose at rest, with `values` in it. A new take, whose changes begin
  /// with what differs from the file. "" or what is wrong; the run then continues as it was.
  std::string start_from(std::span<const StartValue> values);
  /// What the take started from instead of the file's initial state.
  const std::vector<StartValue>& starts() const { return starts_; }
  /// To time 0 of the file as it now stands, without any change: a new take. "" or what is wrong;
  /// the run then continues as it was.
  std::string reset();

  /// What was changed up to the present moment, and after it where the run has gone back.
  const std::vector<Change>& changes() const { return log_.changes(); }
  /// "trail=value" of the edits in force.
  const std::vector<std::string>& overrides() const;

  /// Why the run cannot go back and cannot be edited: its engine cannot be saved. "" if it can.
  const std::string& no_history() const;
  /// The present moment. Throws ExperimentError where there is no history.
  void save(Moment& moment) const;
  /// Shows the moment of `step`: goes to `from`, a moment of this take at or before it, and repeats
  /// the way to `step`, its changes included. The files stay as they are. `at_each` is informed of
  /// `from`, and whenever the world has gone on or has become another one. "" or what is wrong.
  std::string seek(
      const Moment& from, std::int64_t step, const std::function<void()>& at_each = [] {});
  /// The step to which the take has come; the world's own is less while a past moment is shown.
  std::int64_t newest() const { return newest_; }
  /// Grows whenever a future is given up: by a step or a change from a past moment that later
  /// changes followed, by a change before `newest()`, by a reset. Moments later than the present
  /// one are then no longer of this run.
  std::uint64_t take() const { return take_; }

  /// A port that is to be written and is not finite, "" if there is none; a step says so too.
  const std::string& first_not_finite() const { return files_->first_not_finite(); }
  /// The last step by the experiment's duration.
  std::int64_t last_step() const;
  /// Changes of the script whose step has not come.
  std::size_t left_of_script() const { return script_.size() - scripted_; }
  /// Completes the files, once; a reset starts them again. Where a future was given up they are
  /// written again first, by repeating the take from time 0. Throws output::FileError.
  void close();
  /// The same while the world is within a step that does not end; nothing is repeated.
  void close_within_step();
  const std::filesystem::path& folder() const { return request_.folder; }
  /// What it leaves there, with changes.csv, where there is one.
  std::vector<std::string> names() const;

 private:
  struct Track;  ///< a world and what was changed in it
  using Loaded = std::shared_ptr<const LoadedExperiment>;

  Loaded loaded(const std::vector<std::string>& overrides, std::string& problem);
  std::vector<std::string> overrides_at(std::size_t changes) const;
  std::unique_ptr<Track> make_track(const std::vector<std::string>& overrides);
  std::unique_ptr<Track> edited(Track& track, const std::string& trail, const std::string& value,
                                std::string& problem);
  void use(std::unique_ptr<Track> track);
  RunFilesRequest files_of(const LoadedExperiment& loaded) const;
  std::unique_ptr<RunFiles> open_files(Track& track) const;
  void begin_take();
  void begin_take(std::unique_ptr<Track> track);
  bool writes() const { return files_ != nullptr && rewriting_ == nullptr; }
  std::int64_t present() const { return world().state().step; }
  void prepare_change();
  void give_up_future();
  void log(std::span<const Change> changes);
  void make_scripted_changes();
  void release_buttons();
  void repeat_change(std::unique_ptr<Track>& track, RunFiles* files);
  void repeat(
      std::unique_ptr<Track>& track, std::int64_t step, std::size_t changes, RunFiles* files,
      const std::function<void()>& at_each = [] {});
  void restore(const Moment& moment);

  Load load_;
  LiveRunRequest request_;
  std::vector<Change> script_;
  std::size_t scripted_ = 0;  ///< changes of the script that were made
  std::vector<std::pair<std::vector<std::string>, Loaded>> loaded_;  ///< by their overrides
  ChangeLog log_;
  std::vector<StartValue> starts_;  ///< of the take: the first of its changes
  std::vector<std::size_t> edits_;  ///< those of the changes that are of a field, in order
  std::unique_ptr<Track> track_;    ///< what is shown and stepped
  std::unique_ptr<Track>
      rewriting_;  ///< that the files follow, at time 0, once they are out of date
  std::unique_ptr<RunFiles> files_;
  bool closed_ = false;      ///< they are complete
  StepStatus start_;         ///< of what is to be written at time 0
  std::int64_t newest_ = 0;  ///< step of the take
  Moment last_;              ///< the newest moment, while a past one is shown
  std::uint64_t generation_ = 0, take_ = 0;
};

}  // namespace hookpoint::simulation
