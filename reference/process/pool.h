// The processes of one engine that is a program: those which have no run at the moment wait here.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "reference/process/program.h"

namespace hookpoint::reference {

class ProgramPool {
 public:
  explicit ProgramPool(ProgramDefinition definition) : definition_(std::move(definition)) {}

  const ProgramDefinition& definition() const { return definition_; }
  simulation::EngineDescription describe();
  /// One that waits, or a new one. Throws ProgramError.
  std::unique_ptr<Program> take();
  /// Of a run that has ended without a fault of the program's.
  void give_back(std::unique_ptr<Program> program);

 private:
  simulation::EngineDescription ask();

  const ProgramDefinition definition_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Program>> waiting_;
  std::optional<simulation::EngineDescription> description_;
};

}  // namespace hookpoint::reference
