// Runs made by the tasks of a Slurm job array on a file system that its machines share.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "studies/cluster/journal.h"
#include "studies/cluster/run_list.h"
#include "studies/cluster/slurm_script.h"
#include "studies/run/runs.h"

namespace hookpoint::studies {

/// No Slurm on this machine, or its controller does not answer. The message says what is missing.
struct NoSlurm : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// Slurm does not take the job. The message says why.
struct SlurmRefusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// Tasks failed twice. The message says why.
struct SlurmError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws NoSlurm when there is no sbatch.
void need_slurm();

/// Lists, journals and logs of a job stand in a folder of their own below `folder`, until its runs
/// are all there.
class SlurmRuns : public RemoteRuns {
 public:
  struct Options {
    SlurmSettings settings;
    SlurmPlace place;
    std::filesystem::path folder;  ///< absolute
    ForeignCode code;
    bool resume = false;  ///< takes up what an earlier front end left; else it is done away with
    std::function<void(const std::string&)> tell;  ///< what the user should know
  };
  explicit SlurmRuns(Options options);
  ~SlurmRuns() override;

  /// Submits, waits, hands the runs on as the journals grow, and submits what failed once more.
  /// When `stop` is set the tasks go on; who comes with `resume` waits for them. Throws NoSlurm,
  /// SlurmRefusal, SlurmError, output::FileError.
  bool run(std::size_t count, const Request& request, const Done& done,
           const std::atomic<bool>& stop) override;

 private:
  struct Task {
    JournalReader journal;
    std::set<std::string> missing;  ///< identities
    int submitted = 0;              ///< how often
    int unseen = 0;                 ///< how often, one after the other, the queue did not have it
  };
  /// A folder of lists and the jobs that were submitted for it.
  struct Job {
    std::filesystem::path folder;
    std::vector<std::string> numbers;  ///< of Slurm, the newest last
    std::vector<Task> tasks;
  };

  std::vector<std::filesystem::path> earlier_folders() const;
  void give_up_earlier();
  void take_up_earlier(const Done& done);
  void make_job(const Request& request);
  /// False when it was interrupted before Slurm answered. Throws NoSlurm, SlurmRefusal.
  bool submit(Job& job, const std::string& array);
  void read_journals(Job& job, const Done& done);
  /// Looks after the tasks that ended without their runs; throws for those that failed twice.
  void look_after(Job& job);
  std::optional<std::set<std::size_t>> queued_tasks(const Job& job);
  void hand_on(const std::pair<std::string, RunRecord>& entry, const Done& done);

  Options options_;
  /// Identities that are not there yet, and whose they are.
  std::map<std::string, std::vector<std::size_t>> wanted_;
  std::vector<Job> jobs_;
  bool controller_silent_ = false;
  const std::atomic<bool>* stop_ = nullptr;  ///< of `run`
};

}  // namespace hookpoint::studies
