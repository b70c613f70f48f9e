#include "reference/process/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

#include "simulation/experiment/material_fields.h"
#include "text/display.h"
#include "text/json.h"

namespace hookpoint::reference {
namespace {

using output::ChildProgram;
using simulation::EngineGap;
using text::JsonValue;
using Transfer = ChildProgram::Transfer;

static_assert(std::endian::native == std::endian::little, "the protocol's numbers are");

constexpr char json_kind = 'J', doubles_kind = 'D';
constexpr std::size_t head_size = sizeof(std::uint32_t) + 1;
constexpr std::uint32_t most_bytes = 1U << 28;

std::string member_text(const JsonValue& object, std::string_view name) {
  const JsonValue* member = object.member(name);
  return member != nullptr && member->is_leaf() ? member->text() : "";
}

std::string hello_text(int protocol) {
  text::JsonWriter json;
  json.begin_object().member("type", "hello").member("protocol", protocol).end_object();
  return json.text();
}

EngineGap::Handling handling_of(const std::string& name) {
  using enum EngineGap::Handling;
  if (name == "refused") return refused;
  if (name == "noticed") return noticed;
  if (name == "stated") return stated;
  throw ProgramError("its hello has a gap whose handling is `" + one_line(name) +
                     "` and not refused, noticed or stated");
}

/// Names of constants of a Material. Throws ProgramError.
std::vector<std::string> constants_of(const JsonValue& names) {
  std::vector<std::string> constants;
  for (const JsonValue& item : names.items()) {
    const std::string name = item.is_leaf() ? item.text() : "";
    const auto is_named = [&](const auto& field) { return field.name == name; };
    if (std::ranges::none_of(simulation::material_fields(), is_named))
      throw ProgramError("its hello reads `" + one_line(name) +
                         "`, which is no constant of a Material");
    constants.push_back(name);
  }
  return constants;
}

/// Throws ProgramError.
Hello hello_of(const JsonValue& json, int protocol) {
  if (member_text(json, "type") != "hello")
    throw ProgramError("its first message is `" + one_line(member_text(json, "type")) +
                       "` and not hello");
  if (member_text(json, "protocol") != std::to_string(protocol))
    throw ProgramError(fmt::format("it speaks protocol {}, and this hookpoint {}",
                                   one_line(member_text(json, "protocol")), protocol));
  Hello hello{.name = one_line(member_text(json, "name")),
              .version = one_line(member_text(json, "version")),
              .precision = member_text(json, "precision"),
              .settings = {},
              .constants = {},
              .gaps = {}};
  if (hello.name.empty() || hello.version.empty())
    throw ProgramError("its hello has no name or no version");
  if (hello.precision != "double" && hello.precision != "single")
    throw ProgramError("its hello has the precision `" + one_line(hello.precision) +
                       "` and not double or single");
  if (const JsonValue* settings = json.member("settings"))
    for (const JsonValue& setting : settings->items()) {
      const std::string name = one_line(member_text(setting, "name"));
      const std::string source = one_line(member_text(setting, "source"));
      hello.settings.push_back(name);
      if (const JsonValue* reads = setting.member("reads"))
        hello.reads[name] = constants_of(*reads);
      const JsonValue* constants = setting.member("constants");
      if (constants == nullptr || constants->members().empty())
        hello.constants.push_back({name, "all", "the program's own", source});
      else
        for (const auto& [quantity, value] : constants->members())
          hello.constants.push_back({name, one_line(quantity), one_line(value.text()), source});
    }
  if (hello.settings.empty()) throw ProgramError("its hello has no settings");
  if (const JsonValue* gaps = json.member("gaps"))
    for (const JsonValue& gap : gaps->items())
      hello.gaps.push_back({one_line(member_text(gap, "feature")),
                            handling_of(member_text(gap, "handling")),
                            one_line(member_text(gap, "instead"))});
  return hello;
}

std::unique_ptr<ChildProgram> start(const ProgramDefinition& definition) {
  if (definition.command.empty()) throw ProgramError("it has no command");
  std::string name = definition.command.front();
  // A path is one in the folder of the file that has it.
  if (name.find('/') != std::string::npos) name = (definition.folder / name).string();
  const std::filesystem::path program = output::program_on_path(name);
  if (program.empty())
    throw ProgramError(fmt::format("there is no program `{}`{}", one_line(name),
                                   definition.install.empty() ? "" : ": " + definition.install));
  try {
    return std::make_unique<ChildProgram>(
        program, std::vector<std::string>(definition.command.begin() + 1, definition.command.end()),
        ChildProgram::Options{
            .folder = definition.folder, .takes_input = true, .ends_with_thread = false});
  } catch (const std::system_error& error) {
    throw ProgramError(error.what());
  }
}

}  // namespace

std::string one_line(const std::string& text) {
  constexpr std::size_t most = 200;
  return std::string(text::first_characters(text::printable(text), most));
}

Program::Program(const ProgramDefinition& definition)
    : definition_(definition), child_(start(definition)) {
  constexpr int protocol = 1;
  try {
    hello_ = hello_of(request(hello_text(protocol)), protocol);
  } catch (const ProgramError& error) {
    if (definition.install.empty()) throw;
    throw ProgramError(std::string(error.what()) + "; " + definition.install);
  }
  for (const std::string& setting : definition.settings)
    if (std::ranges::find(hello_.settings, setting) == hello_.settings.end())
      throw ProgramError("its Engine block names the settings `" + setting +
                         "`, which the program does not know");
}

JsonValue Program::request(const std::string& json) {
  send(json_kind, json);
  return json_of(receive());
}

std::variant<std::vector<double>, std::string> Program::step(std::span<const double> inputs) {
  const auto bytes = std::as_bytes(inputs);
  send(doubles_kind, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const Frame frame = receive();
  if (frame.kind == json_kind) {
    const JsonValue json = json_of(frame);
    if (member_text(json, "type") != "failed")
      fail("answers a step with `" + one_line(member_text(json, "type")) + "`");
    return one_line(member_text(json, "reason"));
  }
  if (frame.payload.size() % sizeof(double) != 0)
    fail(fmt::format("answers a step with {} bytes, which are no doubles", frame.payload.size()));
  std::vector<double> states(frame.payload.size() / sizeof(double));
  std::memcpy(states.data(), frame.payload.data(), frame.payload.size());
  return states;
}

void Program::send(char kind, std::string_view payload) {
  using std::chrono::duration, std::chrono::duration_cast;
  until_ = ChildProgram::Clock::now() +
           duration_cast<ChildProgram::Clock::duration>(duration<double>(definition_.deadline));
  const auto length = static_cast<std::uint32_t>(payload.size());
  std::string frame(sizeof length, '\0');
  std::memcpy(frame.data(), &length, sizeof length);
  frame.append(1, kind).append(payload);
  if (child_->write(frame, until_) == Transfer::late)
    fail(fmt::format("has not read its input for {:g} s", definition_.deadline));
  // What it wrote before it ended is still there: receive() tells how it ended.
}

std::string Program::read(std::size_t count) {
  std::string bytes;
  switch (child_->read(count, bytes, until_)) {
    case Transfer::done:
      return bytes;
    case Transfer::late:
      fail(fmt::format("has not answered for {:g} s", definition_.deadline));
    case Transfer::closed:
      break;
  }
  // It has closed its output, so it is about to end.
  for (const auto until = ChildProgram::Clock::now() + std::chrono::seconds(2);
       child_->running() && ChildProgram::Clock::now() < until;)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  fail(child_->running() ? "has closed its standard output" : "has ended (" + child_->end() + ")");
}

Program::Frame Program::receive() {
  const std::string head = read(head_size);
  std::uint32_t length = 0;
  std::memcpy(&length, head.data(), sizeof length);
  const char kind = head.back();
  if (kind != json_kind && kind != doubles_kind)
    fail("answers with what is no frame: does it print to its standard output?");
  if (length > most_bytes) fail(fmt::format("answers with a frame of {} bytes", length));
  return {kind, read(length)};
}

JsonValue Program::json_of(const Frame& frame) {
  auto json = text::read_json(frame.payload);
  if (frame.kind != json_kind || !json || !json->is_object())
    fail("answers with what is no JSON object");
  return *std::move(json);
}

void Program::fail(const std::string& problem) {
  child_->kill();
  std::string last = child_->errors();
  while (!last.empty() && last.back() == '\n') last.pop_back();
  last.erase(0, last.rfind('\n') + 1);
  throw ProgramError("the program " + problem +
                     (last.empty() ? "" : "; its last words: " + one_line(last)));
}

}  // namespace hookpoint::reference
