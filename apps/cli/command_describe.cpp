#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/described.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"

namespace hookpoint::cli {
namespace {

/// False after any is not loaded; which and why is printed.
bool load_plugins(application::Application& application,
                  const std::vector<std::filesystem::path>& plugins) {
  bool good = true;
  for (const std::filesystem::path& plugin : plugins) {
    const std::string problem = application.load_plugin(plugin);
    if (problem.empty()) continue;
    application::print_error("the plugin `" + plugin.string() + "` " + problem);
    good = false;
  }
  return good;
}

}  // namespace

int describe(const DescribeArguments& arguments) {
  application::Application application(arguments.consent);
  if (!load_plugins(application, arguments.plugins)) return wrong_input;
  const std::optional<std::string>& type = arguments.type;
  if (!type) {
    if (arguments.textmate) {
      std::cout << language::describe_textmate(application.schema());
      return fine;
    }
    std::cout << (arguments.markdown ? language::describe_markdown(application.schema())
                                     : language::describe_all(application.schema()));
    return fine;
  }
  std::string problem;
  const std::vector<std::string> texts = described(application, *type, problem);
  if (texts.empty()) {
    application::print_error(problem);
    return wrong_input;
  }
  for (const std::string& text : texts) std::cout << (&text == &texts.front() ? "" : "\n") << text;
  return fine;
}

}  // namespace hookpoint::cli
