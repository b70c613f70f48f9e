#include "language/diagnostics.h"

#include <algorithm>
#include <array>
#include <ostream>
#include <string_view>

namespace hookpoint::language {
namespace {

constexpr std::size_t longest_excerpt = 160;

struct Style {
  std::string_view name, colour;
};

constexpr std::array<Style, 3> styles{
    {{"error", "\033[1;31m"}, {"warning", "\033[1;35m"}, {"note", "\033[1;36m"}}};
constexpr std::string_view bold = "\033[1m", plain = "\033[0m";

bool continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Length in bytes of the valid UTF-8 character that begins `text`, 0 if there is none.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length == 0 || length > text.size()) return 0;
  return std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length),
                     continuation)
             ? length
             : 0;
}

/// The text fit for a terminal: what cannot be shown becomes one '?' a byte.
std::string shown(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const bool control = length == 1 && text[0] != '\t' &&
                         (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7F);
    if (length == 0 || control) {
      result += '?';
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

/// Blanks as wide as `text`, tabs kept, so that the caret stands below its character.
std::string blanks(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (!continuation(c)) result += c == '\t' ? '\t' : ' ';
  }
  return result;
}

void print_excerpt(std::ostream& out, const Position& position, std::string_view colour) {
  const LineColumn place = line_and_column(position);
  const SourceFile& file = *position.file;
  std::string_view line = line_text(file, place.line);
  std::size_t at = std::min(position.offset, file.text.size()) - file.line_starts[place.line - 1];
  at = std::min(at, line.size());
  if (line.size() > longest_excerpt && at > longest_excerpt / 2) {
    std::size_t cut = at - longest_excerpt / 2;
    while (cut < at && continuation(line[cut])) ++cut;
    line.remove_prefix(cut);
    at -= cut;
  }
  if (line.size() > longest_excerpt) {
    std::size_t end = longest_excerpt;
    while (end > at && continuation(line[end])) --end;
    line = line.substr(0, end);
  }
  const std::string_view marked = line.substr(at, position.length);
  std::size_t width = 0;
  for (const char c : marked) width += continuation(c) ? 0 : 1;
  const std::string number = std::to_string(place.line);
  out << ' ' << number << " | " << shown(line) << '\n';
  out << std::string(number.size() + 1, ' ') << " | " << blanks(line.substr(0, at)) << colour << '^'
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

void Diagnostics::add(Severity severity, const Position& position, std::string message) {
  diagnostics_.push_back({severity, position, std::move(message)});
}

void Diagnostics::print(std::ostream& out, bool colours) const {
  for (const Diagnostic& diagnostic : diagnostics_) {
    const Style& style = styles[static_cast<std::size_t>(diagnostic.severity)];
    const std::string_view colour = colours ? style.colour : "";
    const bool placed = diagnostic.position.file != nullptr;
    if (placed) {
      const LineColumn place = line_and_column(diagnostic.position);
      out << (colours ? bold : "") << diagnostic.position.file->path << ':' << place.line << ':'
          << place.column << ": ";
    }
    out << colour << style.name << ": " << (colours ? plain : "") << diagnostic.message << '\n';
    if (placed) print_excerpt(out, diagnostic.position, colour);
  }
  if (errors_ > limit) {
    const std::size_t more = errors_ - limit;
    out << "... and " << more << (more == 1 ? " more error\n" : " more errors\n");
  }
}

}  // namespace hookpoint::language
