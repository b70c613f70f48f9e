#include "reference/library_abort.h"

#include <csetjmp>
#include <csignal>

namespace hookpoint::reference {
namespace {

/// Where an abort() of this thread goes; null: where it went before.
thread_local sigjmp_buf* refuge = nullptr;
struct sigaction former {};

extern "C" void leave_abort(int) {
  if (refuge != nullptr) siglongjmp(*refuge, 1);
  sigaction(SIGABRT, &former, nullptr);
  raise(SIGABRT);
}

void watch_for_abort() {
  static const bool watching = [] {
    struct sigaction action {};
    action.sa_handler = leave_abort;
    // Not blocked while it is handled, so that no jump has to restore the mask.
    action.sa_flags = SA_NODEFER;
    return sigaction(SIGABRT, &action, &former) == 0;
  }();
  static_cast<void>(watching);
}

/// Sets the thread's refuge for as long as it lives.
class Refuge {
 public:
  explicit Refuge(sigjmp_buf& here) : outer_(refuge) { refuge = &here; }
  ~Refuge() { refuge = outer_; }
  Refuge(const Refuge&) = delete;
  Refuge& operator=(const Refuge&) = delete;

 private:
  sigjmp_buf* outer_;
};

}  // namespace

bool survives_abort(void (*work)(void* data), void* data) {
  watch_for_abort();
  sigjmp_buf here;
  const Refuge set(here);
  if (sigsetjmp(here, 0) != 0) return false;
  work(data);
  return true;
}

}  // namespace hookpoint::reference
