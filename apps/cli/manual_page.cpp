#include "apps/cli/manual_page.h"

#include <algorithm>

#include "apps/cli/exit_status.h"
#include "language/names.h"

namespace hookpoint::cli {
namespace {

struct Variable {
  const char *name, *doc;
};

constexpr Variable variables[] = {
    {"HOOKPOINT_PATH", "folders, joined by `:`, in which files that are included are looked up"},
    {"HOOKPOINT_TRUSTED_PLUGINS",
     "folders, joined by `:`, whose plugins may run without --allow-plugins"},
    {"HOOKPOINT_TRUSTED_ENGINES",
     "folders, joined by `:`, whose engines may be started without --allow-engines"},
    {"NO_COLOR", "when set and not empty, no colours even on a terminal"},
};

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option*) { return true; });
}

/// "-V", "--version".
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// Text that troff prints as it stands.
std::string troff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n')) {
      escaped += std::string("\\&") + c;
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + troff(text) + "\\fR"; }
std::string slanted(const std::string& text) { return "\\fI" + troff(text) + "\\fR"; }

/// `name`: with that of the command that it is a part of.
std::string heading(const CLI::App& command, const std::string& name) {
  std::string text = ".SS " + troff(name);
  for (const CLI::Option* option : options_of(command)) {
    if (!option->get_positional()) continue;
    const std::string word = option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
    text += " " + troff(option->get_required() ? word : "[" + word + "]");
  }
  return text + " [OPTIONS]\n" + troff(command.get_description()) + ".\n";
}

std::string entry(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : names_of(option)) names.push_back(bold(name));
  if (option.get_positional()) names.push_back(slanted(option.get_name(true)));
  std::string text = ".TP\n" + language::join(names, ", ");
  if (!option.get_positional() && takes_value(option))
    text += " " + slanted(option.get_type_name());
  return text + "\n" + troff(option.get_description()) + "\n";
}

/// The command, then its parts.
std::string section(const CLI::App& command, const std::string& name) {
  std::string text = heading(command, name);
  for (const CLI::Option* option : options_of(command)) text += entry(*option);
  for (const CLI::App* part : commands_of(command))
    text += section(*part, name + " " + part->get_name());
  return text;
}

/// What bash offers after an option, as a command that prints it; "" for nothing.
std::string offer(const CLI::Option& option,
                  const std::map<std::string, std::vector<std::string>>& words) {
  const std::vector<std::string> names = names_of(option);
  if (const auto found = words.find(names.back()); found != words.end())
    return "compgen -W '" + language::join(found->second, " ") + "'";
  const std::string type = option.get_type_name();
  if (type == "DIR") return "compgen -d";
  if (type == "SHELL") return "compgen -W bash";
  if (type.find("FILE") != std::string::npos || type == "MOVIE" || type == "LIBRARY")
    return "compgen -f";
  return "";
}

}  // namespace

std::string manual_page(const CLI::App& app, const std::string& version) {
  const std::string about = app.get_description();
  const std::size_t line = about.find('\n');
  std::string text =
      ".\\\" Made by `hookpoint describe --man`.\n.TH HOOKPOINT 1 \"\" \"hookpoint " + version +
      "\" \"User Commands\"\n.SH NAME\nhookpoint \\- " +
      troff(about.substr(about.find(": ") + 2, line - about.find(": ") - 2)) + "\n.SH SYNOPSIS\n" +
      bold("hookpoint") + " " + slanted("FILE.hook") + " [" + slanted("OPTIONS") + "]\n.br\n" +
      bold("hookpoint") + " " + slanted("COMMAND") + " [" + slanted("OPTIONS") +
      "]\n.SH DESCRIPTION\n" + troff(about.substr(line + 1)) + "\n.SH OPTIONS\n";
  for (const CLI::Option* option : options_of(app)) text += entry(*option);
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) text += section(*command, command->get_name());
  text += ".SH EXIT STATUS\n";
  for (const ExitMeaning& exit : exit_meanings)
    text += ".TP\n" + bold(std::to_string(exit.status)) + "\n" + troff(exit.meaning) + "\n";
  text += ".SH ENVIRONMENT\n";
  for (const Variable& variable : variables)
    text += ".TP\n" + bold(variable.name) + "\n" + troff(variable.doc) + "\n";
  return text;
}

std::string bash_completion(const CLI::App& app,
                            const std::map<std::string, std::vector<std::string>>& words) {
  std::string text =
      "# Made by `hookpoint describe --completion bash`.\n"
      "_hookpoint() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  local command=${COMP_WORDS[1]} options= parts=\n"
      "  if [ \"$COMP_CWORD\" = 1 ]; then command=; fi\n"
      "  case \"$command:$before\" in\n";
  std::vector<std::string> commands;
  std::string options = "  case $command in\n";
  const auto add = [&](const std::vector<const CLI::Option*>& possible, const std::string& name,
                       const std::vector<std::string>& parts = {}) {
    std::vector<std::string> all;
    for (const CLI::Option* option : possible) {
      const std::vector<std::string> names = names_of(*option);
      if (!names.empty() && std::ranges::find(all, names.back()) != all.end()) continue;
      all.insert(all.end(), names.begin(), names.end());
      if (names.empty() || !takes_value(*option)) continue;
      const std::string offered = offer(*option, words);
      text += "    " + name + ":" + names.back() + ") mapfile -t COMPREPLY < <(" +
              (offered.empty() ? ":" : offered + " -- \"$word\"") + "); return ;;\n";
    }
    options += "    " + (name.empty() ? "''" : name) + ") options='" + language::join(all, " ") +
               "'" + (parts.empty() ? "" : " parts='" + language::join(parts, " ") + "'") + " ;;\n";
  };
  for (const CLI::App* command : commands_of(app)) {
    commands.push_back(command->get_name());
    std::vector<const CLI::Option*> possible = options_of(*command);
    std::vector<std::string> parts;
    for (const CLI::App* part : commands_of(*command)) {
      parts.push_back(part->get_name());
      const auto of_part = options_of(*part);
      possible.insert(possible.end(), of_part.begin(), of_part.end());
    }
    add(possible, command->get_name(), parts);
  }
  add(options_of(app), "");
  // The first word is a command or a file; FILE.hook takes what `run` and `study` take.
  std::vector<const CLI::Option*> of_file = options_of(*app.get_subcommand("run"));
  const auto of_study = options_of(*app.get_subcommand("study"));
  of_file.insert(of_file.end(), of_study.begin(), of_study.end());
  add(of_file, "*.hook");
  text += "  esac\n" + options +
          "    *) options='--help' ;;\n  esac\n"
          "  if [ -z \"$command\" ]; then options=\"$options " +
          language::join(commands, " ") +
          "\"; fi\n"
          "  case $word in\n"
          "    -*) mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\") ;;\n"
          "    *) mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
          "       if [ -n \"$parts\" ]; then\n"
          "         mapfile -t -O \"${#COMPREPLY[@]}\" COMPREPLY < <(compgen -W \"$parts\" -- "
          "\"$word\")\n"
          "       fi\n"
          "       if [ -z \"$command\" ]; then\n"
          "         mapfile -t -O \"${#COMPREPLY[@]}\" COMPREPLY < <(compgen -W \"$options\" -- "
          "\"$word\")\n"
          "       fi ;;\n"
          "  esac\n"
          "}\n"
          "complete -o filenames -F _hookpoint hookpoint\n";
  return text;
}

}  // namespace hookpoint::cli
