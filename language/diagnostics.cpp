#include "language/diagnostics.h"

#include <algorithm>
#include <array>
#include <ostream>
#include <string_view>

#include "text/display.h"
#include "text/utf8.h"

namespace hookpoint::language {
namespace {

constexpr std::size_t longest_excerpt = 160;

struct Style {
  std::string_view name, colour;
};

constexpr std::array<Style, 3> styles{
    {{"error", "\033[1;31m"}, {"warning", "\033[1;35m"}, {"note", "\033[1;36m"}}};
constexpr std::string_view bold = "\033[1m", plain = "\033[0m";

/// Blanks as wide as `text`, tabs kept, so that the caret stands below its character.
std::string blanks(std::string_view text) {
  std::string result;
  for (std::size_t tab = text.find('\t'); tab != std::string_view::npos; tab = text.find('\t')) {
    result.append(text::display_width(text.substr(0, tab)), ' ').append(1, '\t');
    text.remove_prefix(tab + 1);
  }
  return result.append(text::display_width(text), ' ');
}

/// A line, or the part of a long one around `at`.
struct Excerpt {
  std::string_view text;
  std::size_t at = 0;  ///< of the text
  bool cut_before = false, cut_behind = false;
};

Excerpt cut_around(std::string_view line, std::size_t at) {
  Excerpt excerpt{line, at};
  if (line.size() > longest_excerpt && at > longest_excerpt / 2) {
    std::size_t cut = at - longest_excerpt / 2;
    while (cut < at && text::continues_character(line[cut])) ++cut;
    excerpt = {line.substr(cut), at - cut, cut > 0};
  }
  if (excerpt.text.size() > longest_excerpt) {
    std::size_t end = longest_excerpt;
    while (end > excerpt.at && text::continues_character(excerpt.text[end])) --end;
    excerpt.text = excerpt.text.substr(0, end);
    excerpt.cut_behind = true;
  }
  return excerpt;
}

/// Whether a line holds more than blanks, so that a caret points at something.
bool is_seen(std::string_view line) {
  return line.find_first_not_of(" \t\r\v\f") != std::string_view::npos;
}

void print_excerpt(std::ostream& out, const Position& position, std::string_view colour) {
  constexpr std::string_view left_out = "...";
  const LineColumn place = line_and_column(position);
  const SourceFile& file = *position.file;
  const std::string_view line = line_text(file, place.line);
  const std::size_t offset =
      std::min(position.offset, file.text.size()) - file.line_starts[place.line - 1];
  const Excerpt excerpt = cut_around(line, std::min(offset, line.size()));
  const std::string_view before = excerpt.cut_before ? left_out : "";
  const std::string_view behind = excerpt.cut_behind ? left_out : "";
  const std::size_t width = text::display_width(excerpt.text.substr(excerpt.at, position.length));
  const std::string number = std::to_string(place.line);
  out << ' ' << number << " | " << before << text::printable(excerpt.text, true) << behind << '\n';
  out << std::string(number.size() + 1, ' ') << " | " << std::string(before.size(), ' ')
      << blanks(excerpt.text.substr(0, excerpt.at)) << colour << '^'
      << std::string(std::max<std::size_t>(width, 1) - 1, '~') << (colour.empty() ? "" : plain)
      << '\n';
}

}  // namespace

void Diagnostics::error(const Position& position, std::string message) {
  ++errors_;
  if (errors_ <= limit) add(Severity::error, position, std::move(message));
}

void Diagnostics::warning(const Position& position, std::string message) {
  add(Severity::warning, position, std::move(message));
}

void Diagnostics::note(const Position& position, std::string message) {
  if (errors_ <= limit) add(Severity::note, position, std::move(message));
}

void Diagnostics::report_again(const Diagnostic& diagnostic, const Position& position) {
  switch (diagnostic.severity) {
    case Severity::error:
      return error(position, diagnostic.message);
    case Severity::warning:
      return warning(position, diagnostic.message);
    case Severity::note:
      return note(position, diagnostic.message);
  }
}

Diagnostics Diagnostics::without(const std::function<bool(const Diagnostic& warning)>& drop) const {
  Diagnostics left = *this;
  bool dropped = false;
  std::erase_if(left.diagnostics_, [&](const Diagnostic& diagnostic) {
    if (diagnostic.severity != Severity::note)
      dropped = diagnostic.severity == Severity::warning && drop(diagnostic);
    return dropped;
  });
  return left;
}

void Diagnostics::add(Severity severity, const Position& position, std::string message) {
  diagnostics_.push_back({severity, position, std::move(message)});
}

std::string Diagnostics::first_error() const {
  const auto found = std::ranges::find(diagnostics_, Severity::error, &Diagnostic::severity);
  return found == diagnostics_.end() ? "" : found->message;
}

void Diagnostics::print(std::ostream& out, bool colours) const {
  for (const Diagnostic& diagnostic : diagnostics_) {
    const Style& style = styles[static_cast<std::size_t>(diagnostic.severity)];
    const std::string_view colour = colours ? style.colour : "";
    const SourceFile* const file = diagnostic.position.file;
    const LineColumn place = file == nullptr ? LineColumn{} : line_and_column(diagnostic.position);
    if (file != nullptr) {
      out << (colours ? bold : "") << text::printable(file->path) << ':';
      // A file without text has no place in it: it is not there, or cannot be read.
      if (!file->text.empty()) out << place.line << ':' << place.column << ':';
      out << ' ';
    }
    out << colour << style.name << ": " << (colours ? plain : "")
        << text::printable(diagnostic.message) << '\n';
    if (file != nullptr && is_seen(line_text(*file, place.line)))
      print_excerpt(out, diagnostic.position, colour);
  }
  if (errors_ > limit) {
    const std::size_t more = errors_ - limit;
    out << "... and " << more << (more == 1 ? " more error\n" : " more errors\n");
  }
}

}  // namespace hookpoint::language
