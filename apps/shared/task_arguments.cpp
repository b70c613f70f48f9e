#include "apps/shared/task_arguments.h"

#include <algorithm>
#include <thread>

#include "apps/shared/short_forms.h"
#include "text/shell_word.h"

namespace hookpoint::application {

int TaskArguments::threads() const {
  return jobs > 0 ? jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

std::string rerun_command(const std::string& command, const TaskArguments& arguments) {
  std::string line = "hookpoint";
  const auto add = [&line](const std::string& option, const std::string& value) {
    line += option + " " + text::shell_word(value);
  };
  if (arguments.words.empty()) {
    add("", command);
    add("", arguments.file.string());
  }
  for (const std::string& word : arguments.words) add("", word);
  for (const std::string& setting : arguments.settings.trails) add(" --set", setting);
  for (const auto& [field, value] : arguments.settings.world)
    for (const ShortForm& form : short_forms)
      if (field == form.field) add(std::string(" ") + form.option, value);
  if (arguments.quick) line += " --quick";
  if (arguments.forms.latex) line += " --latex";
  if (arguments.forms.pdf) line += " --pdf";
  for (const std::string& subject : arguments.only) add(" --only", subject);
  for (const char* option : arguments.consent.options()) line += std::string(" ") + option;
  return arguments.slurm ? line + studies::option_words(arguments.slurm_settings) : line;
}

}  // namespace hookpoint::application
