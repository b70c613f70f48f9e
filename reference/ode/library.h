// What of ODE belongs to the process and not to a world, made safe for worlds in several threads.
#pragma once

#include <ode/ode.h>

#include <array>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "math/vector3.h"

namespace hookpoint::reference {

inline Vector3d vector(const dReal* a) { return {a[0], a[1], a[2]}; }

struct OdeDeleter {
  void operator()(dxWorld* world) const { dWorldDestroy(world); }
  void operator()(dxGeom* geom) const { dGeomDestroy(geom); }
  void operator()(dxJointGroup* group) const { dJointGroupDestroy(group); }
  void operator()(dxTriMeshData* mesh) const { dGeomTriMeshDataDestroy(mesh); }
  void operator()(dxThreadingImplementation* threading) const {
    dThreadingFreeImplementation(threading);
  }
};
template <class Object>
using OdePointer = std::unique_ptr<Object, OdeDeleter>;

/// An internal check of ODE that failed, such as a quaternion that is not finite. Left to itself
/// the library ends the process there. The world that was being stepped can only be destroyed
/// (abandon_ode_threading first).
struct OdeFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What the library had to say while this lived, in its own thread, instead of printing it. One at
/// a time in a thread.
class OdeMessages {
 public:
  OdeMessages();
  ~OdeMessages();
  OdeMessages(const OdeMessages&) = delete;
  OdeMessages& operator=(const OdeMessages&) = delete;

  int count() const { return count_; }
  /// The first message, without a line's end; empty while there is none.
  const char* first() const { return first_.data(); }
  void add(const char* text);

 private:
  int count_ = 0;
  std::array<char, 256> first_{};
};

/// Keeps the threading object of a world whose step failed until the process ends: its list of jobs
/// is not empty, and its destructor would insist. Lost with it: about 300 bytes a failed run. The
/// world itself may be destroyed.
void abandon_ode_threading(OdePointer<dxThreadingImplementation> threading);

/// Initialises the library once a process, and its data once a thread. Call before any other of its
/// functions, in every thread that uses one.
void prepare_ode_for_this_thread();

/// Held while triangle meshes are collided: Debian's library is built without thread-local storage
/// (dCheckConfiguration has no ODE_EXT_mt_collisions), so all meshes share one set of buffers.
std::mutex& ode_mesh_mutex();

/// One world's random stream. QuickStep shuffles its rows by dRandInt, whose seed is one variable
/// of the process: another thread's world would draw from the same stream and both results would
/// depend on timing. While a Turn lives the stream is this world's alone, and what it drew is kept
/// for the world's next step.
class OdeRandomStream {
 public:
  explicit OdeRandomStream(unsigned long seed) : seed_(seed) {}

  class Turn {
   public:
    explicit Turn(OdeRandomStream& stream);
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    OdeRandomStream& stream_;
    std::lock_guard<std::mutex> lock_;
  };

 private:
  unsigned long seed_;
};

}  // namespace hookpoint::reference
