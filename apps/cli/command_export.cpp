#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/exported.h"
#include "output/files/file.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::cli {

int export_model(const ExportArguments& arguments) {
  application::Application application(arguments.request.consent);
  try {
    const auto model = application::exported(application, arguments.request);
    if (!model) return wrong_input;
    if (arguments.out.empty()) {
      std::cout << model->text;
    } else {
      output::write_file(arguments.out, model->text);
    }
    if (!model->left_out.empty())
      std::cerr << fmt::format("hookpoint: note: left out: {}\n", fmt::join(model->left_out, "; "));
    return fine;
  } catch (const translation::ParameterError& error) {
    application::print_error(error.what());
  } catch (const simulation::ExperimentError& error) {
    application::print_error(error.what());
  }
  return wrong_input;
}

}  // namespace hookpoint::cli
