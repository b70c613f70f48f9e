#include "simulation/scene/urdf/xacro.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <pugixml.hpp>

#include "output/files/child.h"
#include "output/files/file.h"

namespace hookpoint::simulation {
namespace {

using language::ForeignArguments;
using language::ForeignField;
using language::Position;
using language::SourceFile;
using language::ValueKind;

/// What of a file is xacro's.
struct Macros {
  std::optional<Position> first;       ///< element
  std::vector<std::string> arguments;  ///< that it declares
};

Macros macros_of(const SourceFile& file) {
  pugi::xml_document document;
  Macros macros;
  // What is no XML is said when it is read.
  if (!document.load_buffer(file.text.data(), file.text.size(), pugi::parse_default,
                            pugi::encoding_utf8))
    return macros;
  struct Walker : pugi::xml_tree_walker {
    Macros* macros;
    const SourceFile* file;
    bool for_each(pugi::xml_node& node) override {
      const std::string_view name = node.name();
      if (!name.starts_with("xacro:")) return true;
      if (!macros->first)
        macros->first = {file, static_cast<std::size_t>(node.offset_debug()), name.size()};
      if (name == "xacro:arg") macros->arguments.emplace_back(node.attribute("name").value());
      return true;
    }
  } walker;
  walker.macros = &macros;
  walker.file = &file;
  document.traverse(walker);
  return macros;
}

/// As xacro takes it; nothing for a list.
std::optional<std::string> argument_text(const ForeignField& given) {
  if (given.values.size() != 1) return std::nullopt;
  const language::Value& value = given.values[0];
  if (value.kind == ValueKind::number) return fmt::format("{}", value.quantity.value);
  if (value.kind == ValueKind::boolean) return value.quantity.value != 0. ? "true" : "false";
  return value.text;
}

/// What the program said last, on one line.
std::string last_words(const std::string& errors) {
  constexpr std::size_t most = 600;
  std::string text;
  for (const char c : errors.substr(errors.size() - std::min(errors.size(), most))) {
    if (c != '\n') {
      text += c;
    } else if (!text.empty() && !text.ends_with("; ")) {
      text += "; ";
    }
  }
  while (text.ends_with(' ') || text.ends_with(';')) text.pop_back();
  return text;
}

struct Expansion {
  SourceFile source;
  std::string problem;
};

Expansion expand(const SourceFile& file, const std::vector<std::string>& words) {
  constexpr double most_seconds = 60.;
  constexpr std::size_t most_bytes = 64UL << 20;
  Expansion expansion;
  std::error_code error;
  const std::filesystem::path path = std::filesystem::absolute(file.path, error);
  if (!std::filesystem::is_regular_file(path, error))
    return {{}, "xacro expands files on the disk only"};
  std::vector<std::string> arguments{path.string()};
  arguments.insert(arguments.end(), words.begin(), words.end());
  try {
    const auto ran = output::run_program("xacro", arguments, path.parent_path(),
                                         {true, most_seconds, most_bytes});
    if (!ran)
      return {{},
              "the macros of xacro need its program, which is not installed: it comes with ROS and "
              "with `pip install xacro`; or expand the file elsewhere, `xacro FILE > robot.urdf`"};
    if (ran->stopped)
      return {{},
              fmt::format("xacro was stopped: it had not ended after {:g} s, or wrote more "
                          "than {} MB",
                          most_seconds, most_bytes >> 20)};
    if (ran->status != 0)
      return {{},
              fmt::format("xacro ended with status {}: {}", ran->status, last_words(ran->errors))};
    expansion.source =
        language::source_file(fmt::format("<{} as xacro expands it>", file.path), ran->output);
  } catch (const output::FileError& refused) {
    return {{}, refused.what()};
  }
  return expansion;
}

}  // namespace

ExpandedUrdf expand_xacro(const SourceFile& file, const ForeignArguments& arguments,
                          std::span<const char* const> own, language::FileStore& files,
                          language::Report& report) {
  const Macros macros = macros_of(file);
  if (!macros.first && !file.path.ends_with(".xacro")) return {&file, {}};
  std::vector<std::string> taken, words;
  for (const auto& [name, given] : arguments) {
    if (std::ranges::count(macros.arguments, name) == 0 || std::ranges::count(own, name) > 0)
      continue;
    taken.push_back(name);
    const std::optional<std::string> text = argument_text(given);
    if (text) {
      words.push_back(fmt::format("{}:={}", name, *text));
    } else if (!given.values.empty()) {
      report.error(given.position, fmt::format("the argument `{}` of xacro takes one value", name));
      return {};
    }
  }
  std::string key = "xacro " + file.path;
  for (const std::string& word : words) key += '\n' + word;
  const auto& expansion = files.keep<Expansion>(key, [&] { return expand(file, words); });
  if (expansion.problem.empty()) {
    report.order_file(expansion.source);
    return {&expansion.source, std::move(taken)};
  }
  report.error(macros.first.value_or(Position{&file, 0, 1}), expansion.problem);
  return {};
}

}  // namespace hookpoint::simulation
