// The processes of one engine that is a program, reused from run to run.
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
  /// An idle process, or a new one. Throws ProgramError.
  std::unique_ptr<Program> take();
  /// Returns a process whose run has ended without an error of the program's.
  void give_back(std::unique_ptr<Program> program);

 private:
  simulation::EngineDescription describe_by_hello();

  const ProgramDefinition definition_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Program>> idle_;
  std::optional<simulation::EngineDescription> description_;
};

}  // namespace hookpoint::reference
