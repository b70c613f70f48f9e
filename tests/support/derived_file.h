// Files of the project that are made from others: the manual's reference page, expected messages.
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/text.h"

namespace hookpoint::testing {

/// "" where `file` holds the text `made`; otherwise the first line that differs, and the command that
/// writes it: scripts/renew NAME, which sets HOOKPOINT_RENEW. Then the text is written instead.
inline std::string stale(const std::string& name, const std::filesystem::path& file,
                         const std::string& made) {
  if (std::getenv("HOOKPOINT_RENEW") != nullptr) std::ofstream(file, std::ios::binary) << made;
  const std::string held = read_file(file);
  if (made == held) return "";
  std::istringstream made_lines(made), held_lines(held);
  std::string made_line, held_line;
  int number = 0;
  bool more = true;
  while (more && made_line == held_line) {
    ++number;
    const bool of_made = static_cast<bool>(std::getline(made_lines, made_line));
    const bool of_held = static_cast<bool>(std::getline(held_lines, held_line));
    if (!of_made) made_line = "(no more lines)";
    if (!of_held) held_line = "(no more lines)";
    more = of_made && of_held;
  }
  return file.string() + ":" + std::to_string(number) + "\n  holds: " + held_line +
         "\n  made:  " + made_line + "\nrun scripts/renew " + name + ", read the diff, commit it\n";
}

}  // namespace hookpoint::testing
