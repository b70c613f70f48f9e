// A Slurm of one node in a folder of its own, for as long as it lives: own key, own sockets, no
// service of the machine's. Environment and configuration reach the programs that the test starts.
#pragma once

#include <netinet/in.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/text.h"

namespace hookpoint::testing {

class SlurmCluster {
 public:
  /// What is missing for one; nothing when it can be started.
  static std::optional<std::string> missing() {
    for (const char* program : {"/usr/sbin/munged", "/usr/sbin/slurmctld", "/usr/sbin/slurmd"})
      if (!std::filesystem::exists(program))
        return std::string(program) + " (packages slurm-wlm and munge)";
    if (geteuid() != 0) return "root, who starts a slurmd";
    return std::nullopt;
  }

  SlurmCluster() {
    std::string pattern = (std::filesystem::temp_directory_path() / "slurm-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    for (const char* name : {"spool", "state", "log"})
      std::filesystem::create_directory(folder_ / name);
    write_key();
    write_configuration();
    setenv("SLURM_CONF", path("slurm.conf").c_str(), 1);
    start({"/usr/sbin/munged", "--foreground", "--force", "--socket=" + path("munge.sock"),
           "--key-file=" + path("munge.key"), "--log-file=" + path("log/munged.log"),
           "--pid-file=" + path("munged.pid"), "--seed-file=" + path("munge.seed")});
    wait_for([this] { return std::filesystem::exists(folder_ / "munge.sock"); });
    start({"/usr/sbin/slurmctld", "-D", "-f", path("slurm.conf")});
    start({"/usr/sbin/slurmd", "-D", "-f", path("slurm.conf"), "-N", node()});
    ready_ = wait_for([] {
      return std::system("sinfo --noheader --format=%t 2>/dev/null | grep -qx idle") == 0;
    });
  }
  ~SlurmCluster() {
    // The daemons that were started last end first, and slurmd its tasks with it.
    [[maybe_unused]] const int ignored = std::system("scancel --full --user=root 2>/dev/null");
    for (auto process = processes_.rbegin(); process != processes_.rend(); ++process) {
      kill(*process, SIGTERM);
      for (int i = 0; i < 100 && waitpid(*process, nullptr, WNOHANG) == 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      kill(*process, SIGKILL);
      waitpid(*process, nullptr, WNOHANG);
    }
    unsetenv("SLURM_CONF");
    std::error_code ignored_error;
    std::filesystem::remove_all(folder_, ignored_error);
  }
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  bool ready() const { return ready_; }
  /// Jobs that are submitted wait, or may begin.
  bool hold() const { return set_partition("DOWN"); }
  bool release() const { return set_partition("UP"); }
  std::string log() const {
    return read_file(folder_ / "log/slurmctld.log") + read_file(folder_ / "log/slurmd.log");
  }

 private:
  bool set_partition(const std::string& state) const {
    return std::system(("scontrol update PartitionName=main State=" + state).c_str()) == 0;
  }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  static std::string node() {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    const std::string whole = name.data();
    return whole.substr(0, whole.find('.'));
  }
  /// A port that nobody listens at.
  static int free_port() {
    const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    bind(descriptor, reinterpret_cast<sockaddr*>(&address), size);
    getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size);
    close(descriptor);
    return ntohs(address.sin_port);
  }
  void write_key() const {
    std::random_device random;
    std::ofstream key(folder_ / "munge.key", std::ios::binary);
    for (int i = 0; i < 1024; ++i) key.put(static_cast<char>(random()));
    key.close();
    std::filesystem::permissions(folder_ / "munge.key", std::filesystem::perms::owner_read);
  }
  /// 22 of "slurm-wlm 22.05.8".
  static int major_version() {
    std::FILE* said = popen("/usr/sbin/slurmctld -V", "r");
    int major = 0;
    if (said == nullptr || std::fscanf(said, "%*s %d", &major) != 1) major = 0;
    if (said != nullptr) pclose(said);
    return major;
  }
  void write_configuration() const {
    // That of Debian 13, 24.11, does not start where there are no control groups, unless it needs none;
    // that of Debian 12, 22.05, does.
    if (major_version() > 22) std::ofstream(folder_ / "cgroup.conf") << "CgroupPlugin=disabled\n";
    std::ofstream(folder_ / "slurm.conf")
        << "ClusterName=test\nSlurmctldHost=" << node() << "(127.0.0.1)\n"
        << "SlurmUser=root\nSlurmdUser=root\nAuthType=auth/munge\nCredType=cred/munge\n"
        << "AuthInfo=socket=" << path("munge.sock") << "\nSlurmctldPort=" << free_port()
        << "\nSlurmdPort=" << free_port() << "\nSlurmctldPidFile=" << path("slurmctld.pid")
        << "\nSlurmdPidFile=" << path("slurmd.pid") << "\nSlurmdSpoolDir=" << path("spool")
        << "\nStateSaveLocation=" << path("state")
        << "\nSlurmctldLogFile=" << path("log/slurmctld.log")
        << "\nSlurmdLogFile=" << path("log/slurmd.log")
        << "\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\n"
        << "SelectType=select/cons_tres\nSelectTypeParameters=CR_CPU\nSwitchType=switch/none\n"
        << "MpiDefault=none\nReturnToService=2\nMinJobAge=2\n"
        << "SchedulerParameters=sched_interval=1,batch_sched_delay=0\n"
        << "JobAcctGatherType=jobacct_gather/none\n"
        << "AccountingStorageType=accounting_storage/none\n"
        << "NodeName=" << node() << " NodeAddr=127.0.0.1 CPUs=2 RealMemory=500 State=UNKNOWN\n"
        << "PartitionName=main Nodes=" << node() << " Default=YES MaxTime=INFINITE State=UP\n";
  }
  void start(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const std::string out = path("log/out");
    const pid_t process = fork();
    if (process == 0) {
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      freopen(out.c_str(), "a", stdout);
      dup2(STDOUT_FILENO, STDERR_FILENO);
      execv(arguments.front(), arguments.data());
      _exit(127);
    }
    processes_.push_back(process);
  }
  template <class Reached>
  static bool wait_for(const Reached& reached) {
    for (int i = 0; i < 3000; ++i) {
      if (reached()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
  }

  std::filesystem::path folder_;
  std::vector<pid_t> processes_;
  bool ready_ = false;
};

}  // namespace hookpoint::testing
