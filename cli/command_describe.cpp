#include <iostream>

#include "application/application.h"
#include "cli/commands.h"
#include "cli/exit_status.h"
#include "language/names.h"
#include "output/text/csv.h"
#include "studies/metric.h"

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
  application::Application application(arguments.allow_plugins);
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
  if (const language::ClassSchema* schema = application.schema().find(*type)) {
    std::cout << language::describe(*schema);
    return fine;
  }
  if (const studies::MetricDefinition* metric = studies::find_metric(*type)) {
    std::cout << output::column_title(std::string(metric->name), std::string(metric->unit))
              << "\n  " << metric->doc << '\n';
    return fine;
  }
  std::vector<std::string> names;
  for (const auto& [name, schema] : application.schema().classes()) names.push_back(name);
  for (const studies::MetricDefinition& metric : studies::metric_table())
    names.emplace_back(metric.name);
  const std::string nearest = language::nearest_name(*type, names);
  application::print_error("there is no class or metric `" + *type + "`" +
                           (nearest.empty() ? "; `hookpoint describe` lists the classes"
                                            : "; did you mean `" + nearest + "`?"));
  return wrong_input;
}

}  // namespace hookpoint::cli
