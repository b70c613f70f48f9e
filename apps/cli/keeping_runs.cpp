#include "apps/cli/keeping_runs.h"

#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "output/files/file.h"
#include "studies/run/run_store.h"

namespace hookpoint::cli {

int keeping_runs(const std::function<int()>& work) {
  try {
    return work();
  } catch (const output::PlaceError&) {
    throw;
  } catch (const output::FileError& error) {
    application::print_error(error.what());
  } catch (const studies::StoreError& error) {
    application::print_error(error.what());
  }
  return truth_failed;
}

}  // namespace hookpoint::cli
