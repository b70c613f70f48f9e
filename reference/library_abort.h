// A library that ends the process where one of its assertions fails, made to end a run instead.
#pragma once

namespace hookpoint::reference {

/// Calls `work(data)`; false where it called abort() in this thread, as a failed assertion does
/// after its message. C allows a handler of SIGABRT that does not return. The frames of `work` are
/// then left without their destructors: what these held is lost, and what they were changing can
/// only be kept until the process ends.
bool survives_abort(void (*work)(void* data), void* data);

template <class Work>
bool survives_abort(Work work) {
  return survives_abort([](void* data) { (*static_cast<Work*>(data))(); }, &work);
}

}  // namespace hookpoint::reference
