#include <fmt/format.h>

#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "language/syntax/token.h"
#include "output/files/file.h"
#include "text/display.h"

namespace hookpoint::cli {
namespace {

/// Stands in a starter where the name belongs.
constexpr std::string_view placeholder = "starter";

std::string named(std::string text, const std::string& name) {
  for (std::size_t at = text.find(placeholder); at != std::string::npos;
       at = text.find(placeholder, at + name.size()))
    text.replace(at, placeholder.size(), name);
  return text;
}

}  // namespace

int new_file(const NewArguments& arguments) {
  if (!language::is_object_name(arguments.name)) {
    application::print_error(
        "`" + text::printable(arguments.name) +
        "` is no name: letters, digits and _, the first no digit, and no word of the language");
    return wrong_input;
  }
  application::Application application;
  const auto starter = output::read_file(application.find("starters/" + arguments.kind + ".hook"));
  if (!starter) {
    application::print_error("there is no starters/" + arguments.kind +
                             ".hook in the folder of configs");
    return missing;
  }
  const std::filesystem::path file = arguments.name + ".hook";
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored))) {
    application::print_error(file.string() + " is there already; take another name");
    return wrong_input;
  }
  const std::string text = named(*starter, arguments.name);
  application.give(file, text);
  if (application.evaluate(file, {}) == nullptr) {
    application.give("starter.hook", *starter);
    const bool is_the_name = application.evaluate("starter.hook", {}) != nullptr;
    application::print_error(
        is_the_name ? "`" + arguments.name + "` has another meaning in it; take another name"
                    : "a file that starters/" + arguments.kind + ".hook includes is wrong here");
    return wrong_input;
  }
  output::write_file(file, text);
  std::cout << fmt::format("wrote {0}\n  hookpoint {1} {0}\n", file.string(),
                           arguments.kind == "study" ? "study" : "view");
  return fine;
}

}  // namespace hookpoint::cli
