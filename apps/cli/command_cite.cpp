#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <set>

#include "apps/cli/commands.h"
#include "apps/cli/exit_status.h"
#include "apps/shared/application.h"
#include "language/names.h"
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

/// "a" and "b c" of "a, b c".
std::set<std::string> words_of(const std::string& list) {
  std::set<std::string> words;
  for (std::size_t at = list.find_first_not_of(", "); at != std::string::npos;) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    words.insert(list.substr(at, end - at));
    at = list.find_first_not_of(", ", end);
  }
  return words;
}

/// "engine ode" and "engine ode_quickstep" of its line `keywords = {engine ode, engine ode_quickstep}`.
std::set<std::string> keywords_of(const std::string& entry) {
  const std::string key = "keywords = {";
  const std::size_t begin = entry.find(key) + key.size();
  return words_of(entry.substr(begin, entry.find('}', begin) - begin));
}

std::string without_keywords(std::string entry) {
  const std::size_t line = entry.find(",\n  keywords");
  return entry.replace(line, entry.find('\n', line + 2) - line, "");
}

void replace(std::string& text, const std::string& word, const std::string& with) {
  const std::size_t at = text.find(word);
  if (at != std::string::npos) text.replace(at, word.size(), with);
}

/// What results were made with.
struct Origin {
  std::set<std::string> used{"always"};  ///< "engine ode", "law lugre"
  std::vector<std::string> experiments;  ///< their hashes
  bool unfinished = false;
};

/// What the results of a folder were made with, where it holds results.
void add_folder(Origin& origin, const std::filesystem::path& folder) {
  const std::optional<output::Manifest> manifest = output::read_manifest(folder);
  if (!manifest) return;
  origin.experiments.push_back(manifest->experiment);
  origin.unfinished |= std::ranges::any_of(manifest->files, [](const auto& file) {
    return file.second.empty() && !file.first.ends_with('/');
  });
  // Of a run "engine" with its version and "law", of studies and tunings "engines" and "laws".
  for (const auto& [what, value] : manifest->about) {
    if (what == "engine") origin.used.insert("engine " + value.substr(0, value.find(' ')));
    if (what == "law") origin.used.insert("law " + value);
    for (const std::string kind : {"engine", "law"})
      if (what == kind + "s")
        for (const std::string& word : words_of(value)) origin.used.insert(kind + " " + word);
  }
}

/// The same of a folder that holds several: a Matrix's, or that of a file with several studies.
Origin origin_of(const std::filesystem::path& folder) {
  Origin origin;
  add_folder(origin, folder);
  const std::vector<std::string> own = origin.experiments;
  std::error_code ignored;
  for (const auto& part : std::filesystem::directory_iterator(folder, ignored))
    if (part.is_directory(ignored)) add_folder(origin, part.path());
  if (!own.empty()) origin.experiments = own;
  return origin;
}

}  // namespace

int cite(const std::optional<std::filesystem::path>& folder) {
  application::Application application;
  const auto bibliography = output::read_file(application.find("citations.bib"));
  if (!bibliography) {
    application::print_error("there is no citations.bib in the folder of configs");
    return missing;
  }
  Origin origin;
  std::string note;
  if (folder) {
    const std::string name = text::printable(folder->string());
    try {
      origin = origin_of(*folder);
    } catch (const output::FolderError&) {
      application::print_error("a files.json in " + name + " is not one that hookpoint wrote");
      return wrong_input;
    }
    if (origin.experiments.empty()) {
      application::print_error(name +
                               " holds no results: `run --out`, `study` and `tune` leave "
                               "folders that can be cited");
      return wrong_input;
    }
    if (origin.unfinished) {
      application::print_error("the results in " + name +
                               " are not finished; finish them with --resume");
      return wrong_input;
    }
    note = "experiment " + language::join(origin.experiments, ", ");
  }
  std::string text;
  for (std::string entry : entries_of(*bibliography)) {
    const std::set<std::string> words = keywords_of(entry);
    if (std::ranges::none_of(words,
                             [&](const std::string& word) { return origin.used.contains(word); }))
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
