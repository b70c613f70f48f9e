// An engine that is a program, as an Engine block says it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hookpoint::reference {

struct ProgramDefinition {
  std::string name;                   ///< as in `engine = rapier`
  std::vector<std::string> command;   ///< the program and its arguments
  std::filesystem::path folder;       ///< working folder: that of the file with the block
  std::vector<std::string> settings;  ///< names that `settings =` accepts
  std::vector<std::string> files;     ///< in `folder`, beside the command's: part of a run's hash
  std::string install;                ///< what to do where the program does not start
  double deadline = 60.;              ///< for each answer [s]
  std::string refusal;                ///< why it may not be started; empty: it may
};

}  // namespace hookpoint::reference
