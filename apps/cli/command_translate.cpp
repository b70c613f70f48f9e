#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/translated.h"
#include "simulation/engine_interface/engine.h"

namespace hookpoint::cli {

int translate(TranslateArguments arguments) {
  if (arguments.parameters) {
    std::cout << translation::parameters_page();
    return fine;
  }
  application::TranslateRequest& request = arguments.request;
  try {
    // With --from all words are the engine's parameters.
    if (request.from.empty()) {
      if (request.given.size() != 1)
        throw translation::ParameterError(
            "name one file or material, or --from an engine (`hookpoint translate --help`)");
      request.file = std::move(request.given.front());
      request.given.clear();
    }
    request.consent = arguments.consent;
    application::Application application(arguments.consent);
    const auto answers = application::translated(application, request);
    if (!answers) return wrong_input;
    std::cout << (arguments.json ? translation::json_of(*answers) : translation::text_of(*answers));
    return fine;
  } catch (const translation::ParameterError& error) {
    application::print_error(error.what());
  } catch (const simulation::ExperimentError& error) {
    application::print_error(error.what());
  }
  return wrong_input;
}

}  // namespace hookpoint::cli
