#include "apps/python/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace hookpoint::python {

double allocated_memory() {
#if defined(__GLIBC__)
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
#else
  return 0.;
#endif
}

std::optional<double> free_memory() {
  std::optional<double> least;
  const auto take = [&](double bytes) { least = std::min(least.value_or(bytes), bytes); };
  std::ifstream machine("/proc/meminfo");
  for (std::string name, unit; machine >> name;) {
    double kilobytes = 0.;
    if (!(machine >> kilobytes)) break;
    if (name == "MemAvailable:") take(1024. * kilobytes);
    std::getline(machine, unit);
  }
  rlimit limit{};
  double pages = 0.;
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      std::ifstream("/proc/self/statm") >> pages)
    take(std::max(0., static_cast<double>(limit.rlim_cur) -
                          pages * static_cast<double>(sysconf(_SC_PAGESIZE))));
  return least;
}

}  // namespace hookpoint::python
