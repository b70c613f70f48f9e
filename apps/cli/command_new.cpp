#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "output/files/file.h"
#include "text/display.h"

namespace hookpoint::cli {
namespace {

/// Stands in a starter where the name belongs.
constexpr std::string_view placeholder = "starter";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
}

bool is_name(const std::string& word) {
  return !word.empty() && !is_digit(word[0]) && std::ranges::all_of(word, is_word_character);
}

std::string named(std::string text, const std::string& name) {
  for (std::size_t at = text.find(placeholder); at != std::string::npos;
       at = text.find(placeholder, at)) {
    const std::size_t end = at + placeholder.size();
    const bool whole = (at == 0 || !is_word_character(text[at - 1])) &&
                       (end == text.size() || !is_word_character(text[end]));
    if (whole) text.replace(at, placeholder.size(), name);
    at += whole ? name.size() : placeholder.size();
  }
  return text;
}

}  // namespace

int new_file(const NewArguments& arguments) {
  if (!is_name(arguments.name)) {
    application::print_error("`" + text::printable(arguments.name) +
                             "` is no name: letters, digits and _, the first no digit");
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
