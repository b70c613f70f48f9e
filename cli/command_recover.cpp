#include <fmt/format.h>

#include "application/application.h"
#include "cli/commands.h"
#include "cli/exit_status.h"
#include "output/records/spool.h"

namespace hookpoint::cli {

int recover(const std::filesystem::path& spool) {
  try {
    const output::SpoolReader whole(spool);
  } catch (const output::FileError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
  const output::RecoveredRecord record = output::recover_spool(spool);
  fmt::print("{}: {} rows\n", record.path.string(), record.rows);
  return fine;
}

}  // namespace hookpoint::cli
