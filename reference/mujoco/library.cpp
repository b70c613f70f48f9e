#include "reference/mujoco/library.h"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <new>
#include <string>

namespace hookpoint::reference {
namespace {

/// MuJoCo ends the process if this returns, so it does not. Its frames hold nothing that an
/// exception would leak: its scratch memory belongs to mjData.
[[noreturn]] void report(const char* message) { throw MujocoFailure(message); }

/// Warnings are counted in mjData too, and are read from there (world.cpp, notice()). Left to
/// itself the library prints them and writes MUJOCO_LOG.TXT into the current folder.
void ignore(const char*) {}

/// What MuJoCo aligns its memory to [bytes].
constexpr std::size_t alignment = 64;

/// The library's own aligned_alloc cuts up what glibc 2.36 has freed: a world leaves 2 MB behind
/// that no later one fits into, a thousand worlds 2 GB. Here plain malloc's block begins before the
/// memory that is handed out, and stands just ahead of it. Throws std::bad_alloc, as `report` may:
/// not every place in the library checks for null.
void* allocate(std::size_t bytes) {
  void* const block = std::malloc(bytes + alignment);
  if (block == nullptr) throw std::bad_alloc();
  void* memory = static_cast<char*>(block) + sizeof(block);
  std::size_t room = bytes + alignment - sizeof(block);
  std::align(alignment, bytes, memory, room);
  std::memcpy(static_cast<char*>(memory) - sizeof(block), &block, sizeof(block));
  return memory;
}

void release(void* memory) {
  void* block = nullptr;
  std::memcpy(&block, static_cast<char*>(memory) - sizeof(block), sizeof(block));
  std::free(block);
}

void prepare_mujoco() {
  static const bool prepared = [] {
    mju_user_malloc = allocate;
    mju_user_free = release;
    mju_user_error = report;
    mju_user_warning = ignore;
    return true;
  }();
  static_cast<void>(prepared);
}

}  // namespace

MujocoPointer<mjModel> compile_mujoco(const std::string& mjcf) {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  prepare_mujoco();
  constexpr const char* name = "model.xml";
  const auto files = std::make_unique<mjVFS>();  // 2 MB
  mj_defaultVFS(files.get());
  if (mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(mjcf.size())) != 0)
    throw MujocoFailure("MuJoCo takes no model of " + std::to_string(mjcf.size()) + " bytes");
  std::memcpy(files->filedata[0], mjcf.data(), mjcf.size());
  std::array<char, 1000> message{};
  MujocoPointer<mjModel> model(
      mj_loadXML(name, files.get(), message.data(), static_cast<int>(message.size())));
  mj_deleteVFS(files.get());
  mj_freeLastXML();
  if (!model) throw MujocoFailure(message.data());
  return model;
}

MujocoPointer<mjData> make_mujoco_data(const mjModel& model) {
  MujocoPointer<mjData> data(mj_makeData(&model));
  if (!data) throw std::bad_alloc();
  return data;
}

}  // namespace hookpoint::reference
