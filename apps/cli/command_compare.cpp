#include <unistd.h>

#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "studies/compare/comparison.h"
#include "text/terminal.h"

namespace hookpoint::cli {

int compare(const CompareArguments& arguments) {
  try {
    const auto first = studies::read_run_folder(arguments.first);
    const auto second = studies::read_run_folder(arguments.second);
    const auto comparison = studies::compare_runs(first, second, arguments.tolerance);
    std::cout << (arguments.json
                      ? studies::comparison_json(comparison)
                      : studies::comparison_text(comparison, {text::wants_colours(STDOUT_FILENO)}));
    return comparison.same() ? fine : truth_failed;
  } catch (const studies::RunFolderError& error) {
    application::print_error(error.what());
    return wrong_input;
  }
}

}  // namespace hookpoint::cli
