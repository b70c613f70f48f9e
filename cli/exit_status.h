// What the exit status means, the same for every command (docs/command_line.md).
#pragma once

namespace hookpoint::cli {

enum ExitStatus : int {
  fine = 0,
  truth_failed = 1,  ///< a Truth failed or a run diverged
  wrong_input = 2,   ///< what the user wrote cannot be read or run
  missing = 3,       ///< something is not on this machine
};

}  // namespace hookpoint::cli
