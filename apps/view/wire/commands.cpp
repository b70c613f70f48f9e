#include "apps/view/wire/commands.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "apps/view/wire/base64.h"
#include "text/json_reader.h"

namespace hookpoint::view {
namespace {

/// What is wrong with a message, for the page.
struct Problem : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A message's members, each requested by its name.
class Members {
 public:
  explicit Members(const text::JsonValue& message) : message_(message) {}

  /// The text of a member that is neither an object nor a list; null where there is none.
  const std::string* find(std::string_view name) const {
    const text::JsonValue* found = leaf(name);
    return found == nullptr ? nullptr : &found->text();
  }
  const std::string& text(std::string_view name) const { return present(name).text(); }
  double number(std::string_view name) const { return number_of(name, present(name)); }
  double number(std::string_view name, double otherwise) const {
    return find(name) == nullptr ? otherwise : number(name);
  }
  std::int64_t whole(std::string_view name, std::int64_t least, std::int64_t most) const {
    const double value = number(name);
    if (value != std::floor(value) || value < static_cast<double>(least) ||
        value > static_cast<double>(most))
      throw Problem(
          fmt::format("`{}` takes a whole number from {} to {}, not {}", name, least, most, value));
    return static_cast<std::int64_t>(value);
  }
  std::vector<std::string> list(std::string_view name) const {
    std::vector<std::string> values;
    if (const text::JsonValue* found = message_.member(name))
      for (const text::JsonValue& item : found->items()) values.push_back(item.text());
    return values;
  }
  /// Members of a member, under their own names.
  std::vector<std::pair<std::string, double>> numbers(std::string_view name) const {
    std::vector<std::pair<std::string, double>> values;
    if (const text::JsonValue* found = message_.member(name))
      for (const auto& [key, value] : found->members())
        values.emplace_back(key, number_of(key, value));
    return values;
  }
  /// The same where each is a number or a list of them.
  std::vector<std::pair<std::string, std::vector<double>>> lists_of_numbers(
      std::string_view name) const {
    std::vector<std::pair<std::string, std::vector<double>>> values;
    const text::JsonValue* found = message_.member(name);
    if (found == nullptr) return values;
    for (const auto& [key, value] : found->members()) {
      std::vector<double>& list = values.emplace_back(key, std::vector<double>()).second;
      if (value.is_leaf()) list.push_back(number_of(key, value));
      for (const text::JsonValue& item : value.items()) list.push_back(number_of(key, item));
    }
    return values;
  }

 private:
  static double number_of(std::string_view name, const text::JsonValue& value) {
    if (const auto number = value.number()) return *number;
    throw Problem(fmt::format("`{}` takes a finite number, not `{}`", name, value.text()));
  }
  const text::JsonValue* leaf(std::string_view name) const {
    const text::JsonValue* found = message_.member(name);
    return found == nullptr || !found->is_leaf() ? nullptr : found;
  }
  const text::JsonValue& present(std::string_view name) const {
    if (const text::JsonValue* found = leaf(name)) return *found;
    throw Problem(fmt::format("`{}` is missing", name));
  }

  const text::JsonValue& message_;
};

constexpr std::size_t most_trails = 1000;

std::vector<std::string> trails_of(const Members& members) {
  std::vector<std::string> trails = members.list("trails");
  if (trails.size() > most_trails)
    throw Problem(fmt::format("{} trails; at most {} at a time", trails.size(), most_trails));
  return trails;
}

Command set_ports(const Members& members) {
  SetPorts command{members.numbers("values")};
  if (command.values.empty()) throw Problem("`values` names no port: {\"pd1.goal\": 0.5}");
  return command;
}

Command start_from(const Members& members) {
  StartFrom command{members.lists_of_numbers("values")};
  if (command.values.empty())
    throw Problem("`values` names no port of the initial state: {\"w.arm.leg.link.angle\": 0.5}");
  return command;
}

Command ask_trace(const Members& members) {
  AskTrace command;
  command.trails = trails_of(members);
  command.from = members.number("from", 0.);
  command.to = members.number("to", HUGE_VAL);
  command.points = members.find("points") == nullptr
                       ? 2000
                       : static_cast<std::size_t>(members.whole("points", 2, 100'000));
  return command;
}

Command step_on(const Members& members) {
  if (members.find("count") == nullptr) return StepOn{};
  return StepOn{members.whole("count", 1, 1'000'000)};
}

Command set_speed(const Members& members) {
  const double factor = members.number("factor");
  if (factor != 0. && (factor < 1e-3 || factor > 1e3))
    throw Problem(fmt::format(
        "`factor` goes from 0.001 to 1000, or is 0 for as fast as possible; not {}", factor));
  return SetSpeed{factor};
}

/// The bytes that a member has in base64.
std::string bytes_of(const Members& members, std::string_view name) {
  std::optional<std::string> bytes = from_base64(members.text(name));
  if (!bytes) throw Problem(fmt::format("`{}` is not base64", name));
  return *std::move(bytes);
}

/// What a page calls a file is data: a plain name, in the run's own folder.
Command keep_picture(const Members& members) {
  const std::string& name = members.text("name");
  const bool plain = !name.empty() && name.size() <= 100 && name.front() != '.' &&
                     name.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                         "0123456789_-.") == std::string::npos;
  if (!plain || !name.ends_with(".png"))
    throw Problem("`name` is a file's name such as view-1.png: letters, digits, _ - .");
  std::string bytes = bytes_of(members, "png");
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) throw Problem("`png` is no PNG file");
  return KeepPicture{name, std::move(bytes)};
}

constexpr std::int64_t most_files = 10'000'000, most_bytes = std::int64_t{1} << 40;

std::size_t index_of(const Members& members, std::string_view name) {
  return static_cast<std::size_t>(members.whole(name, 0, most_files));
}

Command film_part(const Members& members) {
  return FilmPart{index_of(members, "file"),
                  static_cast<std::uint64_t>(members.whole("at", 0, most_bytes)),
                  bytes_of(members, "bytes")};
}

using Parse = Command (*)(const Members&);

const std::map<std::string, Parse, std::less<>>& commands() {
  static const std::map<std::string, Parse, std::less<>> table{
      {"set", set_ports},
      {"read", [](const Members& m) -> Command { return ReadPorts{trails_of(m)}; }},
      {"trails",
       [](const Members& m) -> Command {
         const std::string* pattern = m.find("pattern");
         return ListPorts{pattern == nullptr ? "**" : *pattern};
       }},
      {"watch", [](const Members& m) -> Command { return WatchPorts{trails_of(m)}; }},
      {"trace", ask_trace},
      {"pause", [](const Members&) -> Command { return Pause{}; }},
      {"run", [](const Members&) -> Command { return Run{}; }},
      {"step", step_on},
      {"speed", set_speed},
      {"seek", [](const Members& m) -> Command { return Seek{m.number("time")}; }},
      {"reset", [](const Members&) -> Command { return Reset{}; }},
      {"start_from", start_from},
      {"edit",
       [](const Members& m) -> Command {
         return EditField{m.text("trail"), m.text("value")};
       }},
      {"fields", [](const Members&) -> Command { return ListFields{}; }},
      {"changes", [](const Members&) -> Command { return ListChanges{}; }},
      {"patch", [](const Members&) -> Command { return AskPatch{}; }},
      {"unstable", [](const Members&) -> Command { return AskUnstable{}; }},
      {"picture", keep_picture},
      {"quit", [](const Members&) -> Command { return Quit{}; }},
      {"film_frame", [](const Members& m) -> Command { return AskFrame{index_of(m, "index")}; }},
      {"film_part", film_part},
      {"film_end", [](const Members& m) -> Command { return FilmEnd{index_of(m, "file")}; }},
      {"film_failed", [](const Members& m) -> Command { return FilmFailed{m.text("text")}; }},
  };
  return table;
}

Command parse_command(const Members& members) {
  const std::string& name = members.text("do");
  const auto found = commands().find(name);
  if (found != commands().end()) return found->second(members);
  std::string known;
  for (const auto& [word, parse] : commands()) known += (known.empty() ? "" : ", ") + word;
  throw Problem(fmt::format("there is no `do` of that name; there are {}", known));
}

}  // namespace

Request parse_request(std::string_view message) {
  Request request;
  const auto root = text::read_json(message);
  if (!root) {
    request.problem = "the message is not JSON";
    return request;
  }
  const Members members(*root);
  try {
    request.id = members.whole("id", 0, std::int64_t{1} << 53);
    request.command = parse_command(members);
  } catch (const Problem& problem) {
    request.problem = problem.what();
  }
  return request;
}

}  // namespace hookpoint::view
