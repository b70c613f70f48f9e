// Standard output as a file like others: what it did not take is an error.
#pragma once

namespace hookpoint::cli {

/// Before anything is opened or printed: a stream that is closed stays so, whatever file comes
/// next, and a reader that goes away ends no run.
void take_standard_streams();

/// After everything was printed: the exit status, `status` unless standard output could not be
/// written. Where its reader has gone away the process ends as if by SIGPIPE, without a word.
int finish_standard_output(int status);

}  // namespace hookpoint::cli
