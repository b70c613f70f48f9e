// What the exit status means, the same for every command (docs/command_line.md).
#pragma once

namespace hookpoint::cli {

enum ExitStatus : int {
  fine = 0,
  truth_failed = 1,  ///< a Truth failed, a run diverged, files differ, or a study's results could
                     ///< not be kept
  wrong_input = 2,   ///< what the user wrote cannot be read or run
  missing = 3,       ///< something is not on this machine
  // After a signal 128 and its number: 130 the interrupt key, 143 SIGTERM (InterruptGuard::status).
};

struct ExitMeaning {
  int status;
  const char* meaning;
};

/// For users.
inline constexpr ExitMeaning exit_meanings[] = {
    {fine, "fine"},
    {truth_failed, "a truth failed, a run diverged, files differ, or results could not be kept"},
    {wrong_input, "wrong input"},
    {missing, "something is missing on this machine"},
    {130, "interrupted (143 by SIGTERM, 129 by SIGHUP)"},
};

}  // namespace hookpoint::cli
