// A record that has everything a writer may stumble over, and the means of cutting it off.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <string>
#include <vector>

#include "output/records/recorder.h"

namespace hookpoint::testing {

inline output::RecordHeader awkward_header() {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  output::RecordHeader header;
  header.name = "awkward";
  header.period = 1e-3;
  header.experiment = "World w {\n\tdeltat = 1 ms; // \"quoted\", back\\slash\n}\n";
  header.annotations = {{"engine", "dts"}, {"seed", "42"}, {"note", ""}};
  header.channels = {
      {"bot.leg[0].femur.angle", "rad", "double", -1.5, 1.5, "joint angle, counter-clockwise"},
      {"bot.leg[0].tibia.contact.force.z", "N", "double", 0.,
       std::numeric_limits<double>::infinity(), "normal force"},
      {"bot.leg[0].tibia.contact.touching", "", "bool", 0., 1., "whether a point is in the ground"},
      {"bot.contacts", "", "int", 0., 6., "points in the ground"},
      {"end", "kg.m^2/s", "double", unknown, unknown, ""},
      {"bot.body_with_a_name_that_is_longer_than_what_matlab_takes_for_a_variable.angle", "rad",
       "double", -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
       "first"},
      {"bot.body_with_a_name_that_is_longer_than_what_matlab_takes_for_a_variable_angle", "rad",
       "double", -1e300, 1e-300, "second"}};
  return header;
}

/// Row k of the record: numbers of 17 digits, of either sign, tiny, huge, negative zero.
inline std::vector<double> awkward_row(int k) {
  const double noise = std::sin(0.1 * k) / 3.;
  return {noise,
          k % 7 == 0 ? std::numeric_limits<double>::denorm_min() : 1e22 * noise,
          static_cast<double>(k % 2),
          static_cast<double>(k % 7),
          k % 5 == 0 ? std::numeric_limits<double>::quiet_NaN() : -noise * 1e-300,
          k % 3 == 0 ? -0. : 0.1 * k,
          k % 11 == 0 ? -std::numeric_limits<double>::infinity() : 1.7976931348623157e308};
}

inline double awkward_time(int k) { return k * 1e-3; }

inline void write_awkward_rows(output::RecordWriter& writer, int begin, int end) {
  for (int k = begin; k < end; ++k) writer.row(awkward_time(k), awkward_row(k));
}

/// No file grows beyond `bytes` while this lives: what a full disk looks like to the program
/// (EFBIG for ENOSPC).
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limited{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, before_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*before_)(int);
  rlimit old_{};
};

/// Runs `work` in a process of its own that then dies as if by SIGKILL: no destructor, no atexit.
template <class Work>
void run_and_die(Work&& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
}

}  // namespace hookpoint::testing
