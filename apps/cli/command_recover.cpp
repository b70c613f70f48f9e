#include <fmt/format.h>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
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
