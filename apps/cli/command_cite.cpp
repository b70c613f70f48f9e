#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <set>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "output/files/csv.h"
#include "output/files/file.h"
#include "output/files/result_folder.h"
#include "text/display.h"

namespace hookpoint::cli {
namespace {

/// "@article{...}" of the bibliography, each by itself.
std::vector<std::string> entries_of(const std::string& bibliography) {
  std::vector<std::string> entries;
  for (std::size_t at = bibliography.find("\n@"); at != std::string::npos;) {
    const std::size_t next = bibliography.find("\n@", at + 1);
    const std::size_t length = next == std::string::npos ? next : next - at - 1;
    entries.push_back(bibliography.substr(at + 1, length));
    at = next;
  }
  return entries;
}

/// "engine ode, engine ode_quickstep" of its line `keywords = {...}`.
std::set<std::string> keywords_of(const std::string& entry) {
  const std::string key = "keywords = {";
  const std::size_t begin = entry.find(key) + key.size();
  std::string list = entry.substr(begin, entry.find('}', begin) - begin);
  std::set<std::string> words;
  for (std::size_t end = 0; !list.empty(); list.erase(0, end)) {
    list.erase(0, list.find_first_not_of(", "));
    end = std::min(list.find(','), list.size());
    words.insert(list.substr(0, end));
  }
  return words;
}

std::string without_keywords(std::string entry) {
  const std::size_t line = entry.find(",\n  keywords");
  return entry.replace(line, entry.find('\n', line + 2) - line, "");
}

void replace(std::string& text, const std::string& word, const std::string& with) {
  const std::size_t at = text.find(word);
  if (at != std::string::npos) text.replace(at, word.size(), with);
}

/// The engines and laws of the rows of a table of results, "engine ode", "law lugre".
void add_rows(std::set<std::string>& used, const std::filesystem::path& file) {
  const std::optional<std::string> text = output::read_file(file);
  const auto table = text ? output::parse_csv(*text) : std::nullopt;
  if (!table) return;
  for (std::size_t column = 0; column < table->header.size(); ++column) {
    const std::string& title = table->header[column];
    if (title != "engine" && title != "law") continue;
    for (const std::vector<std::string>& row : table->rows)
      if (!row[column].empty()) used.insert(title + " " + row[column]);
  }
}

/// What the results of a folder were made with, those of the folders in it too.
std::set<std::string> used_in(const std::filesystem::path& folder,
                              const output::Manifest& manifest) {
  std::set<std::string> used{"always"};
  for (const auto& [what, value] : manifest.about)
    if (what == "engine") used.insert("engine " + value.substr(0, value.find(' ')));
  add_rows(used, folder / "results.csv");
  std::error_code ignored;
  for (const auto& part : std::filesystem::directory_iterator(folder, ignored))
    add_rows(used, part.path() / "results.csv");
  return used;
}

}  // namespace

int cite(const std::optional<std::filesystem::path>& folder) {
  application::Application application;
  const auto bibliography = output::read_file(application.find("citations.bib"));
  if (!bibliography) {
    application::print_error("there is no citations.bib in the folder of configs");
    return missing;
  }
  std::set<std::string> used{"always"};
  std::string note;
  if (folder) {
    const std::optional<output::Manifest> manifest = output::read_manifest(*folder);
    if (!manifest) {
      application::print_error(text::printable(folder->string()) +
                               " holds no results: `run --out`, `study` and `tune` leave folders "
                               "that can be cited");
      return wrong_input;
    }
    used = used_in(*folder, *manifest);
    note = "experiment " + manifest->experiment;
  }
  std::string text;
  for (std::string entry : entries_of(*bibliography)) {
    const std::set<std::string> words = keywords_of(entry);
    if (std::ranges::none_of(words, [&](const std::string& word) { return used.contains(word); }))
      continue;
    entry = without_keywords(std::move(entry));
    replace(entry, "VERSION", HOOKPOINT_VERSION);
    if (note.empty()) replace(entry, ",\n  note = {NOTE}", "");
    replace(entry, "NOTE", note);
    text += (text.empty() ? "" : "\n") + entry.substr(0, entry.find_last_of('}') + 1) + "\n";
  }
  std::cout << text;
  return fine;
}

}  // namespace hookpoint::cli
