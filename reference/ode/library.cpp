#include "reference/ode/library.h"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

namespace hookpoint::reference {
namespace {

std::mutex& random_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// ODE calls abort() if this returns, so it does not. The library's frames hold nothing that an
/// exception would leak but the step's scratch memory, which belongs to the world.
[[noreturn, gnu::format(printf, 2, 0)]] void report(int, const char* format, va_list arguments) {
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  throw OdeFailure(text.data());
}

thread_local OdeMessages* listener = nullptr;

/// ODE goes on after a message. Left to itself it prints it to standard error, in the midst of
/// whatever is there.
[[gnu::format(printf, 2, 0)]] void pass_on(int, const char* format, va_list arguments) {
  if (listener == nullptr) return;
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  listener->add(text.data());
}

/// ODE does not check what its allocations return.
void* allocate_for_ode(std::size_t bytes) {
  if (void* const memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}

void* reallocate_for_ode(void* memory, std::size_t, std::size_t bytes) {
  if (void* const larger = std::realloc(memory, bytes)) return larger;
  throw std::bad_alloc();
}

/// From the first use to the end of the process.
struct Library {
  Library() {
    dSetAllocHandler(allocate_for_ode);
    dSetReallocHandler(reallocate_for_ode);
    dInitODE2(0);
    dSetErrorHandler(report);
    dSetDebugHandler(report);
    dSetMessageHandler(pass_on);
  }
  ~Library() { dCloseODE(); }
};

}  // namespace

void prepare_ode_for_this_thread() {
  static const Library library;
  thread_local const int allocated = dAllocateODEDataForThread(dAllocateMaskAll);
  static_cast<void>(allocated);
}

OdeMessages::OdeMessages() { listener = this; }
OdeMessages::~OdeMessages() { listener = nullptr; }

void OdeMessages::add(const char* text) {
  if (count_++ == 0) std::snprintf(first_.data(), first_.size(), "%s", text);
}

void abandon_ode_threading(OdePointer<dxThreadingImplementation> threading) {
  static std::mutex mutex;
  static auto* const abandoned = new std::vector<OdePointer<dxThreadingImplementation>>;
  const std::lock_guard<std::mutex> lock(mutex);
  abandoned->push_back(std::move(threading));
}

std::mutex& ode_mesh_mutex() {
  static std::mutex mutex;
  return mutex;
}

OdeRandomStream::Turn::Turn(OdeRandomStream& stream) : stream_(stream), lock_(random_mutex()) {
  dRandSetSeed(stream_.seed_);
}

OdeRandomStream::Turn::~Turn() { stream_.seed_ = dRandGetSeed(); }

}  // namespace hookpoint::reference
