// What of MuJoCo belongs to the process: its error handlers, its compiler of models, and owners of
// its objects.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace hookpoint::reference {

struct MujocoDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
template <class Object>
using MujocoPointer = std::unique_ptr<Object, MujocoDeleter>;

/// An error of MuJoCo's, such as memory that it lacks or a model that its compiler refuses. Left to
/// itself the library ends the process. Data that were being stepped can only be destroyed.
struct MujocoFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Compiles `mjcf`, a model in MuJoCo's language, without touching a file. Throws MujocoFailure
/// with the compiler's message. One compilation at a time in a process: the library keeps the last
/// one.
MujocoPointer<mjModel> compile_mujoco(const std::string& mjcf);

/// Data of `model` at its reference pose. Throws MujocoFailure.
MujocoPointer<mjData> make_mujoco_data(const mjModel& model);

}  // namespace hookpoint::reference
